"""The table as an environment whose arm moves without forces: fast, and always the same."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from skillwrapper.domains.panda import rules
from skillwrapper.domains.panda.cameras import FRONT
from skillwrapper.domains.panda.layout import make_layout
from skillwrapper.domains.panda.skills import PandaSkills
from skillwrapper.domains.panda.states import THINGS, PandaState, start_of
from skillwrapper.domains.panda.system_predicates import system_atoms
from skillwrapper.domains.panda.table import PandaTable, Setting
from skillwrapper.domains.tabletop.environment import ArmEnvironment
from skillwrapper.domains.tabletop.layout import Layout
from skillwrapper.domains.tabletop.motion import Motion
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.skills import SkillInstance


def read_domain() -> Domain:
    """The domain of the file beside this one."""
    return load_domain(Path(__file__).with_name("domain.yaml"))


class PandaEnvironment(ArmEnvironment[PandaState, PandaTable]):
    """A Panda at a table.

    Args:
        setting: what the things look like, and the light.
        camera: where it is seen from.
        domain: of ``domain.yaml``; None to read it.
    """

    def __init__(
        self,
        setting: Setting | None = None,
        camera: str = FRONT,
        *,
        domain: Domain | None = None,
    ) -> None:
        super().__init__(domain or read_domain(), camera)
        self._setting = setting or Setting()

    def start(self) -> PandaState:
        """Everything in its place and the hand empty; the plate dirty where there is a sponge."""
        return start_of(self.scene.names)

    def obstacle(self, state: PandaState, instance: SkillInstance) -> str | None:
        """Why a skill instance fails in a state, in words; None if it succeeds."""
        return rules.obstacle(state, instance)

    def effect(self, state: PandaState, instance: SkillInstance) -> PandaState:
        """The state after a skill instance that succeeds."""
        return rules.effect(state, instance)

    def true_atoms(self, state: PandaState) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The true atoms of ``system_predicates.SYSTEM_PREDICATES``."""
        return system_atoms(state)

    def make_table(self) -> PandaTable:
        """With all five things."""
        return PandaTable(self._setting)

    def make_skills(self, table: PandaTable, motion: Motion) -> PandaSkills:
        """The five skills."""
        return PandaSkills(table, motion)

    def places(self, names: Sequence[str], layout: int) -> Layout:
        """Of what the scene has."""
        return make_layout([thing for thing in THINGS if thing in names], layout)
