"""The figures of learners as Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

_FIGURES = {
    "applicability_precision": "applicability precision",
    "applicability_recall": "recall",
    "effects_precision": "effects precision",
    "effects_recall": "recall",
    "solved": "solved",
    "seconds_median": "CPU s (median)",
}


def markdown(means: Mapping[str, Any], rows: Sequence[Mapping[str, Any]], seconds: int) -> str:
    """Means by learner, then recall and problems by domain."""
    lines = [
        f"| learner | {' | '.join(_FIGURES.values())} | domains failed |",
        "|---" * (len(_FIGURES) + 2) + "|",
    ]
    for learner, found in means.items():
        cells = [_cell(found.get(key)) for key in _FIGURES]
        lines.append(f"| {learner} | {' | '.join(cells)} | {found['failed']} |")
    lines += ["", *_by_domain(list(means), rows, solved=bool(seconds))]
    return "\n".join(lines) + "\n"


def _by_domain(
    learners: Sequence[str], rows: Sequence[Mapping[str, Any]], *, solved: bool
) -> list[str]:
    what = "recall / solved" if solved else "recall"
    lines = [
        f"Applicability {what} by domain:",
        "",
        f"| domain | {' | '.join(learners)} |{' true domain |' if solved else ''}",
        "|---" * (len(learners) + 1 + solved) + "|",
    ]
    for domain in dict.fromkeys(row["domain"] for row in rows):
        own = {row["learner"]: row for row in rows if row["domain"] == domain}
        cells = [_pair(own[learner], solved=solved) for learner in learners]
        if solved:
            cells.append(_cell(next(iter(own.values())).get("true_solved")))
        lines.append(f"| {domain} | {' | '.join(cells)} |")
    return lines


def _pair(row: Mapping[str, Any], *, solved: bool) -> str:
    if "failed" in row:
        return "failed"
    recall = _cell(row["applicability_recall"])
    return f"{recall} / {_cell(row.get('solved'))}" if solved else recall


def _cell(value: float | None) -> str:
    return "" if value is None else f"{value:.3f}"
