"""Finding coloured things in pixels: what scene readers of drawn pictures have in common."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt
from PIL import Image, UnidentifiedImageError

from skillwrapper.embedded.scene_graph import Box
from skillwrapper.errors import PictureError

Pixels = npt.NDArray[np.uint8]
Counts = npt.NDArray[np.int64]
Rgb = tuple[int, int, int]

_BITS: Final = 5
"""Bits of each channel that the table of nearest colours tells apart."""


def decode_pixels(png: bytes, width: int, height: int) -> Pixels:
    """The pixels (height, width, 3) of an encoded picture; one of another size is scaled.

    Raises:
        PictureError: if it is no picture.
    """
    try:
        with Image.open(io.BytesIO(png)) as image:
            picture = image.convert("RGB")
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError) as error:
        raise PictureError("expected the bytes of a picture, got something else") from error
    if picture.size != (width, height):
        picture = picture.resize((width, height))
    return np.asarray(picture)


@dataclass(frozen=True)
class Raster:
    """Which colours each block of a picture holds.

    Attributes:
        groups: names of the groups of colours.
        counts: pixels by block and group (rows, columns, groups).
        block: width and height of a block in pixels that were counted.
    """

    groups: tuple[str, ...]
    counts: Counts
    block: int

    def amount(self, *names: str) -> Counts:
        """How many pixels of the named groups each block holds (rows, columns)."""
        chosen = [self.groups.index(name) for name in names]
        amount: Counts = self.counts[:, :, chosen].sum(axis=2)
        return amount

    def dense_amount(self, share: float, *names: str) -> Counts:
        """The same, with nothing in blocks of which less than a share is in the groups."""
        amount = self.amount(*names)
        return np.where(amount >= share * self.block**2, amount, 0)


class ColourTable:
    """Tells to which of several named groups of colours a pixel comes nearest.

    Args:
        groups: the colours of each group, in RGB.
    """

    def __init__(self, groups: Mapping[str, Sequence[Rgb]]) -> None:
        self.groups = tuple(groups)
        colours = np.array([colour for group in groups.values() for colour in group], np.int64)
        owners = np.array([n for n, group in enumerate(groups.values()) for _ in group], np.int64)
        steps = (np.arange(1 << _BITS) << (8 - _BITS)) + (1 << (7 - _BITS))
        mesh = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 1, 3)
        distance = ((mesh - colours) ** 2).sum(axis=2)
        self._nearest = owners[distance.argmin(axis=1)]

    def raster(self, pixels: Pixels, block: int) -> Raster:
        """Count the nearest groups of pixels (rows, columns, 3) in blocks.

        Args:
            pixels: in RGB.
            block: width and height of a block, a divisor of rows and columns.
        """
        reduced = (pixels >> (8 - _BITS)).astype(np.uint16)
        key = (reduced[..., 0] << (2 * _BITS)) | (reduced[..., 1] << _BITS) | reduced[..., 2]
        rows, columns = pixels.shape[0] // block, pixels.shape[1] // block
        number = np.arange(rows * columns).reshape(rows, columns) * len(self.groups)
        cell = number.repeat(block, axis=0).repeat(block, axis=1) + self._nearest[key]
        counts = np.bincount(cell.ravel(), minlength=rows * columns * len(self.groups))
        return Raster(self.groups, counts.reshape(rows, columns, len(self.groups)), block)


@dataclass(frozen=True)
class Patch:
    """A connected patch of blocks.

    Attributes:
        box: in blocks.
        pixels: how many pixels were counted in it.
    """

    box: Box
    pixels: int


class _Run(NamedTuple):
    """Blocks side by side in one row that are not zero."""

    row: int
    left: int
    right: int
    pixels: int

    def touches(self, above: _Run) -> bool:
        """Whether it has an edge in common with a run of the row above."""
        return self.left < above.right and above.left < self.right


def find_patches(amount: Counts) -> tuple[Patch, ...]:
    """Connected patches of blocks (rows, columns) that are not zero, from the upper left on."""
    runs = _runs(amount)
    earlier = list(range(len(runs)))  # for each run another of its patch that comes before it

    def first(number: int) -> int:
        while earlier[number] != number:
            number = earlier[number]
        return number

    start_above = start = 0
    for number, run in enumerate(runs):
        if run.row != runs[start].row:
            start_above, start = start, number
        for above in range(start_above, start):
            if runs[above].row == run.row - 1 and run.touches(runs[above]):
                one, other = sorted((first(above), first(number)))
                earlier[other] = one
    patches: dict[int, list[_Run]] = {}
    for number, run in enumerate(runs):
        patches.setdefault(first(number), []).append(run)
    return tuple(map(_patch_of, patches.values()))


def _runs(amount: Counts) -> list[_Run]:
    """All runs, row by row, from the left."""
    height, width = amount.shape
    filled = np.zeros((height, width + 2), np.bool_)  # with nothing at both ends of every row
    filled[:, 1:-1] = amount
    rows, columns = np.divmod(np.flatnonzero(filled[:, 1:] != filled[:, :-1]), width + 1)
    sums = np.zeros(amount.size + 1, np.int64)
    amount.cumsum(out=sums[1:])
    until = sums[rows * width + columns]
    pixels = (until[1::2] - until[::2]).tolist()
    return list(
        map(_Run, rows[::2].tolist(), columns[::2].tolist(), columns[1::2].tolist(), pixels)
    )


def box_around(amount: Counts) -> Box:
    """The box, in blocks, around all blocks that are not zero; at least one must be."""
    rows, columns = np.nonzero(amount)
    return Box(int(columns.min()), int(rows.min()), int(columns.max()) + 1, int(rows.max()) + 1)


def middle_of(amount: Counts) -> tuple[float, float]:
    """Median column and row of what was counted, in blocks; half a block is the middle of one."""
    rows, columns = np.nonzero(amount)
    weights = amount[rows, columns]
    column, row = (np.median(places.repeat(weights)) + 0.5 for places in (columns, rows))
    return float(column), float(row)


def _patch_of(runs: Sequence[_Run]) -> Patch:
    left, right = min(run.left for run in runs), max(run.right for run in runs)
    box = Box(left, runs[0].row, right, runs[-1].row + 1)
    return Patch(box, sum(run.pixels for run in runs))
