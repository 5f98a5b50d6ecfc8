"""From the results of cells to figures of methods: means, deviations, causes, comparisons."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.problems.problems import ProblemClass
from skillwrapper.evaluation.problems.results import Judge, ProblemResult


@dataclass(frozen=True)
class Spread:
    """A figure over seeds.

    Attributes:
        mean: arithmetic mean.
        std: sample standard deviation; 0 for a single seed.
        count: number of seeds that have the figure.
    """

    mean: float
    std: float
    count: int

    @classmethod
    def of(cls, values: Iterable[float | None]) -> Spread | None:
        """The spread of the values that are there; None if none is."""
        known = [value for value in values if value is not None]
        if not known:
            return None
        std = statistics.stdev(known) if len(known) > 1 else 0.0
        return cls(statistics.fmean(known), std, len(known))

    def to_json(self) -> dict[str, float]:
        """Mean and standard deviation as plain data."""
        return {"mean": round(self.mean, 6), "std": round(self.std, 6)}


Figure = Callable[[CellResult], float | None]

EASY, HARD, IMPOSSIBLE = ProblemClass


def _solved(kind: ProblemClass) -> Figure:
    return lambda cell: _share([p.solved for p in _of(cell, kind)])


def _budget(kind: ProblemClass) -> Figure:
    return lambda cell: _mean([p.budget for p in _of(cell, kind)])


def _planning_time(kind: ProblemClass) -> Figure:
    def figure(cell: CellResult) -> float | None:
        # A method without a planner has no planning time, which is not a time of 0 seconds.
        return _mean([p.planning_seconds for p in _of(cell, kind)]) if cell.exact else None

    return figure


def _exact(key: str) -> Figure:
    return lambda cell: cell.exact[key] if cell.exact else None


def _learning(key: str) -> Figure:
    return lambda cell: cell.learning.get(key)


def _efficiency(key: str) -> Figure:
    return lambda cell: cell.efficiency[key] if cell.efficiency else None


def _cost(part: str, key: str) -> Figure:
    def figure(cell: CellResult) -> float | None:
        found = cell.costs.get(part)
        return found[key] if found else None

    return figure


def _verdict(name: str) -> Figure:
    def figure(cell: CellResult) -> float | None:
        verdict = cell.exact.get(name) if cell.exact else None
        return None if verdict is None else 100 * float(verdict)

    return figure


def _vocabulary(cell: CellResult) -> float | None:
    found = cell.exact.get("vocabulary") if cell.exact else None
    return found["share"] if found else None


def _falsely_impossible(cell: CellResult) -> float | None:
    solvable = [p for p in cell.problems if p.kind is not IMPOSSIBLE]
    return _share([p.claimed_impossible for p in solvable])


def _attempts(cell: CellResult) -> float | None:
    """Plans that were run before it was claimed that there is no solution."""
    return _mean([p.attempts for p in cell.problems if p.claimed_impossible])


def _length_ratio(cell: CellResult) -> float | None:
    return _mean([p.length / p.optimal for p in cell.problems if p.length and p.optimal])


FIGURES: Final[Mapping[str, Figure]] = MappingProxyType(
    {
        "easy": _solved(EASY),
        "hard": _solved(HARD),
        "impossible": _solved(IMPOSSIBLE),
        "budget_easy": _budget(EASY),
        "budget_hard": _budget(HARD),
        "falsely_impossible": _falsely_impossible,
        "attempts": _attempts,
        "length_ratio": _length_ratio,
        "precision": _exact("precision"),
        "recall": _exact("recall"),
        "effect_accuracy": _exact("effect_accuracy"),
        "sound": _verdict("sound"),
        "complete": _verdict("complete"),
        "suitable": _verdict("suitable"),
        "vocabulary": _vocabulary,
        "predicates": _exact("predicates"),
        "operators": _exact("operators"),
        "lemma1_violations": _learning("lemma1_violations"),
        "theorem1_violations": _learning("theorem1_violations"),
        "inconsistencies": _learning("inconsistencies"),
        "unresolved": _learning("unresolved"),
        "learning_executions": _learning("executions"),
        "learning_successes": _learning("successes"),
        "learning_calls": _cost("learning", "calls"),
        "learning_cost": _cost("learning", "cost"),
        "learning_seconds": _learning("seconds"),
        "area": _efficiency("area"),
        "changing": _efficiency("changing"),
        "pairs_covered": _efficiency("pairs_covered"),
        "executions": lambda cell: float(sum(p.executions for p in cell.problems)),
        "successes": lambda cell: float(sum(p.successes for p in cell.problems)),
        "calls": lambda cell: float(sum(p.calls for p in cell.problems)),
        "cost": _cost("solving", "cost"),
        "planning_easy": _planning_time(EASY),
        "planning_hard": _planning_time(HARD),
        "planning_impossible": _planning_time(IMPOSSIBLE),
        "solving_seconds": lambda cell: sum(p.seconds for p in cell.problems),
        "seconds": lambda cell: cell.seconds,
    }
)
"""Figures of a cell by name. Shares of problems and verdicts in percent, times in seconds, costs in
US dollars; None if there is no such figure, e.g. no budget of a method that makes no plans."""

COSTS: Final[Mapping[str, str]] = MappingProxyType(
    {"cost": "calls", "learning_cost": "learning_calls"}
)
"""Figures that may be unknown, each with the one that says whether there is anything to know. A
cost that is unknown for one seed is unknown for the method: the others' mean would be too low."""


CHECKED: Final = frozenset(
    {"precision", "recall", "effect_accuracy", "sound", "complete", "suitable", "vocabulary"}
)
"""Figures of models that are checked in every state; undefined where there is nothing to count."""


@dataclass(frozen=True)
class MethodFigures:
    """A method on one domain with one noise.

    Attributes:
        method: its name.
        domain: the domain.
        noise: the noise.
        seeds: the seeds whose cells are finished.
        figures: by name, see ``FIGURES``; None if there is none.
        causes: how often each cause kept a problem from being solved, over all seeds.
        is_checked: whether the models were checked in every state.
        judged_by_model: how many problems, over all seeds, only the model itself could judge.
    """

    method: str
    domain: str
    noise: str
    seeds: tuple[int, ...]
    figures: Mapping[str, Spread | None]
    causes: Mapping[str, int]
    is_checked: bool = False
    judged_by_model: int = 0

    @classmethod
    def of(cls, cells: Sequence[CellResult]) -> MethodFigures:
        """The figures of the cells of all seeds, at least one."""
        first = cells[0].cell
        causes = Counter(str(p.cause) for c in cells for p in c.problems if p.cause is not None)
        return cls(
            method=first.method,
            domain=first.domain,
            noise=first.noise,
            seeds=tuple(c.cell.seed for c in cells),
            figures={name: _spread(name, cells) for name in FIGURES},
            causes=dict(sorted(causes.items())),
            is_checked=any(c.exact is not None for c in cells),
            judged_by_model=sum(p.judge is Judge.MODEL for c in cells for p in c.problems),
        )

    def is_unknown(self, name: str) -> bool:
        """Whether there is such a figure, but nobody knows it."""
        return self.figures[name] is None and self.figures.get(COSTS.get(name, "")) is not None

    def is_undefined(self, name: str) -> bool:
        """Whether the model was checked in every state, but this figure is of nothing."""
        return self.figures[name] is None and self.is_checked and name in CHECKED

    def to_json(self) -> dict[str, Any]:
        """Plain data: each figure an object with ``mean`` and ``std``, or null."""
        spreads = {name: s.to_json() if s else None for name, s in self.figures.items()}
        return {
            "method": self.method,
            "domain": self.domain,
            "noise": self.noise,
            "seeds": list(self.seeds),
            **spreads,
            "causes": dict(self.causes),
            "judged_by_model": self.judged_by_model,
        }


def group_cells(cells: Iterable[CellResult]) -> dict[tuple[str, str], dict[str, list[CellResult]]]:
    """Cells by (domain, noise), then by method."""
    groups: dict[tuple[str, str], dict[str, list[CellResult]]] = {}
    for result in cells:
        methods = groups.setdefault((result.cell.domain, result.cell.noise), {})
        methods.setdefault(result.cell.method, []).append(result)
    return groups


def _spread(name: str, cells: Sequence[CellResult]) -> Spread | None:
    values = [FIGURES[name](cell) for cell in cells]
    return None if name in COSTS and None in values else Spread.of(values)


def _of(cell: CellResult, kind: ProblemClass) -> list[ProblemResult]:
    return [p for p in cell.problems if p.kind is kind]


def _share(values: Sequence[bool]) -> float | None:
    return 100 * sum(values) / len(values) if values else None


def _mean(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return statistics.fmean(known) if known else None
