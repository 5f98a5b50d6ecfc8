"""Traces of any of the formats that are read, by what their files look like."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from skillwrapper.action_models.json_traces import read_json_trace
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.trace_files import read_trace
from skillwrapper.errors import FileError

_JSON = (".jsonl", ".ndjson", ".json")


def read_steps(
    paths: Sequence[Path], skeleton: DomainSkeleton, *, failures: bool = False
) -> Iterator[Step]:
    """The steps of traces, one file after the other.

    Args:
        paths: JSON lines by their ending, all others in parentheses.
        skeleton: the domain.
        failures: whether, in traces in parentheses, an action after which the state is the same
            has failed; JSON lines say by themselves what has failed.

    Raises:
        UserError: if a file cannot be read or does not fit the domain; names file and line.
    """
    if not paths:
        raise FileError("expected at least one file with a trace, got none")
    for path in paths:
        if path.suffix.lower() in _JSON:
            yield from read_json_trace(path, skeleton)
        else:
            yield from read_trace(path, skeleton, failures=failures)
