"""The learning curve of a run: how it went with the number of executions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from skillwrapper.errors import RunFolderError
from skillwrapper.report.charts import LineChart, Series
from skillwrapper.report.history import Iteration, RunHistory, read_json

_EXACT = ("recall", "precision", "effect_accuracy")

Measure = Callable[[Iteration], float | None]


def learning_charts(history: RunHistory, curve_file: Path) -> tuple[LineChart, ...]:
    """Charts of vocabulary, operators, inconsistencies, successes, coverage and exact truth.

    Raises:
        RunFolderError: if the curve file is there but no curve.
    """
    steps = history.iterations

    def figure(key: str) -> Measure:
        return lambda step: step.summary.get(key)

    model = [("predicates", figure("predicates")), ("operators", figure("operators"))]
    left = [("inconsistencies", figure("inconsistencies"))]
    exploration: list[tuple[str, Measure]] = [
        ("skills that succeed", lambda step: step.successes / max(1, step.executions)),
        ("pairs of skills covered", figure("pairs_covered")),
    ]
    charts = [
        _chart("The model", model, steps),
        _chart("Inconsistencies left", left, steps),
        _chart("Exploration", exploration, steps, share=True),
    ]
    if curve_file.is_file():
        charts.append(_exact_chart(curve_file))
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
        pairs = ((step.summary["executions"], measure(step)) for step in steps)
        series.append(Series(label, tuple((float(x), float(y)) for x, y in pairs if y is not None)))
    return LineChart(title, tuple(series), share)


def _exact_chart(path: Path) -> LineChart:
    points = read_json(path)
    if not isinstance(points, list) or not all(_is_point(point) for point in points):
        raise RunFolderError(
            f"{path}: expected a list of objects with 'executions' and any of {', '.join(_EXACT)}"
        )
    series = tuple(
        Series(
            name.replace("_", " "),
            tuple((float(p["executions"]), float(p[name])) for p in points if name in p),
        )
        for name in _EXACT
    )
    return LineChart("Exact truth", tuple(s for s in series if s.points), share=True)


def _is_point(point: Any) -> bool:
    return isinstance(point, dict) and all(
        isinstance(point[key], int | float) for key in ("executions", *_EXACT) if key in point
    )
