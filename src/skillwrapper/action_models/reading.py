"""Traces of any of the formats that are read, by what their files look like."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from skillwrapper.action_models.json_traces import read_json_trace
from skillwrapper.action_models.partial_traces import Evidence
from skillwrapper.action_models.plan_files import Problem, is_plan, parse_plan, read_problem
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.trace_files import parse_trace
from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import read_text

_JSON = (".jsonl", ".ndjson", ".json")


def read_steps(
    paths: Sequence[Path],
    skeleton: DomainSkeleton,
    *,
    failures: bool = False,
    partial: bool = False,
    problems: Sequence[Path] = (),
) -> Iterator[Evidence]:
    """The steps of traces, one file after the other; where states are missing, what there is.

    Args:
        paths: JSON lines by their ending; all others are traces in parentheses, or plans.
        skeleton: the domain.
        failures: whether, in traces in parentheses, an action after which the state is the same
            has failed; JSON lines say by themselves what has failed.
        partial: whether states in parentheses say all that is known, not all that is true.
        problems: what plans and traces without a first state start from and lead to: one for all
            of them, or one for every file.

    Raises:
        UserError: if a file cannot be read or does not fit the domain; names file and line.
    """
    if not paths:
        raise FileError("expected at least one file with a trace, got none")
    for path, problem in zip(paths, _of_each(paths, problems, skeleton), strict=True):
        if path.suffix.lower() in _JSON:
            yield from read_json_trace(path, skeleton)
            continue
        text = read_text(path)
        if is_plan(text):
            yield parse_plan(text, str(path), skeleton, problem)
        else:
            yield from parse_trace(
                text, str(path), skeleton, failures=failures, partial=partial, problem=problem
            )


def _of_each(
    paths: Sequence[Path], problems: Sequence[Path], skeleton: DomainSkeleton
) -> Iterator[Problem | None]:
    if len(problems) not in (0, 1, len(paths)):
        raise FileError(
            f"expected one problem for all traces or one for each of {len(paths)}, "
            f"got {len(problems)}"
        )
    if len(problems) < len(paths):
        one = read_problem(problems[0], skeleton) if problems else None
        yield from (one for _ in paths)
    else:
        yield from (read_problem(path, skeleton) for path in problems)
