"""Which of several known cameras took a picture of a table."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Final

import numpy as np

from skillwrapper.domains.tabletop.cameras import Camera
from skillwrapper.domains.tabletop.colours import Mask

_TABLE_CORNERS: Final = ((-0.18, -0.65, 0), (0.82, -0.65, 0), (0.82, 0.65, 0), (-0.18, 0.65, 0))
_COARSE: Final = 8
"""Every so many pixels are looked at to tell cameras apart."""
_LEAST_AGREEMENT: Final = 0.5
"""So much of where the table is, or should be, must be both."""


def camera_of(table: Mask, cameras: Mapping[str, Camera]) -> str | None:
    """The camera that took a picture, by where the table is in it (rows, columns).

    None if the table is nowhere where one of the cameras would see it.
    """
    coarse = table[::_COARSE, ::_COARSE]

    def agreement(name: str) -> float:
        expected = _table_seen(cameras[name], table.shape)
        return float((coarse & expected).sum() / (coarse | expected).sum())

    best = max(cameras, key=agreement)
    return best if agreement(best) > _LEAST_AGREEMENT else None


@lru_cache(maxsize=32)
def _table_seen(camera: Camera, shape: tuple[int, ...]) -> Mask:
    """Where the empty table is in the picture of a camera, in coarse pixels."""
    corners = np.column_stack(camera.project(_TABLE_CORNERS, shape[1], shape[0]))
    rows, columns = np.mgrid[0 : shape[0] : _COARSE, 0 : shape[1] : _COARSE]
    inside = np.ones(rows.shape, dtype=bool)
    middle = corners.mean(axis=0)
    for first, second in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        edge = second - first
        side = edge[0] * (rows - first[1]) - edge[1] * (columns - first[0])
        inner = edge[0] * (middle[1] - first[1]) - edge[1] * (middle[0] - first[0])
        inside &= side * inner >= 0
    return inside
