"""Tables as Markdown, LaTeX and CSV."""

from __future__ import annotations

import csv
import io
import re

from skillwrapper.evaluation.benchmark.figures import FIGURES
from skillwrapper.evaluation.benchmark.summary import ExperimentSummary
from skillwrapper.evaluation.benchmark.tables import Table

_LATEX_SPECIAL = re.compile(r"[&%$#_{}]")


def to_markdown(summary: ExperimentSummary) -> str:
    """All tables, each under a heading."""
    parts = [f"# {summary.experiment.name}", summary.experiment.description, summary.note]
    parts.append("\n".join(f"- {label}: {text}" for label, text in summary.made))
    for table in summary.tables():
        parts.append(f"## {table.title}")
        ruler = ("---", *("---:" for _ in table.headings[1:]))
        lines = (table.headings, ruler, *table.rows)
        parts.append("\n".join(f"| {' | '.join(cells)} |" for cells in lines))
        parts.append(table.note)
    return "\n\n".join(filter(None, parts)) + "\n"


def to_latex(summary: ExperimentSummary) -> str:
    """All tables as ``tabular`` with the rules of the package ``booktabs``."""
    made = (f"% {label}: {text}" for label, text in summary.made)
    parts = ["\n".join((f"% {summary.experiment.name}: {summary.note}", *made))]
    parts += [_latex_table(table) for table in summary.tables()]
    return "\n\n".join(parts) + "\n"


def to_csv(summary: ExperimentSummary) -> str:
    """One line for each method, domain and noise, two columns for each figure."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    columns = [f"{name}_{part}" for name in FIGURES for part in ("mean", "std")]
    writer.writerow(["method", "domain", "noise", "seeds", *columns])
    for method in summary.methods:
        values: list[float | str] = []
        for name in FIGURES:
            spread = method.figures[name]
            values += ["", ""] if spread is None else [spread.mean, spread.std]
        writer.writerow([method.method, method.domain, method.noise, len(method.seeds), *values])
    return text.getvalue()


def _latex_table(table: Table) -> str:
    rows = [r" & ".join(map(_latex, row)) + r" \\" for row in (table.headings, *table.rows)]
    columns = "l" + "r" * (len(table.headings) - 1)
    lines = [
        *(f"% {text}" for text in (table.title, table.note) if text),
        rf"\begin{{tabular}}{{{columns}}}",
        r"\toprule",
        rows[0],
        r"\midrule",
        *rows[1:],
        r"\bottomrule",
        r"\end{tabular}",
    ]
    return "\n".join(lines)


def _latex(text: str) -> str:
    escaped = _LATEX_SPECIAL.sub(lambda found: "\\" + found[0], text)
    return escaped.replace("±", r"$\pm$")
