"""Styles of writing: how verdicts and candidates are put into text."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence

Verdicts = Sequence[tuple[str, bool | None]]
"""Statements with whether they are true; None if it cannot be told."""
Candidates = Sequence[tuple[str, Sequence[tuple[str, str]], str]]
"""Name, parameters (name and type) and meaning."""

_WORD = {True: "true", False: "false", None: "unsure"}


def _lines(verdicts: Verdicts) -> str:
    return "I see the objects.\n\n" + "\n".join(f"- {s}: {_WORD[v]}" for s, v in verdicts)


def _below(verdicts: Verdicts) -> str:
    word = {True: "True", False: "False", None: "Unsure"}
    return "\n\n".join(f"**{s}**\n{word[v]}" for s, v in verdicts)


def _json(verdicts: Verdicts) -> str:
    found = [{"statement": s, "verdict": v if v is not None else "unsure"} for s, v in verdicts]
    return f"```json\n{json.dumps(found, indent=1)}\n```"


def _table(verdicts: Verdicts) -> str:
    rows = "\n".join(f"| `{s}` | {_WORD[v].capitalize()} |" for s, v in verdicts)
    return f"| Statement | Verdict |\n|---|---|\n{rows}"


def _prose(verdicts: Verdicts) -> str:
    said = {True: "it is the case that {}.", False: "it is not the case that {}.",
            None: "I cannot tell whether {}."}  # fmt: skip
    return "Looking closely, " + " Then, ".join(said[v].format(s) for s, v in verdicts)


VERDICTS: Mapping[str, Callable[[Verdicts], str]] = {
    "lines": _lines, "below": _below, "json": _json, "table": _table, "prose": _prose,
}  # fmt: skip


def _signature(name: str, parameters: Sequence[tuple[str, str]]) -> str:
    return f"{name}({', '.join(f'?{t}' for _, t in parameters)})"


def _candidate_lines(candidates: Candidates) -> str:
    return "The pictures differ.\n\n" + "\n".join(
        f"{_signature(n, p)}: {meaning}" for n, p, meaning in candidates
    )


def _candidates_below(candidates: Candidates) -> str:
    return "\n\n".join(
        f"{number}. **{_signature(n, p)}**\n   {meaning}"
        for number, (n, p, meaning) in enumerate(candidates, start=1)
    )


def _candidates_json(candidates: Candidates) -> str:
    found = [
        {"name": n, "parameters": [{"name": v, "type": t} for v, t in p], "meaning": meaning}
        for n, p, meaning in candidates
    ]
    return f"```json\n{json.dumps({'predicates': found}, indent=1)}\n```"


def _candidate_table(candidates: Candidates) -> str:
    rows = "\n".join(f"| `{_signature(n, p)}` | {meaning} |" for n, p, meaning in candidates)
    return f"| Predicate | Meaning |\n|---|---|\n{rows}"


CANDIDATES: Mapping[str, Callable[[Candidates], str]] = {
    "lines": _candidate_lines, "below": _candidates_below, "json": _candidates_json,
    "table": _candidate_table, "prose": _candidate_lines,
}  # fmt: skip
STYLES = tuple(VERDICTS)
