"""The table seen from above, made of a picture of a known camera."""

from __future__ import annotations

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from skillwrapper.domains.panda.cameras import CAMERAS
from skillwrapper.domains.tabletop.colours import Mask

CELL: Final = 0.004
"""Metres."""
_X, _Y = np.arange(0.26, 0.80, CELL), np.arange(-0.52, 0.52, CELL)


def seen_from_above(mask: Mask, camera: str, height: float) -> Mask:
    """Where a mask (rows, columns) is set on a plane over the table (cells along x, along y)."""
    rows, columns, inside = _places(camera, height, mask.shape)
    found = np.zeros(inside.shape, dtype=bool)
    found[inside] = mask[rows[inside], columns[inside]]
    return found


def cell_place(row: int, column: int) -> tuple[float, float]:
    """The place (x, y) of a cell."""
    return float(_X[row]), float(_Y[column])


def around(place: tuple[float, float], radius: float) -> Mask:
    """The cells no farther from a place than so (cells along x, along y)."""
    return np.asarray(np.hypot(_X[:, np.newaxis] - place[0], _Y[np.newaxis, :] - place[1]) < radius)


def best_disc(liked: Mask, disliked: Mask, radius: float) -> tuple[tuple[float, float], float]:
    """The disc that holds most of what is liked and least of what is not.

    Returns:
        Its middle, and the share of it that is liked.
    """
    disc = _disc(radius)
    score = _sums(liked.astype(float) - 1.5 * disliked, disc)
    row, column = (int(k) for k in np.unravel_index(int(score.argmax()), score.shape))
    place = cell_place(row, column)
    inside = around(place, radius)
    return place, float(liked[inside].sum() / max(1, inside.sum()))


@lru_cache(maxsize=32)
def _places(
    camera: str, height: float, shape: tuple[int, ...]
) -> tuple[NDArray[np.int64], NDArray[np.int64], Mask]:
    """Row and column of the pixel of each cell, and whether it is in the picture."""
    x, y = np.meshgrid(_X, _Y, indexing="ij")
    points = np.stack([x, y, np.full_like(x, height)], axis=-1)
    columns, rows = CAMERAS[camera].project(points, shape[1], shape[0])
    inside = (columns >= 0) & (columns < shape[1]) & (rows >= 0) & (rows < shape[0])
    return rows.astype(np.int64), columns.astype(np.int64), inside


def _disc(radius: float) -> NDArray[np.float64]:
    reach = int(radius / CELL)
    x, y = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    return np.asarray(np.hypot(x, y) * CELL <= radius, float)


def _sums(values: NDArray[np.float64], disc: NDArray[np.float64]) -> NDArray[np.float64]:
    """For each cell the sum of the values in the disc around it."""
    shape = [v + d - 1 for v, d in zip(values.shape, disc.shape, strict=True)]
    product = np.fft.rfft2(values, shape) * np.fft.rfft2(disc, shape)
    reach = disc.shape[0] // 2
    whole = np.fft.irfft2(product, shape)
    return np.asarray(whole[reach : reach + values.shape[0], reach : reach + values.shape[1]])
