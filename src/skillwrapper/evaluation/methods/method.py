"""What methods that are compared have in common: they prepare in a cell, then solve problems."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.exact.learning_curves import Stage
from skillwrapper.evaluation.exact.state_truth import StateTruth
from skillwrapper.evaluation.problems.problems import Problem
from skillwrapper.evaluation.problems.readers import StateReader
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.evaluation.problems.solving import ModelSolver
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.planning.planner import Planner, PlannerSettings
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.settings import ModelSettings, RunSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.world.capabilities import Enumerable
from skillwrapper.world.episode import Episode


@dataclass(frozen=True)
class Cell:
    """One method on one domain with one seed and one noise.

    Attributes:
        method: name of the method.
        domain: name of the domain.
        seed: decides everything left to chance.
        noise: name of a noise profile of the embedded model, or a rate.
    """

    method: str
    domain: str
    seed: int
    noise: str

    @property
    def name(self) -> str:
        """Unique in an experiment; also the name of its folder."""
        return f"{self.method}-{self.domain}-s{self.seed}-{self.noise}"


class CellSettings(BaseModel):
    """What is equal in all cells of an experiment.

    Attributes:
        model: which model answers, e.g. ``embedded`` or ``openai:gpt-5``.
        iterations: of learning methods, unless the method itself says.
        budget: skills executed in an iteration.
        time_limit: seconds for the planner and one problem.
        actions: skills that a method without a planner may execute for one problem.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    model: str = "embedded"
    iterations: int = Field(default=10, ge=1)
    budget: int = Field(default=30, ge=1)
    time_limit: float = Field(default=10.0, gt=0.0, allow_inf_nan=False)
    actions: int = Field(default=35, ge=1)


@dataclass(frozen=True)
class Bench:
    """What a method gets to work with in one cell.

    Attributes:
        cell: the cell.
        settings: those of all cells.
        folder: where the method may write.
        source: folder of the finished cell whose data the method learns from, if it asks for one.
        environment: the domain.
        package: what else is known of it, for baselines that are given that.
        truth: labels without error, for finding causes and for exact figures.
    """

    cell: Cell
    settings: CellSettings
    folder: Path
    source: Path | None
    environment: Enumerable
    package: DomainPackage
    truth: StateTruth

    def config(self) -> RunSettings:
        """A run of the whole method in this cell."""
        return RunSettings(
            domain=self.cell.domain,
            seed=self.cell.seed,
            iterations=self.settings.iterations,
            exploration=ExplorationSettings(budget=self.settings.budget),
            model=ModelSettings(name=self.settings.model, noise=self.cell.noise),
        )

    def solver(
        self,
        model: AbstractModel,
        reader: StateReader,
        truth: StateReader,
        calls: Callable[[], int] = lambda: 0,
    ) -> ModelSolver:
        """A solver with a model and K*."""
        planner = Planner(PlannerSettings(time_limit=self.settings.time_limit))
        return ModelSolver(self.environment, self.truth.space, model, reader, truth, planner, calls)


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
        label_all: labels of all states (states, atoms) without error, for exact figures.
        episodes: what was executed for learning.
        recorded: the labels of the recorded pictures that it learned from.
        absences: whether it learns universal absences.
        figures: what learning took and brought, as plain data.
        run: the folder of its own run; None for methods that learn in none.
        calls: the folder that keeps its model calls; None for methods that ask no model.
    """

    solver: Solver
    stages: tuple[Stage, ...] = ()
    label_all: Callable[[AtomSpace], Labels] | None = None
    episodes: tuple[Episode, ...] = ()
    recorded: TruthSource | None = None
    absences: bool = True
    figures: Mapping[str, Any] = field(default_factory=dict)
    run: RunArchive | None = None
    calls: RunArchive | None = None


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

    def prepare(self, bench: Bench) -> AbstractContextManager[Prepared]:
        """Learn, or whatever else comes before problems; resumes what was begun."""
        ...
