"""The burger kitchen as an environment."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from skillwrapper.domains.burger import rules
from skillwrapper.domains.burger.layout import make_layout
from skillwrapper.domains.burger.renderer import BurgerRenderer
from skillwrapper.domains.burger.states import BurgerState, state_from_data, state_to_data
from skillwrapper.domains.burger.style import CHALK, CLASSIC, Style
from skillwrapper.domains.burger.system_predicates import system_atoms
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import encode_png
from skillwrapper.world.simulator import Simulator
from skillwrapper.world.skills import SkillInstance

_layout_of = lru_cache(maxsize=64)(make_layout)
_renderer_of = cache(BurgerRenderer)


@cache
def _kitchen() -> Domain:
    return load_domain(Path(__file__).with_name("domain.yaml"))


class BurgerEnvironment(Simulator[BurgerState]):
    """A robot that makes burgers.

    The seed of ``reset`` chooses the layout of the picture: where stations, tables and robot stand
    and which item starts on which table. The state at the start is always the standard one.

    Args:
        style: how the pictures are drawn.
        domain: of ``domain.yaml``; None to read it.
    """

    def __init__(self, style: Style = CLASSIC, *, domain: Domain | None = None) -> None:
        super().__init__(domain or _kitchen())
        self._style = style

    def start(self) -> BurgerState:
        """All items on their tables and the hand empty."""
        return BurgerState()

    def obstacle(self, state: BurgerState, instance: SkillInstance) -> str | None:
        """Why a skill instance fails in a state, in words; None if it succeeds."""
        return rules.obstacle(state, instance)

    def effect(self, state: BurgerState, instance: SkillInstance) -> BurgerState:
        """The state after a skill instance that succeeds."""
        return rules.effect(state, instance)

    def draw(self, state: BurgerState, layout: int) -> Picture:
        """The kitchen from above."""
        picture = _renderer_of(self._style).render(state, _layout_of(layout))
        return Picture(encode_png(picture))

    def true_atoms(self, state: BurgerState) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The true atoms of ``system_predicates.SYSTEM_PREDICATES``."""
        return system_atoms(state)

    def state_to_data(self, state: BurgerState) -> dict[str, Any]:
        """A plain description that names the items."""
        return state_to_data(state)

    def state_from_data(self, data: Mapping[str, Any]) -> BurgerState:
        """The state that ``state_to_data`` described.

        Raises:
            ConfigurationError: if it is not one of a state.
        """
        return state_from_data(data)


def chalk_kitchen() -> BurgerEnvironment:
    """The same kitchen drawn with chalk."""
    return BurgerEnvironment(CHALK)
