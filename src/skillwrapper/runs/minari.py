"""Datasets of Minari (HDF5) with a skill label for every step; read without Minari itself.

An episode is a group ``episode_N``. Its ``observations`` have one entry more than it has steps, and
hold the pictures: an array (steps + 1, height, width, 3) of bytes, or such arrays by the names of
cameras. Its ``infos`` say what was going on:

=========== ======================================================================================
``skill``   for every step the skill it is a part of, such as ``Pick(arm, red_cube)``; empty between
``success`` for every step whether the skill succeeded; that of its last step counts
``segment`` for every step a number that tells two runs of one skill in a row apart; may be missing
=========== ======================================================================================

Each has an entry for every step, or one more for the reset, which comes first and does not count.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from skillwrapper.errors import FileError, MissingDependencyError, PictureError
from skillwrapper.runs.labelled_steps import called_skill, label_text, label_truth, segments
from skillwrapper.runs.recorded_rows import RecordedRow
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import observation_of

_INSIDE = Path("data") / "main_data.hdf5"
_EPISODE = "episode_"
_MAIN = "main"
_DAMAGE = (OSError, KeyError, RuntimeError, TypeError, ValueError)
"""What reading HDF5 of another form raises."""


class MinariDataset:
    """An open dataset.

    Args:
        path: its file.
        file: the same, opened by ``h5py``.
    """

    def __init__(self, path: Path, file: Any) -> None:
        self._path, self._file = path, file
        self._known: dict[tuple[tuple[str, str], ...], Observation] = {}

    @staticmethod
    def is_one(path: Path) -> bool:
        """Whether a path looks like a dataset."""
        return path.suffix.lower() in (".hdf5", ".h5") or (path / _INSIDE).is_file()

    @classmethod
    @contextmanager
    def open(cls, path: Path) -> Iterator[MinariDataset]:
        """Open a dataset: its folder, or its file.

        Raises:
            MissingDependencyError: if ``h5py`` is not installed.
            FileError: if it cannot be read.
        """
        try:
            import h5py  # noqa: PLC0415
        except ImportError as error:
            raise MissingDependencyError("h5py", "pip install 'skillwrapper[minari]'") from error
        file = path / _INSIDE if path.is_dir() else path
        try:
            opened = h5py.File(file, "r")
        except OSError as error:
            raise FileError(f"{file}: expected a file of HDF5 ({error})") from error
        with closing(opened):
            try:
                yield cls(file, opened)
            except _DAMAGE as error:
                raise FileError(f"{file}: expected a dataset of Minari ({error})") from error

    def rows(self) -> Iterator[tuple[str, RecordedRow]]:
        """The skills in order of time, each with where it stands.

        Raises:
            FileError: if labels or pictures are missing or of another form.
        """
        names = [n for n, group in self._file.items() if _is_episode(n, group)]
        if not names:
            raise FileError(f"{self._path}: expected groups {_EPISODE}0, ..., got none")
        for name in sorted(names, key=lambda name: (len(name), name)):
            yield from self._episode(name)

    def load(self, files: Mapping[str, str]) -> Observation:
        """The pictures of a moment, each named ``EPISODE/NUMBER``."""
        key = tuple(files.items())
        if key not in self._known:
            looks = {}
            for camera, named in key:
                episode, _, number = named.partition("/")
                looks[camera] = np.asarray(self._cameras(episode)[camera][int(number)])
            try:
                self._known[key] = observation_of(looks)
            except PictureError as error:
                raise FileError(f"{self._path}: {key[0][1]}: {error}") from error
        return self._known[key]

    def _episode(self, name: str) -> Iterator[tuple[str, RecordedRow]]:
        cameras = self._cameras(name)
        steps = min(len(frames) for frames in cameras.values()) - 1
        skills = [label_text(label) for label in self._info(name, "skill", steps)]
        successes = self._info(name, "success", steps)
        parts = self._info(name, "segment", steps) if self._has(name, "segment") else [0] * steps
        marks = list(zip(skills, map(int, parts), strict=True))
        for begin, end in segments(marks):
            if not skills[begin]:
                continue
            where = f"{self._path}:{name}, steps {begin} to {end - 1}"
            called = called_skill(skills[begin], where)
            yield (
                where,
                RecordedRow(
                    episode=name,
                    skill=called.predicate,
                    arguments=called.terms,
                    success=label_truth(successes[end - 1], where),
                    before=dict.fromkeys(cameras, f"{name}/{begin}"),
                    after=dict.fromkeys(cameras, f"{name}/{end}"),
                ),
            )

    def _cameras(self, episode: str) -> dict[str, Any]:
        """The arrays of pictures, by camera."""
        found = self._file[episode].get("observations")
        arrays = {} if found is None else dict(found) if hasattr(found, "keys") else {_MAIN: found}
        cameras = {name: array for name, array in arrays.items() if _is_pictures(array)}
        if not cameras:
            raise FileError(
                f"{self._path}:{episode}: expected observations with pictures, arrays "
                "(steps + 1, height, width, 3) of bytes; got none"
            )
        return cameras

    def _has(self, episode: str, info: str) -> bool:
        return f"infos/{info}" in self._file[episode]

    def _info(self, episode: str, info: str, steps: int) -> Any:
        where = f"{self._path}:{episode}: infos/{info}"
        if not self._has(episode, info):
            raise FileError(f"{where}: expected a value for every step, got none")
        values = self._file[episode][f"infos/{info}"]
        if getattr(values, "shape", None) not in ((steps,), (steps + 1,)):
            got = getattr(values, "shape", "a group")
            raise FileError(f"{where}: expected {steps} values, or one more, got {got}")
        return values[len(values) - steps :]


def _is_episode(name: str, group: Any) -> bool:
    return name.startswith(_EPISODE) and hasattr(group, "keys")


def _is_pictures(array: Any) -> bool:
    shape: tuple[int, ...] = tuple(getattr(array, "shape", ()))
    return len(shape) == 4 and shape[-1] == 3 and array.dtype == np.uint8 and len(array) > 1
