from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from PIL import Image

from skillwrapper.embedded.pixels import (
    ColourTable,
    Counts,
    Patch,
    box_around,
    decode_pixels,
    find_patches,
    middle_of,
)
from skillwrapper.embedded.scene_graph import Box
from skillwrapper.errors import PictureError
from skillwrapper.world import encode_png

TABLE = ColourTable({"dark": [(0, 0, 0)], "warm": [(250, 60, 20), (250, 180, 40)]})


def test_pixels_are_counted_by_block_and_nearest_group() -> None:
    pixels = np.zeros((4, 6, 3), np.uint8)
    pixels[:2, 2:5] = (240, 150, 60)
    raster = TABLE.raster(pixels, 2)
    assert raster.amount("warm").tolist() == [[0, 4, 2], [0, 0, 0]]
    assert raster.amount("dark").tolist() == [[4, 0, 2], [4, 4, 4]]
    assert raster.amount("dark", "warm").tolist() == [[4, 4, 4], [4, 4, 4]]
    assert raster.dense_amount(0.75, "warm").tolist() == [[0, 4, 0], [0, 0, 0]]


def test_patches_are_connected_by_edges_not_by_corners() -> None:
    amount = np.array([[3, 3, 0, 0], [0, 0, 1, 0], [0, 0, 1, 2]])
    assert find_patches(amount) == (
        Patch(Box(0, 0, 2, 1), 6),
        Patch(Box(2, 1, 4, 3), 4),
    )
    assert find_patches(np.zeros((2, 2), np.int64)) == ()


@given(
    arrays(np.int64, array_shapes(min_dims=2, max_dims=2, max_side=6), elements=st.integers(0, 2))
)
def test_every_patch_is_what_can_be_reached_over_edges(amount: Counts) -> None:
    cells = [(int(row), int(column)) for row, column in np.argwhere(amount)]
    expected = []
    while cells:
        reached = [cells.pop(0)]
        for row, column in reached:
            around = ((row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1))
            reached += [cell for cell in around if cell in cells]
            cells = [cell for cell in cells if cell not in reached]
        rows, columns = zip(*reached, strict=True)
        box = Box(min(columns), min(rows), max(columns) + 1, max(rows) + 1)
        expected.append(Patch(box, sum(int(amount[cell]) for cell in reached)))
    assert find_patches(amount) == tuple(expected)


def test_middle_is_where_most_was_counted() -> None:
    amount = np.array([[1, 0, 0, 0], [0, 0, 9, 0]])
    assert middle_of(amount) == (2.5, 1.5)
    assert box_around(amount) == Box(0, 0, 3, 2)


def test_pictures_of_another_size_are_scaled() -> None:
    png = encode_png(Image.new("RGB", (30, 20), (9, 8, 7)))
    assert decode_pixels(png, 10, 10).shape == (10, 10, 3)
    assert decode_pixels(png, 10, 10)[5, 5].tolist() == [9, 8, 7]


@pytest.mark.parametrize("data", [b"", b"no picture"])
def test_what_is_no_picture_is_refused(data: bytes) -> None:
    with pytest.raises(PictureError, match="expected the bytes of a picture"):
        decode_pixels(data, 10, 10)
