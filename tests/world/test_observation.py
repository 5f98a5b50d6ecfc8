from __future__ import annotations

import io
from pathlib import Path

import pytest
from PIL import Image

from skillwrapper.errors import PictureError
from skillwrapper.world import Observation, Picture, encode_png, load_picture


def gradient() -> Image.Image:
    image = Image.new("RGB", (7, 5))
    image.putdata([(30 * x, 40 * y, 5 * x * y) for y in range(5) for x in range(7)])
    return image


def test_encoding_keeps_every_pixel() -> None:
    with Image.open(io.BytesIO(encode_png(gradient()))) as decoded:
        assert decoded.format == "PNG"
        assert decoded.mode == "RGB"
        assert decoded.tobytes() == gradient().tobytes()


def test_encoding_is_a_function_of_the_pixels() -> None:
    assert encode_png(gradient()) == encode_png(gradient())


def test_other_modes_are_encoded_in_rgb() -> None:
    with Image.open(io.BytesIO(encode_png(gradient().convert("L")))) as decoded:
        assert decoded.mode == "RGB"


def test_key_tells_pictures_and_cameras_apart() -> None:
    one, two = encode_png(gradient()), encode_png(Image.new("RGB", (7, 5)))
    front, side = Picture(one, "front"), Picture(two, "side")
    assert Observation((Picture(one),)).key == Picture(one).sha256
    keys = {
        Observation(pictures).key
        for pictures in ((front,), (side,), (front, side), (Picture(two, "front"), side))
    }
    assert len(keys) == 4
    assert Observation((front, side)).key == Observation((front, side)).key


def test_png_file_is_kept_as_it_is(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(encode_png(gradient()))
    assert load_picture(path, "top") == Picture(path.read_bytes(), "top")


def test_other_format_is_converted(tmp_path: Path) -> None:
    path = tmp_path / "a.bmp"
    gradient().save(path)
    assert load_picture(path).png == encode_png(gradient())


def test_missing_picture_is_named(tmp_path: Path) -> None:
    with pytest.raises(PictureError, match=r"a\.png: no such picture"):
        load_picture(tmp_path / "a.png")


@pytest.mark.parametrize("data", [b"", b"text", encode_png(gradient())[:45]])
def test_what_is_no_picture_is_refused(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(data)
    with pytest.raises(PictureError, match="expected a picture"):
        load_picture(path)
