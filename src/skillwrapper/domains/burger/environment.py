"""The burger kitchen as an environment."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from skillwrapper.domains.burger import rules
from skillwrapper.domains.burger.layout import Layout, make_layout
from skillwrapper.domains.burger.renderer import BurgerRenderer
from skillwrapper.domains.burger.states import BurgerState, state_from_data, state_to_data
from skillwrapper.domains.burger.style import CHALK, CLASSIC, Style
from skillwrapper.domains.burger.system_predicates import system_atoms
from skillwrapper.errors import RobotError
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.pictures import encode_png
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


class BurgerEnvironment:
    """A robot that makes burgers (enumerable, truthful, replayable).

    The seed of ``reset`` chooses the layout of the picture: where stations, tables and robot stand
    and which item starts on which table. The state at the start is always the standard one.

    Args:
        style: how the pictures are drawn.
        domain: of ``domain.yaml``; None to read it.
    """

    replayable = True

    def __init__(self, style: Style = CLASSIC, *, domain: Domain | None = None) -> None:
        self._domain = domain or load_domain(Path(__file__).with_name("domain.yaml"))
        self._renderer = BurgerRenderer(style)
        self._state = BurgerState()
        self._layout: Layout | None = None

    @property
    def domain(self) -> Domain:
        """Types, objects and skills."""
        return self._domain

    @property
    def scene(self) -> Scene:
        """The one scene of the kitchen."""
        return self._domain.scene()

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        """All items on their tables and the hand empty, in the layout of the seed.

        Raises:
            UnknownNameError: if there is no such scene.
        """
        self._domain.scene(scene)
        return self.set_state(BurgerState(), seed=seed)

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance; a failed one changes nothing.

        Raises:
            RobotError: before the first reset.
            UnknownNameError: if there is no such skill or object.
            ConfigurationError: if the arguments do not fit the skill.
        """
        self._present_layout()
        self._domain.check_instance(instance)
        reason = rules.obstacle(self._state, instance)
        if reason is None:
            self._state = rules.effect(self._state, instance)
        return Outcome(reason is None, self.observe(), reason or "")

    def observe(self) -> Observation:
        """The picture of the present state."""
        return self.observe_state(self._state)

    def close(self) -> None:
        """Nothing is held; as before the first reset."""
        self._layout = None

    def reachable_states(self, start: BurgerState | None = None) -> tuple[BurgerState, ...]:
        """All states reachable from a state (default: the standard start), that one first."""
        return rules.reachable(start or BurgerState(), self._domain.skill_instances)

    def get_state(self) -> BurgerState:
        """The present state."""
        return self._state

    def set_state(self, state: BurgerState, *, seed: int | None = None) -> Observation:
        """Put the kitchen into a state; a seed also chooses the layout.

        Raises:
            RobotError: before the first reset, if no seed is given.
        """
        if seed is not None:
            self._layout = make_layout(seed)
        self._present_layout()
        self._state = state
        return self.observe()

    def successor(self, state: BurgerState, instance: SkillInstance) -> tuple[bool, BurgerState]:
        """Success and next state of an instance; changes nothing.

        Raises:
            UnknownNameError: if there is no such skill or object.
            ConfigurationError: if the arguments do not fit the skill.
        """
        self._domain.check_instance(instance)
        if rules.obstacle(state, instance) is not None:
            return False, state
        return True, rules.effect(state, instance)

    def observe_state(self, state: BurgerState) -> Observation:
        """What would be seen in a state in the present layout; changes nothing."""
        image = self._renderer.render(state, self._present_layout())
        return Observation((Picture(encode_png(image)),))

    def true_atoms(self, state: BurgerState) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The true atoms of ``system_predicates.SYSTEM_PREDICATES``."""
        return system_atoms(state)

    def state_to_data(self, state: BurgerState) -> dict[str, Any]:
        """A plain description of a state for YAML and JSON files."""
        return state_to_data(state)

    def state_from_data(self, data: Mapping[str, Any]) -> BurgerState:
        """The state that ``state_to_data`` described.

        Raises:
            ConfigurationError: if it is not one of a state.
        """
        return state_from_data(data)

    def _present_layout(self) -> Layout:
        if self._layout is None:
            raise RobotError("expected reset(seed=...) first, got another call; reset the kitchen")
        return self._layout


def chalk_kitchen() -> BurgerEnvironment:
    """The same kitchen drawn with chalk."""
    return BurgerEnvironment(CHALK)
