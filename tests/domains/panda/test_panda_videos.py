from __future__ import annotations

from pathlib import Path

import pytest
from PIL import Image
from simulated_arms import why_no_pictures
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.errors import ConfigurationError


def test_render_writes_a_video_of_a_skill(tmp_path: Path) -> None:
    if why_no_pictures():
        pytest.skip(why_no_pictures())
    video = tmp_path / "pick.webp"
    command = ["render", "panda", "--scene", "wiping", "--out", str(tmp_path / "end.png")]
    done = CliRunner().invoke(
        app, [*command, "--video", str(video), "--do", "Pick(robot, sponge)", "--json"]
    )
    assert done.exit_code == 0, done.output
    with Image.open(video) as film:
        assert film.n_frames > 10
        first = film.convert("RGB").tobytes()
        film.seek(film.n_frames - 1)
        assert film.convert("RGB").tobytes() != first


def test_what_is_no_name_of_a_video_is_refused(tmp_path: Path) -> None:
    command = ["render", "panda", "--out", str(tmp_path / "a.png"), "--video", "a.mp4"]
    failed = CliRunner().invoke(app, command)
    if why_no_pictures():
        pytest.skip(why_no_pictures())
    assert isinstance(failed.exception, ConfigurationError)
    assert "expected the name of a video to end in .webp, .gif, .png" in str(failed.exception)


def test_what_cannot_be_filmed_says_so(tmp_path: Path) -> None:
    command = ["render", "burger", "--out", str(tmp_path / "a.png"), "--video", "a.webp"]
    failed = CliRunner().invoke(app, command)
    assert "--video needs an environment that is filmed" in str(failed.exception)
