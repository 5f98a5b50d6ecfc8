"""What model calls of a cell took: for learning and for solving; what is unknown stays unknown."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Final, TypeVar

from skillwrapper.runs.archive import RunArchive
from skillwrapper.vlm.stored_call import CallTotals

_FREE: Final = "embedded"
_Number = TypeVar("_Number", int, float)


@dataclass(frozen=True)
class CallCosts:
    """What calls took.

    Attributes:
        calls: that were needed, those included whose replies other runs had got.
        cost: in US dollars; None if it is unknown, which is not zero.
        input_tokens: None if unknown.
        output_tokens: None if unknown.
        seconds: that models took, added up; None if unknown.
    """

    calls: int
    cost: float | None
    input_tokens: int | None
    output_tokens: int | None
    seconds: float | None

    def to_json(self) -> dict[str, Any]:
        """Plain data with the attributes as keys."""
        return dict(vars(self))


NOTHING: Final = CallCosts(0, 0.0, 0, 0, 0.0)


def learning_costs(run: RunArchive | None) -> CallCosts | None:
    """What a run's iterations took, over all its interruptions; None without a run."""
    if run is None:
        return None
    totals = [t for t in _totals(run) if t.iteration is not None]
    return _added(totals) if totals else None


def solving_costs(run: RunArchive | None, calls: int, model: str) -> CallCosts:
    """What solving problems took.

    Args:
        run: the folder that keeps the calls; None if there is none.
        calls: how many questions were put.
        model: name of the model; calls of the embedded one cost nothing and are not kept.
    """
    if not calls:
        return NOTHING
    if model == _FREE:
        return CallCosts(calls, 0.0, None, None, None)
    totals = [t for t in _totals(run) if t.iteration is None] if run else []
    return _added(totals) if totals else CallCosts(calls, None, None, None, None)


def _totals(run: RunArchive) -> tuple[CallTotals, ...]:
    with run.open_calls() as store:
        return store.totals() if store else ()


def _added(totals: Iterable[CallTotals]) -> CallCosts:
    totals = tuple(totals)
    return CallCosts(
        calls=sum(t.asked for t in totals),
        cost=_sum(totals, lambda t: t.cost),
        input_tokens=_sum(totals, lambda t: t.input_tokens),
        output_tokens=_sum(totals, lambda t: t.output_tokens),
        seconds=sum(t.seconds for t in totals),
    )


def _sum(
    totals: Iterable[CallTotals], value: Callable[[CallTotals], _Number | None]
) -> _Number | None:
    """The sum; None if any part is unknown."""
    values = [value(t) for t in totals]
    known = [v for v in values if v is not None]
    return sum(known) if len(known) == len(values) else None
