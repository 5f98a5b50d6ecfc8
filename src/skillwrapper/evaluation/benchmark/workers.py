"""Who runs the cells of an experiment, and what comes of a cell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from skillwrapper.evaluation.methods.cell import Cell


@dataclass(frozen=True)
class CellOutcome:
    """A cell has ended.

    Attributes:
        cell: the cell.
        error: why it failed, in one line; empty if it did not.
    """

    cell: Cell
    error: str = ""


Task = Callable[[Path, Cell], CellOutcome]
"""Runs one cell of the experiment in a folder."""


class Workers(Protocol):
    """Run cells, several at a time."""

    def submit(self, cell: Cell) -> None:
        """Take a cell on; returns at once."""
        ...

    def next(self) -> CellOutcome:
        """Wait for the next cell to end."""
        ...
