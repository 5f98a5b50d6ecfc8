"""Telling materials apart by colour, in any light."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from skillwrapper.domains.panda.states import BOWL, MUG, SPONGE, TEAPOT

Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]

PORCELAIN, BROWN, WOOD = "porcelain", "brown", "wood"
_WOOD: Final = np.array((149.0, 118.0, 85.0))
"""The table in the usual light; it is most of every picture."""
_WOOD_HUES: Final = (20.0, 45.0)


def in_usual_light(pixels: Pixels) -> NDArray[np.float64]:
    """Fractions (rows, columns, 3) as they would be if the table had its usual colour."""
    fractions = pixels.astype(np.float64)
    sample = fractions[pixels.shape[0] // 3 :: 4, ::4].reshape(-1, 3)
    hue, saturation, value = _hue_saturation_value(sample / 255)
    wooden = (saturation > 0.2) & (saturation < 0.65) & (value > 0.15)
    wooden &= (hue > _WOOD_HUES[0] - 15) & (hue < _WOOD_HUES[1] + 15)
    if wooden.sum() >= sample.shape[0] // 10:
        fractions = fractions * (_WOOD / np.median(sample[wooden], axis=0))
    return np.asarray(np.clip(fractions / 255, 0.0, 1.0))


def materials(fractions: NDArray[np.float64]) -> Mapping[str, Mask]:
    """Where each material is seen (rows, columns): the things by their names, and some others.

    Args:
        fractions: red, green and blue from 0 to 1 in the usual light (rows, columns, 3).
    """
    hue, saturation, value = _hue_saturation_value(fractions)
    vivid = saturation > 0.55
    bright_red = ((hue < 14) | (hue > 335)) & vivid & (value > 0.27)
    brown = (saturation > 0.45) & (value < 0.42) & (hue > 6) & (hue < 45) & ~bright_red
    return MappingProxyType(
        {
            MUG: bright_red,
            TEAPOT: vivid & (hue > 195) & (hue < 250) & (value > 0.25),
            BOWL: (saturation > 0.45) & (hue > 115) & (hue < 170) & (value > 0.15),
            SPONGE: (saturation > 0.68) & (hue > 38) & (hue < 64) & (value > 0.35),
            PORCELAIN: (saturation < 0.14) & (value > 0.52),
            BROWN: brown,
            WOOD: (hue > _WOOD_HUES[0])
            & (hue < _WOOD_HUES[1])
            & (saturation > 0.25)
            & (saturation < 0.6)
            & (value > 0.4),
        }
    )


def _hue_saturation_value(
    fractions: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Hue in degrees, saturation and value from 0 to 1 (...)."""
    red, green, blue = (fractions[..., c] for c in range(3))
    value, least = fractions.max(axis=-1), fractions.min(axis=-1)
    spread = value - least
    safe = np.maximum(spread, 1e-6)
    hue = np.where(
        value == red,
        ((green - blue) / safe) % 6,
        np.where(value == green, (blue - red) / safe + 2, (red - green) / safe + 4),
    )
    return 60 * hue, spread / np.maximum(value, 1e-6), value
