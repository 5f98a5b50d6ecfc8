"""Abstract states whose labels are looked up for many bindings at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.atom_index import Columns
from skillwrapper.grounding.atom_space import FALSE, Labels


class AbstractStates:
    """Rows of labels; an atom that is no grounding (column -1) is false in every state.

    Args:
        labels: one row for every state (states, atoms).

    Attributes:
        labels: the same.
    """

    def __init__(self, labels: Labels) -> None:
        self.labels = labels
        padded = np.full((len(labels), labels.shape[1] + 1), FALSE, dtype=np.int8)
        padded[:, :-1] = labels
        self._width = padded.shape[1]
        self._flat = padded.ravel()

    def __len__(self) -> int:
        return len(self.labels)

    def at(self, rows: NDArray[np.intp], columns: Columns) -> Labels:
        """Labels of columns (n, ...), each line of them in its own state of rows (n,)."""
        first = (rows * self._width).reshape(-1, *[1] * (columns.ndim - 1))
        # Column -1 falls on the padding at the end of the row before; of the first, of the last.
        found: Labels = self._flat.take(first + columns)
        return found


def different_rows(rows: NDArray[Any]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Places of the different rows (n, ...), in the order of their first occurrence.

    Returns:
        The place of each among all, and the place (n,) of every row among the different ones.
    """
    flat = np.ascontiguousarray(rows.reshape(len(rows), int(np.prod(rows.shape[1:]))))
    flat = np.packbits(flat, axis=1) if flat.dtype == np.bool_ else flat
    width = flat.shape[1] * flat.itemsize
    keys: list[Any] = [b""] * len(flat)
    if width:
        keys = flat.view(np.dtype((np.void, width))).ravel().tolist()
    number: dict[bytes, int] = {}
    place = np.array([number.setdefault(key, len(number)) for key in keys], dtype=np.intp)
    first = np.full(len(number), len(flat), dtype=np.intp)
    np.minimum.at(first, place, np.arange(len(flat)))
    return first, place
