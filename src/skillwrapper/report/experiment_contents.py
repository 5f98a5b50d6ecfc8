"""Everything the report of an experiment says, gathered from its folder."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from statistics import fmean

from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment
from skillwrapper.evaluation.benchmark.figures import group_cells
from skillwrapper.evaluation.benchmark.summary import ExperimentSummary
from skillwrapper.evaluation.benchmark.tables import Table
from skillwrapper.evaluation.methods.cell import domain_key, domain_title
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.problems.problems import Problem
from skillwrapper.report.charts import LineChart, Series

_LONGEST_DETAIL = 240


@dataclass(frozen=True)
class Case:
    """A problem that a method did not solve, always for the same reason.

    Attributes:
        method: title of the method.
        noise: the noise.
        cause: the kind of cause.
        detail: in words.
        plan: the first plan, or what was executed.
        seeds: with which seeds.
    """

    method: str
    noise: str
    cause: str
    detail: str
    plan: tuple[str, ...]
    seeds: tuple[int, ...]


@dataclass(frozen=True)
class ProblemCases:
    """A problem with everything that went wrong in it.

    Attributes:
        domain: reference to the domain.
        problem: the problem.
        solved: how many cells solved it.
        tried: how many cells tried it.
        cases: those that did not.
    """

    domain: str
    problem: Problem
    solved: int
    tried: int
    cases: tuple[Case, ...]

    @property
    def title(self) -> str:
        """What the domain is called."""
        return domain_title(self.domain)


@dataclass(frozen=True)
class MatrixRow:
    """A method in the matrix of problems.

    Attributes:
        title: of the method.
        shares: share of its seeds that solved each problem; None for one that was not tried.
    """

    title: str
    shares: tuple[float | None, ...]


@dataclass(frozen=True)
class Group:
    """What is said of one domain with one noise.

    Attributes:
        domain: the domain.
        noise: the noise.
        charts: learning curves, the mean of all seeds.
        problems: names of the problems.
        matrix: a row for every method.
        tables: the tables.
    """

    domain: str
    noise: str
    charts: tuple[LineChart, ...]
    problems: tuple[str, ...]
    matrix: tuple[MatrixRow, ...]
    tables: tuple[Table, ...]


@dataclass(frozen=True)
class ExperimentContents:
    """What the report of an experiment says.

    Attributes:
        experiment: what was asked for.
        report: all figures.
        groups: by domain and noise.
        problems: the problems that some cell did not solve.
    """

    experiment: Experiment
    report: ExperimentSummary
    groups: tuple[Group, ...]
    problems: tuple[ProblemCases, ...]

    @classmethod
    def gather(cls, folder: ExperimentFolder) -> ExperimentContents:
        """Read the finished cells.

        Raises:
            RunFolderError: if a file is damaged.
        """
        experiment, cells = folder.experiment(), tuple(folder.results())
        report = ExperimentSummary.of(
            experiment, cells, folder.runs(), folder.published(), folder.failures()
        )
        groups = []
        for (domain, noise), by_method in group_cells(cells).items():
            mine = report.tables_of(domain, noise)
            ordered = {name: by_method[name] for name in METHODS if name in by_method}
            names = tuple(p.name for p in folder.problems(domain).problems)
            matrix = tuple(_row(name, found, names) for name, found in ordered.items())
            groups.append(Group(domain_key(domain), noise, _curves(ordered), names, matrix, mine))
        problems = tuple(
            found
            for domain in experiment.domains
            for problem in folder.problems(domain).problems
            if (found := _cases(domain, problem, cells)).cases
        )
        return cls(experiment, report, tuple(groups), problems)


def _row(method: str, cells: Sequence[CellResult], problems: Iterable[str]) -> MatrixRow:
    solved = [{p.problem: p.solved for p in cell.problems} for cell in cells]
    shares = ([one[name] for one in solved if name in one] for name in problems)
    return MatrixRow(METHODS[method].title, tuple(fmean(s) if s else None for s in shares))


def _curves(by_method: dict[str, list[CellResult]]) -> tuple[LineChart, ...]:
    """Exact recall, precision and effect accuracy over executions."""
    curves = {
        METHODS[name].title: [c.efficiency["curve"] for c in cells if c.efficiency]
        for name, cells in by_method.items()
    }
    charts = []
    for key in ("recall", "precision"):
        series = []
        for title, found in curves.items():
            steps = zip(*found, strict=False)
            points = [
                (s[0]["executions"], fmean(p[key] for p in s))
                for s in steps
                if all(p[key] is not None for p in s)
            ]
            if points:
                series.append(Series(title, tuple(points)))
        charts.append(LineChart(f"Exact {key}", tuple(series), share=True))
    return tuple(chart for chart in charts if chart.series)


@dataclass
class _Gathered:
    plan: tuple[str, ...]
    seeds: list[int] = field(default_factory=list)


def _cases(domain: str, problem: Problem, cells: Iterable[CellResult]) -> ProblemCases:
    """What went wrong in a problem; the same thing with several seeds is one case."""
    found: dict[tuple[str, str, str, str], _Gathered] = {}
    tried = solved = 0
    for cell in (c for c in cells if c.cell.domain == domain):
        for result in (p for p in cell.problems if p.problem == problem.name):
            tried, solved = tried + 1, solved + result.solved
            if not result.solved:
                key = (cell.cell.method, cell.cell.noise, str(result.cause), result.detail)
                found.setdefault(key, _Gathered(result.plan)).seeds.append(cell.cell.seed)
    order = {name: number for number, name in enumerate(METHODS)}
    cases = (
        Case(METHODS[method].title, noise, cause, _short(detail), one.plan, tuple(one.seeds))
        for (method, noise, cause, detail), one in sorted(
            found.items(), key=lambda item: (item[0][1], order[item[0][0]], item[0][2:])
        )
    )
    return ProblemCases(domain, problem, solved, tried, tuple(cases))


def _short(detail: str) -> str:
    return detail if len(detail) <= _LONGEST_DETAIL else f"{detail[:_LONGEST_DETAIL]} ..."
