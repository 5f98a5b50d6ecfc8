"""Whatever shows a picture becomes a PNG that looks the same, or is refused in one sentence."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from skillwrapper.errors import PictureError
from skillwrapper.world import (
    Observation,
    Picture,
    encode_png,
    load_picture,
    observation_of,
    pictures,
)
from skillwrapper.world.pictures import load_pictures, picture_of


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


def pixels(picture: Picture) -> np.ndarray[Any, Any]:
    with Image.open(io.BytesIO(picture.png)) as image:
        assert image.format == "PNG"
        return np.asarray(image.convert("RGB"))


COLOURS = np.asarray(gradient())
GREY = COLOURS[:, :, 0]


@pytest.mark.parametrize(
    ("shown", "expected"),
    [
        (COLOURS, COLOURS),
        (COLOURS.astype(np.int64), COLOURS),
        (COLOURS / 255, COLOURS),
        ((COLOURS / 255).astype(np.float32), COLOURS),
        (COLOURS.astype(np.uint16) * 257, COLOURS),
        (np.dstack([COLOURS, GREY]), COLOURS),
        (GREY, np.dstack([GREY] * 3)),
        (GREY[:, :, None], np.dstack([GREY] * 3)),
        (GREY > 100, np.dstack([(GREY > 100) * np.uint8(255)] * 3)),
        (gradient(), COLOURS),
        (Picture(encode_png(gradient()), "other"), COLOURS),
        (encode_png(gradient()), COLOURS),
        (bytearray(encode_png(gradient())), COLOURS),
    ],
)
def test_pictures_are_taken_in_many_forms(shown: Any, expected: np.ndarray[Any, Any]) -> None:
    picture = picture_of(shown, "top")
    assert picture.camera == "top"
    assert (pixels(picture) == expected).all()


@pytest.mark.parametrize(
    ("shown", "message"),
    [
        (
            np.zeros((4, 4, 2), np.uint8),
            r"'top': expected an array \(height, width, 3\), got on",
        ),
        (np.zeros((0, 4, 3), np.uint8), r"got one of shape \(0, 4, 3\)"),
        (np.zeros(4, np.uint8), r"got one of shape \(4,\)"),
        (np.full((4, 4), 300.0), "'top': expected fractions from 0 to 1, got others"),
        (np.full((4, 4), np.nan), "expected fractions from 0 to 1"),
        (np.full((4, 4), -1), "expected numbers from 0 to 255 or to 65535"),
        (np.full((4, 4), 70_000), "expected numbers from 0 to 255 or to 65535"),
        (np.full((4, 4), "red"), "expected an array of numbers"),
        (np.zeros((8000, 8000), np.bool_), "'top': expected at most 50 million pixels"),
        (None, r"expected an array \(height, width, 3\), got a NoneType"),
        (b"text", "camera 'top': expected a picture"),
    ],
)
def test_what_shows_no_picture_is_refused(shown: Any, message: str) -> None:
    with pytest.raises(PictureError, match=message):
        picture_of(shown, "top")


def test_a_look_may_be_of_one_camera_or_of_several() -> None:
    seen = observation_of({"left": COLOURS, "right": encode_png(gradient())})
    assert [p.camera for p in seen.pictures] == ["left", "right"]
    assert observation_of(seen) is seen
    assert [p.camera for p in observation_of(COLOURS).pictures] == ["main"]
    with pytest.raises(PictureError, match="expected at least one picture"):
        observation_of({})


# Fault 18 of the list of faults found by use, and its siblings.
def test_a_picture_is_turned_as_its_camera_was_held() -> None:
    image, held = gradient(), Image.Exif()
    held[0x0112] = 6  # a quarter turn
    for kind in ("JPEG", "PNG", "WEBP"):
        buffer = io.BytesIO()
        image.save(buffer, kind, exif=held, **({"lossless": True} if kind == "WEBP" else {}))
        turned = pixels(picture_of(buffer.getvalue()))
        assert turned.shape == (7, 5, 3)
        if kind != "JPEG":
            assert (turned == np.rot90(COLOURS, -1)).all()


def test_grey_of_16_bits_keeps_its_brightness(tmp_path: Path) -> None:
    deep = np.linspace(0, 65_535, 35).reshape(5, 7).astype(np.uint16)
    for name in ("a.png", "a.tiff"):
        Image.fromarray(deep).save(tmp_path / name)
        seen = pixels(load_picture(tmp_path / name))[:, :, 0]
        assert np.abs(seen - deep / 257).max() <= 1


def test_huge_pictures_are_refused(tmp_path: Path) -> None:
    """A few kilobytes may claim to hold any number of pixels."""
    for side in (8_000, 20_000):
        path = tmp_path / f"{side}.png"
        Image.new("1", (side, side)).save(path)
        with pytest.raises(PictureError, match=r"png: expected at most 50 million pixels"):
            load_picture(path)


def test_a_program_that_draws_is_not_run(tmp_path: Path) -> None:
    (tmp_path / "a.eps").write_text("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 9 9\n{} loop\n")
    with pytest.raises(PictureError, match="got a program"):
        load_picture(tmp_path / "a.eps")


def test_a_device_without_an_end_is_no_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pictures, "_MOST_BYTES", 1 << 20)
    with pytest.raises(PictureError, match=r"/dev/zero: cannot be read \(File too large\)"):
        load_picture(Path("/dev/zero"))


def test_every_camera_has_its_own_file(tmp_path: Path) -> None:
    for name in ("a.png", "b=c.png"):
        (tmp_path / name).write_bytes(encode_png(gradient()))
    one, odd = tmp_path / "a.png", tmp_path / "b=c.png"
    assert [p.camera for p in load_pictures([str(one)]).pictures] == ["main"]
    assert [p.camera for p in load_pictures([str(odd)]).pictures] == ["main"]
    seen = load_pictures([f"front={one}", f"side={odd}"])
    assert [p.camera for p in seen.pictures] == ["front", "side"]
    assert isinstance(seen, Observation)
    with pytest.raises(PictureError, match=r"different cameras \(CAMERA=FILE\), got main, main"):
        load_pictures([str(one), str(odd)])
    with pytest.raises(PictureError, match=r"nowhere.png: no such picture"):
        load_pictures(["front=nowhere.png"])
