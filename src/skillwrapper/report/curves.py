"""The learning curve of a run: how it went with the number of executions."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from skillwrapper.report.charts import LineChart, Series
from skillwrapper.report.history import Iteration, RunHistory
from skillwrapper.runs.archive.records import CurvePointRecord

_EXACT = ("recall", "precision", "effect_accuracy")

Measure = Callable[[Iteration], float | None]


def learning_charts(
    history: RunHistory, curve: Sequence[CurvePointRecord]
) -> tuple[LineChart, ...]:
    """Charts of vocabulary, operators, inconsistencies, successes, coverage and exact truth.

    Args:
        history: of the run.
        curve: exact figures; empty if they were not measured.
    """
    steps = history.iterations
    model: list[tuple[str, Measure]] = [
        ("predicates", lambda step: step.summary.predicates),
        ("operators", lambda step: step.summary.operators),
    ]
    left: list[tuple[str, Measure]] = [
        ("inconsistencies", lambda step: step.summary.inconsistencies)
    ]
    exploration: list[tuple[str, Measure]] = [
        ("skills that succeed", lambda step: step.successes / max(1, step.executions)),
        ("pairs of skills covered", lambda step: step.summary.pairs_covered),
    ]
    charts = [
        _chart("The model", model, steps),
        _chart("Inconsistencies left", left, steps),
        _chart("Exploration", exploration, steps, share=True),
    ]
    if curve:
        charts.append(_exact_chart(curve))
    return tuple(chart for chart in charts if any(s.points for s in chart.series))


def _chart(
    title: str,
    measures: Sequence[tuple[str, Measure]],
    steps: Sequence[Iteration],
    *,
    share: bool = False,
) -> LineChart:
    series = []
    for label, measure in measures:
        pairs = ((step.summary.executions, measure(step)) for step in steps)
        series.append(Series(label, tuple((float(x), float(y)) for x, y in pairs if y is not None)))
    return LineChart(title, tuple(series), share)


def _exact_chart(curve: Sequence[CurvePointRecord]) -> LineChart:
    series = tuple(
        Series(
            name.replace("_", " "),
            tuple(
                (float(point.executions), float(value))
                for point in curve
                if (value := getattr(point, name)) is not None
            ),
        )
        for name in _EXACT
    )
    return LineChart("Exact truth", tuple(s for s in series if s.points), share=True)
