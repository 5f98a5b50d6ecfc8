"""Datasets of Minari: the same model as from the same episodes in another form."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cubes import EPISODES, play

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.domains.starting import start_project
from skillwrapper.errors import FileError, MissingDependencyError
from skillwrapper.runs.launch import learn_recorded
from skillwrapper.runs.recordings import import_recording, read_recording
from skillwrapper.world.pictures import load_picture

h5py = pytest.importorskip("h5py", reason="the extra minari is not installed")


@pytest.fixture
def cubes(tmp_path: Path) -> DomainPackage:
    start_project(tmp_path / "cubes")
    return find_domain(str(tmp_path / "cubes"))


def pixels(folder: Path, observation: Any) -> Any:
    path = folder / f"{observation.key}.png"
    path.write_bytes(observation.picture().png)
    with load_image(path) as image:
        return np.asarray(image.convert("RGB"))


def load_image(path: Path) -> Any:
    from PIL import Image  # noqa: PLC0415

    assert load_picture(path)
    return Image.open(path)


def write(package: DomainPackage, folder: Path, **changed: Any) -> Path:
    """Each skill takes two steps, with a step of nothing after it; infos begin with the reset."""
    path = folder / "dataset" / "data" / "main_data.hdf5"
    path.parent.mkdir(parents=True)
    with h5py.File(path, "w") as file:
        for number, skills in enumerate(EPISODES):
            seen, successes = play(package, skills)
            frames, labels, outcomes, segments = [seen[0]], [""], [False], [0]
            for skill, success, segment in zip(skills, successes, range(99), strict=False):
                frames += [seen[segment], seen[segment + 1], seen[segment + 1]]
                labels += [skill, skill, ""]
                outcomes += [False, success, False]
                segments += [segment] * 3
            group = file.create_group(f"episode_{number}")
            group["observations/main"] = np.stack([pixels(folder, o) for o in frames])
            group["observations/joints"] = np.zeros((len(frames), 7))
            infos = {"skill": labels, "success": outcomes, "segment": segments, **changed}
            for name, values in infos.items():
                if values is not None:
                    group[f"infos/{name}"] = values
    return path


def write_lines(package: DomainPackage, folder: Path) -> Path:
    lines = []
    for number, skills in enumerate(EPISODES):
        seen, successes = play(package, skills)
        names = []
        for observation in seen:
            names.append(f"{observation.key}.png")
            (folder / names[-1]).write_bytes(observation.picture().png)
        for step, (skill, success) in enumerate(zip(skills, successes, strict=True)):
            name, _, rest = skill.partition("(")
            pictures = {"before": names[step], "after": names[step + 1]}
            called = {"skill": name, "arguments": rest.rstrip(")"), "success": success}
            lines.append(json.dumps({"episode": number, **called, **pictures}))
    path = folder / "log.jsonl"
    path.write_text("\n".join(lines))
    return path


def test_the_same_model_as_from_lines(cubes: DomainPackage, tmp_path: Path) -> None:
    dataset = write(cubes, tmp_path)
    recordings = {"folder": dataset.parents[1], "lines": write_lines(cubes, tmp_path)}
    for name, recording in recordings.items():
        episodes = import_recording(cubes, recording, tmp_path / name)
        assert [len(e.transitions) for e in episodes] == [len(skills) for skills in EPISODES]
        learn_recorded(tmp_path / name)
    models = [(tmp_path / name / "model" / "model.json").read_bytes() for name in recordings]
    assert models[0] == models[1]


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"skill": None}, "episode_0: infos/skill: expected a value for every step"),
        ({"success": [True]}, "infos/success: expected 12 values, or one more, got"),
        ({"success": ["maybe"] * 13}, "expected success to be true or false, got 'maybe'"),
        ({"segment": ["one"] * 13}, "expected a dataset of Minari"),
        ({"skill": ["Fly away"] * 13}, r"steps 0 to \d+: expected a skill such as"),
        ({"skill": ["Fly(arm)"] * 13}, r"steps 0 to \d+: unknown skill 'Fly'"),
    ],
)
def test_what_is_wrong_is_named_and_nothing_imported(
    cubes: DomainPackage, tmp_path: Path, changed: dict[str, Any], words: str
) -> None:
    dataset = write(cubes, tmp_path, **changed)
    with pytest.raises(FileError, match=words):
        import_recording(cubes, dataset, tmp_path / "run")
    assert not (tmp_path / "run").exists()


def _without_pictures(file: Any) -> None:
    del file["episode_0/observations/main"]


def _without_episodes(file: Any) -> None:
    for name in list(file):
        del file[name]


@pytest.mark.parametrize(
    ("damage", "words"),
    [(_without_pictures, "observations with pictures"), (_without_episodes, "groups episode_0")],
)
def test_files_of_another_form_are_refused(
    cubes: DomainPackage, tmp_path: Path, damage: Callable[[Any], None], words: str
) -> None:
    dataset = write(cubes, tmp_path)
    with h5py.File(dataset, "a") as file:
        damage(file)
    with pytest.raises(FileError, match=words):
        read_recording(dataset, cubes.domain)
    dataset.write_bytes(b"no HDF5")
    with pytest.raises(FileError, match="expected a file of HDF5"):
        read_recording(dataset, cubes.domain)


def test_without_h5py_it_says_how_to_install_it(
    cubes: DomainPackage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(MissingDependencyError, match=r"skillwrapper\[minari\]"):
        read_recording(Path("data.hdf5"), cubes.domain)
