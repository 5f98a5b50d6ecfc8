"""What methods that are compared have in common: they prepare in a cell, then solve problems."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.exact.exact_states import ExactStates
from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.evaluation.exact.learning_curves import Stage
from skillwrapper.evaluation.exact.state_readers import StateReader
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.evaluation.problems.solving import ModelSolver
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.planning.hypotheses.doubtful_planner import DoubtfulPlanner
from skillwrapper.planning.planner import Planner
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode


@dataclass(frozen=True)
class CellContext:
    """What a method gets to work with in one cell.

    Attributes:
        cell: the cell.
        settings: those of all cells.
        folder: where the method may write.
        source: folder of the finished cell whose data the method learns from, if it asks for one.
        environment: the domain's robot or simulator.
        package: what else is known of the domain, for baselines that are given that.
        exact: all its states, as far as they can be listed.
    """

    cell: Cell
    settings: ExperimentSettings
    folder: Path
    source: Path | None
    environment: Environment
    package: DomainPackage
    exact: ExactStates

    def config(self) -> RunSettings:
        """A run of the whole method in this cell."""
        return self.settings.run(self.cell.domain, self.cell.seed, self.cell.noise)

    @property
    def world(self) -> ProblemWorld:
        """Where problems are set up."""
        facts = self.package.system_predicates if self.package.has("system_predicates") else ()
        return ProblemWorld(self.environment, facts)

    def solver(
        self,
        model: AbstractModel,
        reader: StateReader,
        truth: Sequence[LabelledStates],
        calls: Callable[[], int] = lambda: 0,
        acquaintance: Callable[[], Acquaintance] | None = None,
    ) -> ModelSolver:
        """A solver with a model and a planner.

        Args:
            model: the model.
            reader: reads start and goal.
            truth: all states with labels without error, to tell causes; may be empty.
            calls: how many questions were put to models so far.
            acquaintance: what is known of readings and of states; None where nothing is misread.

        Raises:
            MissingDependencyError: if the planner is not installed.
        """
        by_scene = {labelled.states.scene.name: labelled for labelled in truth}
        planner = Planner(self.settings.planner)
        planner.engine.check_installed()
        doubts = None
        if acquaintance is not None and self.settings.readings == "hypotheses":
            priors = self.settings.perception.decoding
            doubts = DoubtfulPlanner(model, acquaintance(), self.settings.hypotheses, priors)
        return ModelSolver(self.world, model, reader, planner, by_scene, calls, doubts)


class Solver(Protocol):
    """Solves problems."""

    def solve(self, problem: Problem) -> ProblemResult:
        """Solve one problem."""
        ...


@dataclass(frozen=True)
class Prepared:
    """A method that is ready for problems.

    Attributes:
        solver: solves them.
        stages: its models, the last one being what it solves with; none for methods without.
        exact: all states with labels without error, for exact figures; empty where there are none.
        episodes: what was executed for learning.
        recorded: the labels of the recorded pictures that it learned from.
        absences: whether it learns universal absences.
        figures: what learning took and brought, as plain data.
        run: the folder of its own run; None for methods that learn in none.
        calls: the folder that keeps its model calls; None for methods that ask no model.
    """

    solver: Solver
    stages: tuple[Stage, ...] = ()
    exact: tuple[LabelledStates, ...] = ()
    episodes: tuple[Episode, ...] = ()
    recorded: TruthSource | None = None
    absences: bool = True
    figures: Mapping[str, Any] = field(default_factory=dict)
    run: RunArchive | None = None
    calls: RunArchive | None = None


@dataclass(frozen=True)
class Shares:
    """Who does what in a method; every table says so (docs/semantics.md, D25).

    Attributes:
        model: what the model answers.
        system: what the package does with it.
        decided_by_model: whether the figures rest on what the model proposes rather than on what
            the package makes of it; a constant of the stand-in then decides them.
    """

    model: str
    system: str
    decided_by_model: bool = False


class Method(Protocol):
    """A method to compare."""

    @property
    def name(self) -> str:
        """Short, as in experiment files."""
        ...

    @property
    def title(self) -> str:
        """As in tables."""
        ...

    @property
    def source(self) -> str | None:
        """Name of the method from whose recorded data this one learns; None for its own."""
        ...

    @property
    def shares(self) -> Shares:
        """What the model carries, and what the package."""
        ...

    def prepare(self, context: CellContext) -> AbstractContextManager[Prepared]:
        """Learn, or whatever else comes before problems; resumes what was begun."""
        ...
