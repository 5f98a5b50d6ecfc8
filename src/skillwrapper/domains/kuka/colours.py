"""Telling the materials on the two arms' table apart by colour, in any light."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from skillwrapper.domains.tabletop.colours import (
    Floats,
    Mask,
    Pixels,
    hue_saturation_value,
    sort_pixels,
)

TABLE, BUTTER, CRUMB, LID, HANDLE, HOLDER = "table", "butter", "crumb", "lid", "handle", "holder"
_TABLE: Final = np.array((119.0, 128.0, 135.0))
"""The table in the usual light; the middle of every picture is mostly table."""

_BITS: Final = 6
"""Of each channel: the table is hardly more blue than the walls."""


def materials(pixels: Pixels) -> Mapping[str, Mask]:
    """Where each material is seen (rows, columns).

    Args:
        pixels: red, green and blue (rows, columns, 3), in any light.
    """
    rows, columns = pixels.shape[:2]
    middle = pixels[rows // 3 : 2 * rows // 3, columns // 4 : 3 * columns // 4]
    usual = np.median(middle.reshape(-1, 3), axis=0)
    return sort_pixels(pixels, _TABLE / np.maximum(usual, 1.0), _told_apart, _BITS)


def _told_apart(colours: Floats) -> Mapping[str, Mask]:
    """Which colours (n, 3), from 0 to 1 in the usual light, are of each material (n,)."""
    hue, saturation, value = hue_saturation_value(colours)
    vivid = saturation > 0.5
    return {
        TABLE: (hue > 180) & (hue < 235) & (saturation > 0.05) & (saturation < 0.22),
        BUTTER: (hue > 29.5) & (hue < 41) & (saturation > 0.6) & (value > 0.27),
        CRUMB: (hue > 33) & (hue < 65) & (saturation > 0.17) & (saturation < 0.5) & (value > 0.45),
        LID: vivid & (hue > 110) & (hue < 160),
        HANDLE: vivid & (hue > 225) & (hue < 265),
        HOLDER: vivid & (hue > 168) & (hue < 205),
    }
