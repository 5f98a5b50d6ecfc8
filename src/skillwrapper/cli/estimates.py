"""Printing what a run will take."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from skillwrapper.runs.estimate import Estimate


def print_estimate(estimate: Estimate, console: Console) -> None:
    """Print an estimate, role by role; an unknown cost is called unknown."""
    table = Table("role", "model", "calls", "tokens in", "tokens out", "dollars", box=None)
    for role in estimate.roles:
        figures = map(_range, (role.calls, role.input_tokens, role.output_tokens))
        table.add_row(str(role.role), role.model, *figures, _dollars(role.cost))
    console.print(f"executions: at most {estimate.executions}")
    console.print(table)
    console.print(
        f"in all: {_range(estimate.calls)} calls, {_range(estimate.tokens)} tokens, "
        f"{_dollars(estimate.cost)} dollars"
    )
    console.print(
        "from the least to the most to expect, judging by runs of a bundled domain; without "
        "reasoning tokens, repeated calls and what a store answers; nothing was asked or executed"
    )


def _range(pair: tuple[int, int]) -> str:
    low, high = pair
    return f"{low:,}" if low == high else f"{low:,}-{high:,}"


def _dollars(pair: tuple[float, float] | None) -> str:
    return "unknown" if pair is None else f"{pair[0]:.2f}-{pair[1]:.2f}"
