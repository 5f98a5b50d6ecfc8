"""The table as an environment whose arm moves without forces: fast, and always the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, lru_cache
from pathlib import Path

from skillwrapper.domains.panda import rules
from skillwrapper.domains.panda.cameras import FRONT, HEIGHT, WIDTH
from skillwrapper.domains.panda.layout import Layout, make_layout
from skillwrapper.domains.panda.skills import PandaSkills
from skillwrapper.domains.panda.states import THINGS, PandaState, start_of
from skillwrapper.domains.panda.system_predicates import system_atoms
from skillwrapper.domains.panda.table import PandaTable, Setting
from skillwrapper.domains.tabletop.motion import KinematicMotion, Motion, MotionFailed
from skillwrapper.domains.tabletop.photos import Photographer
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of
from skillwrapper.world.simulator import Simulator
from skillwrapper.world.skills import SkillInstance

_KEPT_PICTURES = 128


def read_domain() -> Domain:
    """The domain of the file beside this one."""
    return load_domain(Path(__file__).with_name("domain.yaml"))


class PandaEnvironment(Simulator[PandaState]):
    """A Panda at a table.

    The seed of ``reset`` chooses where things stand; the state at the start is that of the scene.
    Rules say whether a skill succeeds, and every motion is made: one that finds no free path makes
    the skill fail, and nothing changes. Without MuJoCo all works but motions and pictures.

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
        super().__init__(domain or read_domain())
        self._setting, self._camera = setting or Setting(), camera
        self._photographer = Photographer(WIDTH, HEIGHT)
        self._drawn = lru_cache(maxsize=_KEPT_PICTURES)(self._draw)

    def start(self) -> PandaState:
        """Everything in its place and the hand empty; the plate dirty where there is a sponge."""
        return start_of(self.scene.names)

    def obstacle(self, state: PandaState, instance: SkillInstance) -> str | None:
        """Why a skill instance fails in a state, in words; None if it succeeds."""
        return rules.obstacle(state, instance)

    def effect(self, state: PandaState, instance: SkillInstance) -> PandaState:
        """The state after a skill instance that succeeds."""
        return rules.effect(state, instance)

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance with all its motions; a failed one changes nothing.

        Raises:
            RobotError: before the first reset.
            UnknownNameError: if there is no such skill, or no such object in the scene.
            ConfigurationError: if the arguments do not fit the skill.
            MissingDependencyError: without MuJoCo, or the models of the arms.
        """
        state, layout = self._started(), self._layout or 0
        self.domain.check_instance(instance, self.scene)
        if self.obstacle(state, instance) is None:
            self._table.arrange(state, self._places(layout))
            try:
                self._skills.run(instance)
            except MotionFailed as failed:
                return Outcome(False, self.observe(), str(failed))
        return super().execute(instance)

    def draw(self, state: PandaState, layout: int) -> Picture:
        """The table with the arm at home."""
        return self._drawn(state, layout, self.scene.names)

    def true_atoms(self, state: PandaState) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The true atoms of ``system_predicates.SYSTEM_PREDICATES``."""
        return system_atoms(state)

    @cached_property
    def _table(self) -> PandaTable:
        return PandaTable(self._setting)

    def film(self, take: Callable[[Picture], None] | None) -> None:
        """Call ``take`` with a picture every 80 milliseconds or so while the arm moves."""
        self._motion.on_frame = None if take is None else lambda _: take(self._photo())

    @cached_property
    def _motion(self) -> Motion:
        return KinematicMotion(self._table.world)

    @cached_property
    def _skills(self) -> PandaSkills:
        return PandaSkills(self._table, self._motion)

    def _draw(self, state: PandaState, layout: int, names: Sequence[str]) -> Picture:
        self._table.arrange(state, _places_of(layout, names))
        return self._photo()

    def _photo(self) -> Picture:
        """The table as it is now."""
        return picture_of(self._photographer.take(self._table.world, self._camera))

    def _places(self, layout: int) -> Layout:
        return _places_of(layout, self.scene.names)


def _places_of(layout: int, names: Sequence[str]) -> Layout:
    return make_layout([thing for thing in THINGS if thing in names], layout)
