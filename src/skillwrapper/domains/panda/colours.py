"""Telling materials apart by colour, in any light."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from skillwrapper.domains.panda.states import BOWL, MUG, SPONGE, TEAPOT
from skillwrapper.domains.tabletop.colours import (
    Floats,
    Mask,
    Pixels,
    hue_saturation_value,
    sort_pixels,
)

PORCELAIN, BROWN, WOOD = "porcelain", "brown", "wood"
_WOOD: Final = np.array((149.0, 118.0, 85.0))
"""The table in the usual light; it is most of every picture."""
_WOOD_HUES: Final = (20.0, 45.0)


def materials(pixels: Pixels) -> Mapping[str, Mask]:
    """Where each material is seen (rows, columns): the things by their names, and some others.

    Args:
        pixels: red, green and blue (rows, columns, 3), in any light.
    """
    return sort_pixels(pixels, _gain(pixels), _told_apart)


def _gain(pixels: Pixels) -> Floats:
    """By what red, green and blue must grow (3,) for the table to have its usual colour."""
    sample = pixels[pixels.shape[0] // 3 :: 4, ::4].reshape(-1, 3).astype(np.float64)
    hue, saturation, value = hue_saturation_value(sample / 255)
    wooden = (saturation > 0.2) & (saturation < 0.85) & (value > 0.15)
    wooden &= (hue > _WOOD_HUES[0] - 15) & (hue < _WOOD_HUES[1] + 15)
    if wooden.sum() < len(sample) // 10:
        return np.ones(3)
    return np.asarray(_WOOD / np.median(sample[wooden], axis=0))


def _told_apart(colours: Floats) -> Mapping[str, Mask]:
    """Which colours (n, 3), from 0 to 1 in the usual light, are of each material (n,)."""
    hue, saturation, value = hue_saturation_value(colours)
    vivid = saturation > 0.55
    bright_red = ((hue < 14) | (hue > 335)) & vivid & (value > 0.27)
    dark = (saturation > 0.45) & (value < 0.42)
    wooden = (hue > _WOOD_HUES[0]) & (hue < _WOOD_HUES[1]) & (value > 0.4)
    return {
        MUG: bright_red,
        TEAPOT: vivid & (hue > 195) & (hue < 250) & (value > 0.25),
        BOWL: (saturation > 0.45) & (hue > 122) & (hue < 170) & (value > 0.18),
        SPONGE: (saturation > 0.68) & (hue > 38) & (hue < 64) & (value > 0.35),
        PORCELAIN: (saturation < 0.14) & (value > 0.52),
        BROWN: dark & (hue > 6) & (hue < 45) & ~bright_red,
        WOOD: wooden & (saturation > 0.25) & (saturation < 0.6),
    }
