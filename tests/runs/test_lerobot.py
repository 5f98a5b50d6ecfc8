"""Datasets of LeRobot: the same model as from the same episodes in another form."""

from __future__ import annotations

import io
import json
import sys
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cubes import EPISODES, play
from PIL import Image

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.domains.starting import start_project
from skillwrapper.errors import FileError, MissingDependencyError
from skillwrapper.runs.launch import learn_recorded
from skillwrapper.runs.recordings import import_recording, read_recording
from skillwrapper.world.observation import Observation

pa = pytest.importorskip("pyarrow", reason="the extra lerobot is not installed")
av = pytest.importorskip("av", reason="the extra lerobot is not installed")
parquet = pytest.importorskip("pyarrow.parquet")

CAMERA = "observation.images.top"


@pytest.fixture(scope="module")
def cubes(tmp_path_factory: pytest.TempPathFactory) -> DomainPackage:
    folder = tmp_path_factory.mktemp("lerobot") / "cubes"
    start_project(folder)
    return find_domain(str(folder))


def png(observation: Observation) -> bytes:
    return observation.pictures[0].png


def frames_of(package: DomainPackage, number: int) -> list[dict[str, Any]]:
    """Each skill takes two frames; one of nothing follows, which shows what came of it."""
    seen, successes = play(package, EPISODES[number])
    frames: list[dict[str, Any]] = []
    for place, (skill, success) in enumerate(zip(EPISODES[number], successes, strict=True)):
        for label, shown in ((skill, place), (skill, place), ("", place + 1)):
            frame = {"skill": label, "success": [success], "segment": place, "shown": seen[shown]}
            frames.append({**frame, "episode_index": number})
    return frames


def write(package: DomainPackage, folder: Path, version: str, kind: str, **changed: Any) -> Path:
    """A dataset, its pictures in parquet or in a video; format 3 has one file for all episodes."""
    root = folder / "dataset"
    is_new = version == "v3.0"
    data = "data/chunk-000/" + ("file-000" if is_new else "episode_{0:06d}") + ".parquet"
    film = "videos/{video_key}/chunk-{chunk_index:03d}/file-{file_index:03d}.mp4"
    if not is_new:
        film = "videos/chunk-{episode_chunk:03d}/{video_key}/episode_{episode_index:06d}.mp4"
    info = {"codebase_version": version, "chunks_size": 1000, "fps": 10, "video_path": film}
    info["features"] = {CAMERA: {"dtype": kind}, "action": {"dtype": "float32"}}
    (root / "meta").mkdir(parents=True)
    (root / "meta" / "info.json").write_text(json.dumps(info))
    episodes = [frames_of(package, number) for number in range(len(EPISODES))]
    for number, frames in enumerate([[*chain(*episodes)]] if is_new else episodes):
        rows = [{**f, **changed} for f in frames]
        for row in rows:
            shown = row.pop("shown")
            if kind == "image":
                row[CAMERA] = {"bytes": png(shown), "path": None}
        file = root / data.format(number)
        file.parent.mkdir(parents=True, exist_ok=True)
        parquet.write_table(pa.Table.from_pylist(rows), file)
        if kind == "video":
            places = {"chunk_index": 0, "file_index": 0, "episode_chunk": 0}
            film_of(root / film.format(video_key=CAMERA, episode_index=number, **places), frames)
    if is_new:
        entries = [
            {
                "episode_index": number,
                f"videos/{CAMERA}/chunk_index": 0,
                f"videos/{CAMERA}/file_index": 0,
                f"videos/{CAMERA}/from_timestamp": len(episodes[0]) / 10 * number,
            }
            for number in range(len(episodes))
        ]
        (root / "meta" / "episodes" / "chunk-000").mkdir(parents=True)
        file = root / "meta" / "episodes" / "chunk-000" / "file-000.parquet"
        parquet.write_table(pa.Table.from_pylist(entries), file)
    return root


def film_of(path: Path, frames: list[dict[str, Any]]) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    pictures = [Image.open(io.BytesIO(png(frame["shown"]))).convert("RGB") for frame in frames]
    with av.open(str(path), "w") as container:
        stream = container.add_stream("mpeg4", rate=10)
        stream.width, stream.height = pictures[0].size
        stream.pix_fmt, stream.bit_rate = "yuv420p", 8_000_000
        for picture in pictures:
            container.mux(stream.encode(av.VideoFrame.from_image(picture)))
        container.mux(stream.encode())


def write_lines(package: DomainPackage, folder: Path) -> Path:
    lines = []
    for number, skills in enumerate(EPISODES):
        seen, successes = play(package, skills)
        for observation in seen:
            (folder / f"{observation.key}.png").write_bytes(png(observation))
        for step, (skill, success) in enumerate(zip(skills, successes, strict=True)):
            name, _, rest = skill.partition("(")
            pictures = {
                "before": {CAMERA: f"{seen[step].key}.png"},
                "after": {CAMERA: f"{seen[step + 1].key}.png"},
            }
            called = {"skill": name, "arguments": rest.rstrip(")"), "success": success}
            lines.append(json.dumps({"episode": number, **called, **pictures}))
    path = folder / "log.jsonl"
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("version", ["v2.1", "v3.0"])
def test_the_same_model_as_from_lines(version: str, cubes: DomainPackage, tmp_path: Path) -> None:
    recordings = {
        "dataset-run": write(cubes, tmp_path, version, "image"),
        "lines": write_lines(cubes, tmp_path),
    }
    for name, recording in recordings.items():
        episodes = import_recording(cubes, recording, tmp_path / name)
        assert [len(e.transitions) for e in episodes] == [len(skills) for skills in EPISODES]
        learn_recorded(tmp_path / name)
    models = [(tmp_path / name / "model" / "model.json").read_bytes() for name in recordings]
    assert models[0] == models[1]


@pytest.mark.parametrize("version", ["v2.1", "v3.0"])
def test_frames_of_videos(version: str, cubes: DomainPackage, tmp_path: Path) -> None:
    found = read_recording(write(cubes, tmp_path, version, "video"), cubes.domain)
    for number, episode in enumerate(found):
        seen, successes = play(cubes, EPISODES[number])
        assert [t.success for t in episode.transitions] == successes
        for place, transition in enumerate(episode.transitions):
            for shown, expected in ((transition.before, place), (transition.after, place + 1)):
                assert distance(png(shown), png(seen[expected])) < 12


def distance(one: bytes, other: bytes) -> float:
    """Grey levels between two pictures, on average."""
    pictures = (np.asarray(Image.open(io.BytesIO(p)).convert("RGB"), int) for p in (one, other))
    first, second = pictures
    return float(np.abs(first - second).mean())


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"skill": "Pik(arm, red_cube)"}, "frames 0 to 2: unknown skill 'Pik'"),
        ({"skill": "Pick(arm"}, "expected a skill such as Pick(arm, cube)"),
        ({"success": "perhaps"}, "expected success to be true or false, got 'perhaps'"),
        ({CAMERA: {"bytes": b"nothing", "path": None}}, "frame 0: "),
        ({CAMERA: {"bytes": None, "path": "gone.png"}}, "gone.png"),
        ({CAMERA: 3}, "expected a dataset of LeRobot"),
    ],
)
def test_what_is_wrong_is_named(
    changed: dict[str, Any], said: str, cubes: DomainPackage, tmp_path: Path
) -> None:
    root = write(cubes, tmp_path, "v2.1", "image")
    file = root / "data" / "chunk-000" / "episode_000000.parquet"
    rows = [{**row, **changed} for row in parquet.read_table(file).to_pylist()]
    parquet.write_table(pa.Table.from_pylist(rows), file)
    with pytest.raises(FileError) as caught:
        import_recording(cubes, root, tmp_path / "run")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("name", ["meta/info.json", "data/chunk-000/episode_000000.parquet"])
def test_files_that_are_damaged(name: str, cubes: DomainPackage, tmp_path: Path) -> None:
    root = write(cubes, tmp_path, "v2.1", "image")
    (root / name).write_bytes((root / name).read_bytes()[:40])
    with pytest.raises(FileError, match="expected"):
        read_recording(root, cubes.domain)


def test_pyarrow_is_missing(
    cubes: DomainPackage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root = write(cubes, tmp_path, "v2.1", "image")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(MissingDependencyError, match=r"skillwrapper\[lerobot\]"):
        read_recording(root, cubes.domain)
