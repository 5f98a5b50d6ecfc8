"""Using what was learned: read pictures, plan, and say what a skill would bring about."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

from skillwrapper.grounding import UNKNOWN, AtomSpace, GroundModel, Labels
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.planning.export import Dialect, Export, Task, export
from skillwrapper.planning.goals import Goal, goal_from_state, parse_goal
from skillwrapper.planning.hypotheses.doubtful_planner import DoubtfulPlanner
from skillwrapper.planning.hypotheses.settings import HypothesesSettings
from skillwrapper.planning.planner import Planner, PlannerSettings
from skillwrapper.planning.result import PlanningResult
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.model_sessions import CallCounter, open_session
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel, Operator, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.vlm.protocol import VisionLanguageModel
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.pictures import Look, observation_of
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance, parse_skill_instance


@dataclass(frozen=True)
class Expectation:
    """What the model says of one skill in one state.

    Attributes:
        succeeds: True if an operator surely applies, False if none can, None if that hangs on
            what is unknown.
        state: what is true afterwards; the same as before unless it surely succeeds.
    """

    succeeds: bool | None
    state: AbstractState


class LearnedModel:
    """A learned model, ready for use; a context manager, because reading may open models.

    Args:
        model: predicates and operators.
        settings: of the run that learned it: which models read pictures.
        reader: answers in place of these models; None to open them when a picture is read.
        store: file of a call store that keeps what is asked; None to keep nothing.
        episodes: tells what it was learned from; None if that is not known.
    """

    def __init__(
        self,
        model: AbstractModel,
        settings: RunSettings,
        *,
        reader: VisionLanguageModel | None = None,
        store: Path | None = None,
        episodes: Callable[[], Sequence[Episode]] | None = None,
    ) -> None:
        self.model = model
        self.settings = settings
        self._reader, self._store = reader, store
        self._episodes = episodes or tuple
        self._resources = ExitStack()

    @classmethod
    def load(cls, run: Path | str, *, model: VisionLanguageModel | None = None) -> LearnedModel:
        """The model at the end of the last finished iteration of a run.

        Args:
            run: folder of the run.
            model: reads pictures in place of the model that the run asked.

        Raises:
            UserError: if there is no run, no iteration is finished, or a file is damaged.
        """
        archive = RunArchive.open(Path(run))
        learned = archive.latest().model
        return cls(
            learned,
            archive.settings(),
            reader=model,
            store=archive.layout.calls,
            episodes=archive.episodes,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the models that were opened for reading; may be called twice."""
        self._resources.close()

    @property
    def domain(self) -> Domain:
        """Types, objects and skills."""
        return self.model.domain

    @property
    def predicates(self) -> tuple[Predicate, ...]:
        """The learned predicates."""
        return self.model.predicates

    @property
    def operators(self) -> tuple[Operator, ...]:
        """The learned operators."""
        return self.model.operators

    @property
    def calls(self) -> CallCounter:
        """How often models were asked."""
        return self._reading[1]

    def read(self, seen: Look, *, scene: Scene | str | None = None) -> AbstractState:
        """What is true in a picture.

        Args:
            seen: a picture (array, bytes, path of a file), pictures by the names of their
                cameras, or an observation.
            scene: what is present, or the name of one of the domain's scenes; None for its first.

        Raises:
            UserError: if there is no such picture or scene.
            ProviderError: if a model does not answer.
        """
        present = self._scene(scene)
        space = self._ground(present).space
        labels = self._reading[0].labels(space, [observation_of(seen)])[0]
        return AbstractState(present, space, labels)

    def goal(
        self,
        wanted: Look | AbstractState | Goal,
        *,
        scene: Scene | str | None = None,
        positive_only: bool = False,
    ) -> Goal:
        """A goal of a scene.

        Args:
            wanted: a goal; a text such as ``(and (is_open drawer))``; a state; or a picture, as
                an observation or the path of an image file.
            scene: as in ``read``.
            positive_only: of a state or a picture take what is true only.

        Raises:
            UserError: if it is no goal of the scene, or there is no such picture.
            ProviderError: if a model does not answer.
        """
        if isinstance(wanted, Goal):
            return wanted
        if isinstance(wanted, str) and not is_picture_file(wanted):
            space = self._ground(self._scene(scene)).space
            return parse_goal(wanted, space, self.domain.types.names)
        state = wanted if isinstance(wanted, AbstractState) else self.read(wanted, scene=scene)
        return goal_from_state(state.space, state.labels, positive_only=positive_only)

    def plan(
        self,
        start: Look | AbstractState,
        goal: Look | AbstractState | Goal,
        *,
        scene: Scene | str | None = None,
        plans: int = 10,
        time_limit: float = 30.0,
        keep_files: Path | None = None,
    ) -> PlanningResult:
        """Skill plans from a start to a goal, the shortest ones first.

        Args:
            start: a state, or a picture.
            goal: as in ``goal``.
            scene: as in ``read``; that of the start if it is a state.
            plans: how many at most.
            time_limit: seconds for the planner.
            keep_files: a folder to write the problem into as PDDL.

        Raises:
            UserError: if start or goal are not what they should be.
            ProviderError: if a model does not answer.
        """
        state = start if isinstance(start, AbstractState) else self.read(start, scene=scene)
        wanted = self.goal(goal, scene=state.scene)
        planner = Planner(PlannerSettings(plans=plans, time_limit=time_limit))
        objects = state.scene.objects
        return planner.plan(self.model, objects, state.labels, wanted, keep_files=keep_files)

    def space(self, scene: Scene | str | None = None) -> AtomSpace:
        """The ground atoms of a scene.

        Args:
            scene: as in ``read``.
        """
        return self._ground(self._scene(scene)).space

    def doubts(self, settings: HypothesesSettings | None = None) -> DoubtfulPlanner:
        """Plans under doubt, with what the record tells of readings and of states.

        Pictures that it was learned from are read; what was asked before is not asked again.

        Args:
            settings: how many hypotheses are kept.

        Raises:
            UserError: if the record is damaged.
            ProviderError: if a model does not answer.
        """
        priors = self.settings.perception.decoding
        recorded = RecordedTransitions.of(self.domain, self._episodes())
        acquaintance = Acquaintance.from_record(recorded, self._reading[0], self.predicates, priors)
        return DoubtfulPlanner(self.model, acquaintance, settings or HypothesesSettings(), priors)

    def export(
        self,
        dialect: Dialect | str,
        start: Look | AbstractState | None = None,
        goal: Look | AbstractState | Goal | None = None,
        *,
        scene: Scene | str | None = None,
    ) -> Export:
        """The model, and a problem if there are start and goal, for other planners.

        Args:
            dialect: for whom: ``"pddl"``, ``"up"`` or ``"plansys2"``.
            start: a state, or a picture; what is unknown of it is written as false.
            goal: as in ``goal``.
            scene: as in ``read``; that of the start if it is a state.

        Raises:
            UserError: if start or goal are not what they should be, or an operator cannot be told
                to planners of that kind.
            ProviderError: if a model does not answer.
        """
        if start is None or goal is None:
            return export(self.model, self._scene(scene), Dialect(dialect), None)
        state = start if isinstance(start, AbstractState) else self.read(start, scene=scene)
        task = Task(state.true, self.goal(goal, scene=state.scene))
        return export(self.model, state.scene, Dialect(dialect), task)

    def expected(self, state: AbstractState, skill: SkillInstance | str) -> Expectation:
        """What the model says of running a skill.

        Args:
            state: where it is run.
            skill: e.g. ``"Pick(robot, cup)"``.

        Raises:
            UserError: if there is no such skill instance in the scene.
        """
        instance = parse_skill_instance(skill) if isinstance(skill, str) else skill
        self.domain.check_instance(instance, state.scene)
        found = list(self._ground(state.scene).bind(state.labels[np.newaxis], [instance]))
        sure = [bindings.sure for bindings in found if len(bindings.sure)]
        if sure:
            after: Labels = sure[0].successors()[0]
            return Expectation(True, AbstractState(state.scene, state.space, after))
        hangs = any((bindings.applicability == UNKNOWN).any() for bindings in found)
        return Expectation(None if hangs else False, state)

    @cached_property
    def _reading(self) -> tuple[TruthTable, CallCounter]:
        """Reads pictures, each once; opens the models."""
        session = self._resources.enter_context(
            open_session(self.settings, self._store, model=self._reader, learning=False)
        )
        return TruthTable(self.domain, session.assistant), session.counter

    def _scene(self, scene: Scene | str | None) -> Scene:
        return scene if isinstance(scene, Scene) else self.domain.scene(scene)

    def _ground(self, scene: Scene) -> GroundModel:
        return GroundModel.of(self.model, scene.objects)


def is_picture_file(text: str) -> bool:
    """Whether a text is the name of an image file, by its ending."""
    return Path(text).suffix.lower() in {".png", ".jpg", ".jpeg", ".bmp", ".webp"}
