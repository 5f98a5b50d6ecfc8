"""The tables of an experiment: what stands in them, and what must be said with them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from skillwrapper.evaluation.benchmark.comparisons import PairedComparison
from skillwrapper.evaluation.benchmark.figures import CHECKED, MethodFigures, Spread
from skillwrapper.evaluation.methods.cell import domain_key
from skillwrapper.evaluation.methods.method import Shares
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.published import PublishedMethod, PublishedResults

_UNTESTED = (
    "No p-value where the proposals of the stand-in model decide: it would test a constant of ours."
)

# Title, and for each column its heading, its figure and the number of decimals.
_LAYOUTS: tuple[tuple[str, tuple[tuple[str, str, int], ...]], ...] = (
    (
        "Problems solved",
        (
            ("easy %", "easy", 1),
            ("budget", "budget_easy", 1),
            ("hard %", "hard", 1),
            ("budget", "budget_hard", 1),
            ("impossible %", "impossible", 1),
            ("falsely impossible %", "falsely_impossible", 1),
            ("plans before the claim", "attempts", 2),
            ("length / optimal", "length_ratio", 2),
        ),
    ),
    (
        "The model, checked in every state",
        (
            ("precision", "precision", 3),
            ("recall", "recall", 3),
            ("effect accuracy", "effect_accuracy", 3),
            ("sound %", "sound", 0),
            ("complete %", "complete", 0),
            ("suitable %", "suitable", 0),
            ("vocabulary", "vocabulary", 3),
            ("predicates", "predicates", 1),
            ("operators", "operators", 1),
        ),
    ),
    (
        "The certificate, on the recorded data",
        (
            ("Lemma 1 violations", "lemma1_violations", 1),
            ("Theorem 1 violations", "theorem1_violations", 1),
            ("inconsistencies", "inconsistencies", 1),
            ("unresolved", "unresolved", 1),
        ),
    ),
    (
        "Exploration and learning",
        (
            ("executions", "learning_executions", 0),
            ("successes", "learning_successes", 0),
            ("model calls", "learning_calls", 0),
            ("cost, $", "learning_cost", 2),
            ("time, s", "learning_seconds", 0),
            ("area under recall", "area", 3),
            ("changed the model", "changing", 3),
            ("pairs covered", "pairs_covered", 3),
        ),
    ),
    (
        "Solving all problems",
        (
            ("executions", "executions", 0),
            ("successes", "successes", 0),
            ("model calls", "calls", 0),
            ("cost, $", "cost", 2),
            ("planning easy, s", "planning_easy", 3),
            ("planning hard, s", "planning_hard", 3),
            ("planning impossible, s", "planning_impossible", 3),
            ("solving, s", "solving_seconds", 0),
            ("whole cell, s", "seconds", 0),
        ),
    ),
)


@dataclass(frozen=True)
class Table:
    """A table of texts.

    Attributes:
        title: what it shows.
        headings: of the columns.
        rows: as many texts as headings each.
        note: what must be said with it; may be empty.
    """

    title: str
    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


def place(domain: str, noise: str) -> str:
    """Of what a table speaks, as in its title."""
    return f"{domain_key(domain)}, noise {noise}"


def group_tables(
    domain: str,
    noise: str,
    methods: Sequence[MethodFigures],
    comparisons: Sequence[PairedComparison],
    published: PublishedResults,
) -> tuple[Table, ...]:
    """The tables of one domain with one noise, without those that would be empty.

    Args:
        domain: reference to the domain.
        noise: the noise.
        methods: their figures, in the order of tables.
        comparisons: of methods with the main one.
        published: what others published of the domain.
    """
    where = place(domain, noise)
    first, *others = (
        _figures(f"{title} ({where})", methods, layout, published) for title, layout in _LAYOUTS
    )
    tables = (
        replace(first, note=" ".join(filter(None, (first.note, _judged(methods))))),
        _beside_published(where, methods, published),
        *others,
        _causes(where, methods),
        _comparisons(where, comparisons),
    )
    return tuple(table for table in tables if table.rows)


def _figures(
    title: str,
    methods: Sequence[MethodFigures],
    layout: Sequence[tuple[str, str, int]],
    published: PublishedResults,
) -> Table:
    """A table without the methods that have none of its figures."""
    shown = [m for m in methods if any(m.figures[name] is not None for _, name, _ in layout)]
    rows = tuple(
        (_title(m.method), *(_figure(m, name, decimals) for _, name, decimals in layout))
        for m in shown
    )
    headings = ("method", *(published.heading(heading) for heading, _, _ in layout))
    return Table(title, headings, rows, carried_by(m.method for m in shown))


def _beside_published(
    where: str, methods: Sequence[MethodFigures], published: PublishedResults
) -> Table:
    """Our figures and the paper's, of the methods that are in both."""
    names = tuple(PublishedMethod.model_fields)
    rows, shown = [], [m for m in methods if m.method in published.methods]
    for method in shown:
        row = published.methods[method.method]
        pairs = ((_figure(method, name, 1), _published(getattr(row, name))) for name in names)
        rows.append((_title(method.method), *(text for pair in pairs for text in pair)))
    headings = tuple(
        map(published.heading, ("easy %", "budget", "hard %", "budget", "impossible %"))
    )
    columns = ("method", *(text for heading in headings for text in (heading, "paper")))
    note = " ".join(filter(None, (published.note, carried_by(m.method for m in shown))))
    return Table(f"Beside the paper ({where})", columns, tuple(rows), note)


def _published(figure: tuple[float, float] | None) -> str:
    return "-" if figure is None else f"{figure[0]:.1f} ± {figure[1]:.1f}"


def _causes(where: str, methods: Sequence[MethodFigures]) -> Table:
    causes, shown = sorted({c for m in methods for c in m.causes}), [m for m in methods if m.causes]
    rows = tuple(
        (_title(m.method), *(str(m.causes.get(cause, 0)) for cause in causes)) for m in shown
    )
    title = f"Why problems were not solved, over all seeds ({where})"
    return Table(title, ("method", *causes), rows, carried_by(m.method for m in shown))


def _comparisons(where: str, comparisons: Sequence[PairedComparison]) -> Table:
    rows = tuple(
        (
            f"{_title(c.method)} - {_title(c.other)}",
            _show(c.difference, 1),
            str(c.wins),
            str(c.losses),
            "-" if c.p_value is None else f"{c.p_value:.3g}",
        )
        for c in comparisons
    )
    headings = ("methods", "difference, %", "only the first", "only the second", "p (McNemar)")
    names = dict.fromkeys(name for c in comparisons for name in (c.method, c.other))
    untested = _UNTESTED if any(c.p_value is None for c in comparisons) else ""
    note = " ".join(filter(None, (untested, carried_by(names))))
    return Table(f"Same problems, same seeds ({where})", headings, rows, note)


def carried_by(methods: Iterable[str]) -> str:
    """What the model contributes to the figures of methods, and what the package."""
    groups: dict[Shares, list[str]] = {}
    for name in methods:
        groups.setdefault(METHODS[name].shares, []).append(_title(name))
    parts = (
        f"{', '.join(titles)}: the model {shares.model}; the package {shares.system}."
        for shares, titles in groups.items()
    )
    return " ".join(("Who carries what:", *parts)) if groups else ""


def _judged(methods: Sequence[MethodFigures]) -> str:
    """Which solved problems are solved as far as the model can tell only."""
    counts = ", ".join(
        f"{_title(m.method)} {m.judged_by_model}" for m in methods if m.judged_by_model
    )
    return (
        f"Judged by the learned model alone, as the environment cannot tell (over all seeds): "
        f"{counts}."
        if counts
        else ""
    )


def _figure(method: MethodFigures, name: str, decimals: int) -> str:
    if method.is_unknown(name):
        return "unknown"
    if method.is_undefined(name):
        return "undefined"
    spread, seeds = method.figures[name], len(method.seeds)
    part = name in CHECKED and spread is not None and spread.count < seeds
    return _show(spread, decimals) + (
        f" ({spread.count} of {seeds} seeds)" if part and spread else ""
    )


def _show(spread: Spread | None, decimals: int) -> str:
    if spread is None:
        return "-"
    mean = f"{spread.mean:.{decimals}f}"
    return mean if spread.count < 2 else f"{mean} ± {spread.std:.{decimals}f}"


def _title(method: str) -> str:
    return METHODS[method].title
