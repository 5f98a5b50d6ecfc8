"""What the model calls of a run took; what is not known stays unknown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from skillwrapper.runs.archive import RunArchive
from skillwrapper.vlm.stored_call import CallTotals

Number = TypeVar("Number", int, float)


@dataclass(frozen=True)
class Line:
    """What some of the calls took.

    Attributes:
        title: which calls.
        made: calls that a model was asked.
        served: questions answered from a store instead.
        failed: calls that brought nothing usable.
        input_tokens: None if unknown.
        output_tokens: None if unknown.
        cost: in US dollars; None if unknown, which is not zero.
        seconds: added up over the calls made.
    """

    title: str
    made: int
    served: int
    failed: int
    input_tokens: int | None
    output_tokens: int | None
    cost: float | None
    seconds: float


@dataclass(frozen=True)
class CallAccount:
    """The account of a run.

    Attributes:
        roles: a line for every role.
        total: all roles together.
    """

    roles: tuple[Line, ...]
    total: Line


def read_account(archive: RunArchive) -> CallAccount | None:
    """The account of a run; None if no calls were recorded.

    Raises:
        RunFolderError: if the record is damaged.
    """
    with archive.open_calls() as store:
        totals = store.totals() if store else ()
    if not totals:
        return None
    roles = dict.fromkeys(t.role for t in totals)
    lines = [_line(str(role), [t for t in totals if t.role == role]) for role in roles]
    return CallAccount(tuple(lines), _line("all", totals))


def _line(title: str, totals: Sequence[CallTotals]) -> Line:
    return Line(
        title,
        sum(t.made for t in totals),
        sum(t.served for t in totals),
        sum(t.failed for t in totals),
        _sum(totals, lambda t: t.input_tokens),
        _sum(totals, lambda t: t.output_tokens),
        _sum(totals, lambda t: t.cost),
        sum(t.seconds for t in totals),
    )


def _sum(
    totals: Iterable[CallTotals], value: Callable[[CallTotals], Number | None]
) -> Number | None:
    """The sum; None if any part is unknown."""
    values = [value(t) for t in totals]
    known = [v for v in values if v is not None]
    return sum(known) if len(known) == len(values) else None
