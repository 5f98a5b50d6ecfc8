"""Plots of an experiment: learning curves, noise curves, problems by methods."""

from __future__ import annotations

import importlib
import io
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from skillwrapper.errors import MissingDependencyError
from skillwrapper.evaluation.benchmark.cells import CellResult
from skillwrapper.evaluation.benchmark.figures import FIGURES, Spread, group_cells
from skillwrapper.evaluation.benchmark.tables import place
from skillwrapper.evaluation.methods.cell import domain_key
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.files.writing import write_atomically

_INCHES = (7.5, 4.5)
_WIDE_INCHES = (11.0, 4.5)
_DOTS_PER_INCH = 150


def plot_experiment(cells: Sequence[CellResult], folder: Path) -> tuple[Path, ...]:
    """Write all plots that the finished cells give something for, as PNG.

    Args:
        cells: the finished cells.
        folder: where to write.

    Returns:
        The files written.

    Raises:
        MissingDependencyError: if matplotlib is not installed.
    """
    figure_of = _figure_class()
    written = []
    for (domain, noise), by_method in group_cells(cells).items():
        where, stem = place(domain, noise), f"{domain_key(domain)}-{noise}"
        curves = _learning_curves(figure_of, by_method, where)
        if curves is not None:
            written.append(_save(curves, folder / f"learning-{stem}.png"))
        if any(cell.problems for found in by_method.values() for cell in found):
            matrix = _problem_matrix(figure_of, by_method, where)
            written.append(_save(matrix, folder / f"problems-{stem}.png"))
    for domain in dict.fromkeys(c.cell.domain for c in cells):
        mine = [c for c in cells if c.cell.domain == domain]
        noise_curves = _noise_curves(figure_of, mine, domain_key(domain))
        if noise_curves is not None:
            written.append(_save(noise_curves, folder / f"noise-{domain_key(domain)}.png"))
    return tuple(written)


def _figure_class() -> Any:
    """Matplotlib's figure, without its global state and without any display."""
    try:
        return importlib.import_module("matplotlib.figure").Figure
    except ImportError as error:
        raise MissingDependencyError("matplotlib", "pip install 'skillwrapper[plot]'") from error


def _save(figure: Any, path: Path) -> Path:
    data = io.BytesIO()
    figure.savefig(data, dpi=_DOTS_PER_INCH, format="png")
    write_atomically(path, data.getvalue())
    return path


def _ordered(by_method: dict[str, list[CellResult]]) -> list[tuple[str, list[CellResult]]]:
    return [(name, by_method[name]) for name in METHODS if name in by_method]


def _style(method: str) -> dict[str, Any]:
    """The same line for a method in every plot; lines that coincide can still be told apart."""
    number = list(METHODS).index(method)
    return {
        "color": f"C{number}",
        "linestyle": ("-", "--", "-.", ":")[number % 4],
        "marker": "osv^D"[number % 5],
        "markersize": 4,
        "alpha": 0.85,
    }


def _learning_curves(
    figure_of: Any, by_method: dict[str, list[CellResult]], where: str
) -> Any | None:
    """Exact recall and precision over executions: mean, one standard deviation as a band.

    Recall alone would praise operators without preconditions, which "apply" everywhere.
    """
    learners = [
        (n, [c for c in cells if c.efficiency and c.efficiency["curve"]])
        for n, cells in _ordered(by_method)
    ]
    learners = [(name, cells) for name, cells in learners if cells]
    if not learners:
        return None
    figure = figure_of(figsize=_WIDE_INCHES, layout="constrained")
    figure.suptitle(f"What is learned from how many executions ({where})")
    for position, key in enumerate(("recall", "precision"), start=1):
        axes = figure.add_subplot(1, 2, position)
        for name, cells in learners:
            x, mean, std = _band(cells, key)
            axes.plot(x, mean, label=METHODS[name].title, **_style(name))
            low, high = np.clip(mean - std, 0, 1), np.clip(mean + std, 0, 1)
            axes.fill_between(x, low, high, alpha=0.12, color=_style(name)["color"], linewidth=0)
        axes.set(xlabel="skills executed", ylabel=f"exact {key}", ylim=(-0.02, 1.02))
        axes.grid(alpha=0.3)
    _add_legend(figure)
    return figure


def _band(cells: Sequence[CellResult], key: str) -> tuple[Any, Any, Any]:
    """Executions, mean and standard deviation of a figure of the learning curves."""
    curves = [cell.efficiency["curve"] for cell in cells if cell.efficiency]
    length = min(map(len, curves))
    values = np.array(
        [[point[key] for point in curve[:length]] for curve in curves], dtype=np.float64
    )  # None becomes nan, a gap
    x = np.array([point["executions"] for point in curves[0][:length]])
    std = values.std(axis=0, ddof=1) if len(curves) > 1 else np.zeros(length)
    return x, values.mean(axis=0), std


def _problem_matrix(figure_of: Any, by_method: dict[str, list[CellResult]], where: str) -> Any:
    """Methods by problems: the share of seeds that solved each."""
    methods = _ordered(by_method)
    problems = methods[0][1][0].problems
    names = [p.problem for p in problems]
    shares = np.array(
        [
            [
                np.mean([p.solved for c in cells for p in c.problems if p.problem == n])
                for n in names
            ]
            for _, cells in methods
        ]
    )
    width = max(_INCHES[0], 2.5 + 0.2 * len(names))
    figure = figure_of(figsize=(width, 2.0 + 0.3 * len(methods)), layout="constrained")
    axes = figure.add_subplot()
    image = axes.imshow(shares, vmin=0, vmax=1, cmap="cividis", aspect="auto")
    axes.set_yticks(range(len(methods)), [METHODS[name].title for name, _ in methods])
    axes.set_xticks(range(len(names)), names, rotation=90, fontsize=7)
    for number, (before, after) in enumerate(pairwise(problems)):
        if before.kind != after.kind:
            axes.axvline(number + 0.5, color="white", linewidth=3)
    axes.set_title(f"Share of seeds that solved a problem ({where})")
    figure.colorbar(image, ax=axes, fraction=0.02, pad=0.01)
    return figure


def _noise_curves(figure_of: Any, cells: Sequence[CellResult], domain: str) -> Any | None:
    """Problems solved over the error rate of perception; profiles that are no rate to the right."""
    noises = dict.fromkeys(c.cell.noise for c in cells)
    rates = sorted((100 * rate, n) for n in noises if (rate := _rate(n)) is not None)
    if len(rates) < 2:
        return None
    step = rates[-1][0] / 8
    profiles = [n for n in noises if _rate(n) is None]
    beside = [(rates[-1][0] + step * (k + 1.5), name) for k, name in enumerate(profiles)]
    figure = figure_of(figsize=_WIDE_INCHES, layout="constrained")
    figure.suptitle(f"Problems solved with wrong perception ({domain})")
    methods = [name for name in METHODS if any(c.cell.method == name for c in cells)]
    for position, kind in enumerate(("easy", "hard", "impossible"), start=1):
        axes = figure.add_subplot(1, 3, position)
        for number, name in enumerate(methods):
            mine = [c for c in cells if c.cell.method == name]
            shift = step / 5 * (number - (len(methods) - 1) / 2) / max(1, len(methods) - 1)
            _noise_line(axes, name, _spreads(mine, rates, kind, shift))
            _noise_line(axes, name, _spreads(mine, beside, kind, 3 * shift), joined=False)
        ticks = [*((x, f"{x:g}") for x, _ in rates if x == 0 or x >= step), *beside]
        axes.set_xticks(*zip(*ticks, strict=True), fontsize=8)
        axes.set(xlabel="wrong judgements, %", ylim=(-3, 103), title=kind)
        axes.grid(alpha=0.3)
    figure.axes[0].set_ylabel("solved, %")
    _add_legend(figure)
    return figure


def _noise_line(
    axes: Any, method: str, points: Sequence[tuple[float, Spread]], *, joined: bool = True
) -> None:
    """Means with a standard deviation to both sides, as far as percentages go."""
    if not points:
        return
    x, spreads = zip(*points, strict=True)
    mean = np.array([s.mean for s in spreads])
    std = np.array([s.std for s in spreads])
    bars = (np.minimum(std, mean), np.minimum(std, 100 - mean))
    line = {"label": METHODS[method].title} if joined else {"linestyle": "none"}
    axes.errorbar(x, mean, bars, capsize=2, elinewidth=0.8, **{**_style(method), **line})


def _spreads(
    cells: Sequence[CellResult], noises: Sequence[tuple[float, str]], kind: str, shift: float
) -> list[tuple[float, Spread]]:
    """A figure at every noise; shifted a little, so that methods do not hide each other."""
    found = [
        (x + shift, Spread.of(FIGURES[kind](c) for c in cells if c.cell.noise == noise))
        for x, noise in noises
    ]
    return [(x, spread) for x, spread in found if spread is not None]


def _rate(noise: str) -> float | None:
    try:
        return 0.0 if noise == "none" else float(noise)
    except ValueError:
        return None


def _add_legend(figure: Any) -> None:
    lines, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(lines, labels, fontsize=7, loc="outside right center", frameon=False)
