"""The two arms as an environment without forces: fast, and always the same."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from skillwrapper.domains.kuka import rules
from skillwrapper.domains.kuka.cameras import EGO
from skillwrapper.domains.kuka.layout import make_layout
from skillwrapper.domains.kuka.skills import KukaSkills
from skillwrapper.domains.kuka.states import KukaState
from skillwrapper.domains.kuka.system_predicates import system_atoms
from skillwrapper.domains.kuka.table import KukaTable, Setting
from skillwrapper.domains.tabletop.environment import ArmEnvironment
from skillwrapper.domains.tabletop.layout import Layout
from skillwrapper.domains.tabletop.motion import Motion
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.skills import SkillInstance


def read_domain() -> Domain:
    """The domain of the file beside this one."""
    return load_domain(Path(__file__).with_name("domain.yaml"))


class KukaEnvironment(ArmEnvironment[KukaState, KukaTable]):
    """Two iiwa arms at a table.

    Args:
        setting: what the things look like, and the light.
        camera: where it is seen from.
        domain: of ``domain.yaml``; None to read it.
    """

    def __init__(
        self,
        setting: Setting | None = None,
        camera: str = EGO,
        *,
        domain: Domain | None = None,
    ) -> None:
        super().__init__(domain or read_domain(), camera)
        self._setting = setting or Setting()

    def start(self) -> KukaState:
        """The jar closed on the table, the clean knife in its holder, the bread bare."""
        return KukaState()

    def obstacle(self, state: KukaState, instance: SkillInstance) -> str | None:
        """Why a skill instance fails in a state, in words; None if it succeeds."""
        return rules.obstacle(state, instance)

    def effect(self, state: KukaState, instance: SkillInstance) -> KukaState:
        """The state after a skill instance that succeeds."""
        return rules.effect(state, instance)

    def true_atoms(self, state: KukaState) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The true atoms of ``system_predicates.SYSTEM_PREDICATES``."""
        return system_atoms(state)

    def make_table(self) -> KukaTable:
        """With jar, knife, holder and bread."""
        return KukaTable(self._setting)

    def make_skills(self, table: KukaTable, motion: Motion) -> KukaSkills:
        """The six skills."""
        return KukaSkills(table, motion)

    def places(self, names: Sequence[str], layout: int) -> Layout:
        """Jar, bread and holder; all scenes have them."""
        return make_layout(layout)
