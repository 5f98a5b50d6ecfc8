"""Environments of arms at a table: what rules allow is done by motions, and pictures are taken."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Hashable, Sequence
from functools import cached_property, lru_cache
from typing import Any, Generic, Protocol, TypeVar

from skillwrapper.domains.tabletop.cameras import HEIGHT, WIDTH
from skillwrapper.domains.tabletop.layout import Layout
from skillwrapper.domains.tabletop.motion import KinematicMotion, Motion, MotionFailed
from skillwrapper.domains.tabletop.photos import Photographer
from skillwrapper.domains.tabletop.physics import NO_TROUBLES, PhysicsMotion, Troubles
from skillwrapper.domains.tabletop.world import TableWorld
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.pictures import picture_of
from skillwrapper.world.simulator import Simulator
from skillwrapper.world.skills import SkillInstance

_KEPT_PICTURES = 128

State = TypeVar("State", bound=Hashable)
Arranged = TypeVar("Arranged")
AnyTable = TypeVar("AnyTable", bound="Table[Any]")


class Table(Protocol[Arranged]):
    """Things on a table, arranged as an abstract state says, and judged."""

    @property
    def world(self) -> TableWorld:
        """With arms and all things."""

    def arrange(self, state: Arranged, layout: Layout) -> None:
        """Set everything up as a state says, the arms at home.

        Args:
            state: abstract.
            layout: where the things of the scene started.
        """

    def state(self) -> Arranged:
        """The abstract state, told by where things are."""

    def displaced(self) -> str | None:
        """What lies where no skill leaves it, in words; None if nothing does."""


class Skills(Protocol):
    """The skills of a domain, as motions."""

    def run(self, instance: SkillInstance) -> None:
        """Run a skill that is not known to fail.

        Raises:
            MotionFailed: if it went wrong.
        """


class ArmEnvironment(Simulator[State], Generic[State, AnyTable]):
    """Arms at a table that move without forces: fast, and always the same.

    The seed of ``reset`` chooses where things stand; the state at the start is that of the scene.
    Rules say whether a skill succeeds, and every motion is made: one that finds no free path makes
    the skill fail, and nothing changes. Without MuJoCo all works but motions and pictures.

    Args:
        domain: of ``domain.yaml``.
        camera: where it is seen from.
    """

    def __init__(self, domain: Domain, camera: str) -> None:
        super().__init__(domain)
        self._camera, self._photographer = camera, Photographer(WIDTH, HEIGHT)
        self._drawn = lru_cache(maxsize=_KEPT_PICTURES)(self._draw)

    @abstractmethod
    def make_table(self) -> AnyTable:
        """A table with all things of the domain; wants MuJoCo."""

    @abstractmethod
    def make_skills(self, table: AnyTable, motion: Motion) -> Skills:
        """The skills on a table, done by these motions."""

    @abstractmethod
    def places(self, names: Sequence[str], layout: int) -> Layout:
        """Where the things of a scene start; the layout is a seed."""

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
            self.table.arrange(state, self.places(self.scene.names, layout))
            try:
                self.skills.run(instance)
            except MotionFailed as failed:
                return Outcome(False, self.observe(), str(failed))
        return super().execute(instance)

    def draw(self, state: State, layout: int) -> Picture:
        """The table with the arms at home."""
        return self._drawn(state, layout, self.scene.names)

    def film(self, take: Callable[[Picture], None] | None) -> None:
        """Call ``take`` with a picture every 80 milliseconds or so while an arm moves."""
        self.motion.on_frame = None if take is None else lambda _: take(self.photo())

    @cached_property
    def table(self) -> AnyTable:
        """The table, made when it is first needed."""
        return self.make_table()

    @cached_property
    def motion(self) -> Motion:
        """How the arms move."""
        return KinematicMotion(self.table.world)

    @cached_property
    def skills(self) -> Skills:
        """The skills on the table."""
        return self.make_skills(self.table, self.motion)

    def photo(self) -> Picture:
        """The table as it is now."""
        return picture_of(self._photographer.take(self.table.world, self._camera))

    def _draw(self, state: State, layout: int, names: Sequence[str]) -> Picture:
        self.table.arrange(state, self.places(names, layout))
        return self.photo()


class PhysicalArms(ArmEnvironment[State, AnyTable]):
    """The same with servos, contacts and gravity: to be derived from before ``ArmEnvironment``.

    The abstract state is judged by where things are, so a skill that was allowed by the rules
    fails if it does not bring what it should. The seed of ``reset`` also decides what goes wrong;
    the same seed and skills bring the same abstract states.

    Args:
        troubles: what goes wrong.
        given: what the environment without forces takes.
        named: the same by name.

    Attributes:
        troubles: what goes wrong.
    """

    def __init__(self, troubles: Troubles = NO_TROUBLES, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        self.troubles = troubles

    def set_state(self, state: State, *, seed: int | None = None) -> Observation:
        """Set the table up anew, everything at rest; a seed also chooses the layout.

        Raises:
            RobotError: before the first reset, if no seed is given.
        """
        layout = self._layout if seed is None else seed
        if layout is not None:
            self.table.arrange(state, self.places(self.scene.names, layout))
            self.motion.restart(layout)
        return super().set_state(state, seed=seed)

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance; what became of the table is judged afterwards.

        Raises:
            RobotError: before the first reset.
            UnknownNameError: if there is no such skill, or no such object in the scene.
            ConfigurationError: if the arguments do not fit the skill.
            MissingDependencyError: without MuJoCo, or the models of the arms.
        """
        before = self._started()
        self.domain.check_instance(instance, self.scene)
        reason = self.obstacle(before, instance)
        if reason is not None:
            return Outcome(False, self.observe(), reason, changed=False)
        try:
            self.skills.run(instance)
        except MotionFailed as failed:
            reason = str(failed)
            self.motion.retreat()
        after = self._state = self.table.state()
        reason = reason or self._mishap(before, after, instance)
        return Outcome(reason is None, self.observe(), reason or "", changed=before != after)

    def draw(self, state: State, layout: int) -> Picture:
        """The table as it is now."""
        return self.photo()

    @cached_property
    def motion(self) -> PhysicsMotion:
        """By forces."""
        return PhysicsMotion(self.table.world, self.troubles)

    def _mishap(self, before: State, after: State, instance: SkillInstance) -> str | None:
        """What is not as the skill should have left it."""
        if after != self.effect(before, instance):
            return f"after {instance} the table is not as it should be"
        return self.table.displaced()
