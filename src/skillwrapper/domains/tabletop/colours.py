"""Telling materials apart by colour, whatever they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]
Floats = NDArray[np.float64]

_BITS: Final = 5
"""Of each channel; enough for vivid colours."""


def sort_pixels(
    pixels: Pixels,
    gain: ArrayLike,
    told_apart: Callable[[Floats], Mapping[str, Mask]],
    bits: int = _BITS,
) -> Mapping[str, Mask]:
    """Where each material is seen (rows, columns).

    Args:
        pixels: red, green and blue (rows, columns, 3).
        gain: by what these must grow (3,) to be as in the usual light.
        told_apart: says which colours (n, 3), from 0 to 1, are of each material (n,).
        bits: of each channel, by which colours are told apart; pale ones want more.
    """
    steps = (np.arange(1 << bits) << (8 - bits)) + (1 << (7 - bits))
    colours = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    shares = np.clip(colours * np.asarray(gain) / 255, 0.0, 1.0)
    kept = (pixels >> (8 - bits)).astype(np.int32)
    number = (kept[..., 0] << 2 * bits) | (kept[..., 1] << bits) | kept[..., 2]
    return MappingProxyType({name: is_it[number] for name, is_it in told_apart(shares).items()})


def hue_saturation_value(shares: Floats) -> tuple[Floats, Floats, Floats]:
    """Hue in degrees, saturation and value from 0 to 1 (...), of red, green, blue (..., 3)."""
    red, green, blue = (shares[..., c] for c in range(3))
    value, least = shares.max(axis=-1), shares.min(axis=-1)
    spread = value - least
    safe = np.maximum(spread, 1e-6)
    hue = np.where(
        value == red,
        ((green - blue) / safe) % 6,
        np.where(value == green, (blue - red) / safe + 2, (red - green) / safe + 4),
    )
    return 60 * hue, spread / np.maximum(value, 1e-6), value
