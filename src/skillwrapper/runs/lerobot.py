"""Datasets of LeRobot (parquet, PNG or MP4; formats 2 and 3), read without LeRobot and PyTorch.

``meta/info.json`` says which features there are: those of ``dtype`` ``image`` or ``video`` are the
cameras. What was going on stands in features of one value for every frame:

=========== ======================================================================================
``skill``   the skill that the frame is a part of, such as ``Pick(arm, red_cube)``; empty between
``success`` whether the skill succeeded; that of its last frame counts
``segment`` a number that tells two runs of one skill in a row apart; may be missing
=========== ======================================================================================

A frame is seen before its action, so a skill ends with the first frame after it, or with the last
one of the episode.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillwrapper.errors import FileError, MissingDependencyError, PictureError
from skillwrapper.files.json_documents import read_text
from skillwrapper.runs.labelled_steps import called_skill, label_text, label_truth, segments
from skillwrapper.runs.recorded_rows import RecordedRow
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import observation_of

_INFO = Path("meta") / "info.json"
_DAMAGE = (OSError, KeyError, RuntimeError, TypeError, ValueError, IndexError, AttributeError)
"""What reading parquet, videos and features of another form raises."""
_HOW = "pip install 'skillwrapper[lerobot]'"


class LeRobotDataset:
    """A dataset, read episode by episode.

    Args:
        path: its folder.
        parquet: the module that reads parquet.
    """

    def __init__(self, path: Path, parquet: Any) -> None:
        self._path, self._parquet = path, parquet
        self._info = json.loads(read_text(path / _INFO))
        kinds = {name: f.get("dtype") for name, f in self._info["features"].items()}
        self._images = [name for name, kind in kinds.items() if kind == "image"]
        self._videos = [name for name, kind in kinds.items() if kind == "video"]
        self._episode = -1
        self._frames: dict[str, list[Any]] = {}
        self._films: dict[str, tuple[_Film, int]] = {}
        self._known: dict[tuple[int, int], Observation] = {}

    @staticmethod
    def is_one(path: Path) -> bool:
        """Whether a path looks like a dataset."""
        return (path / _INFO).is_file()

    @classmethod
    @contextmanager
    def open(cls, path: Path) -> Iterator[LeRobotDataset]:
        """Open a dataset.

        Raises:
            MissingDependencyError: if ``pyarrow``, or ``av`` for videos, is not installed.
            FileError: if it cannot be read.
        """
        try:
            from pyarrow import parquet  # noqa: PLC0415
        except ImportError as error:
            raise MissingDependencyError("pyarrow", _HOW) from error
        try:
            yield cls(path, parquet)
        except _DAMAGE as error:
            said = " ".join(f"{type(error).__name__}: {error}".split())[:200]
            raise FileError(f"{path}: expected a dataset of LeRobot ({said})") from error

    def rows(self) -> Iterator[tuple[str, RecordedRow]]:
        """The skills in order of time, each with where it stands.

        Raises:
            FileError: if labels or pictures are missing or of another form.
        """
        if not self._images and not self._videos:
            raise FileError(f"{self._path / _INFO}: expected features that are images or videos")
        files = sorted((self._path / "data").rglob("*.parquet"))
        if not files:
            raise FileError(f"{self._path}: expected files data/**/*.parquet, got none")
        for file in files:
            yield from self._file_rows(file)

    def load(self, files: Mapping[str, str]) -> Observation:
        """The pictures of a frame of the episode that is being read, by its number."""
        frame = int(next(iter(files.values())))
        key = self._episode, frame
        if key not in self._known:
            looks = {camera: self._look(camera, frame) for camera in files}
            try:
                self._known[key] = observation_of(looks)
            except PictureError as error:
                where = f"{self._path}: episode {self._episode}, frame {frame}"
                raise FileError(f"{where}: {error}") from error
        return self._known[key]

    def _file_rows(self, file: Path) -> Iterator[tuple[str, RecordedRow]]:
        labels = ("episode_index", "skill", "success", "segment")
        present = set(self._parquet.read_schema(file).names)
        for name in labels[:3]:
            if name not in present:
                raise FileError(f"{file}: expected a feature '{name}' of every frame, got none")
        columns = [name for name in (*labels, *self._images) if name in present]
        table = self._parquet.read_table(file, columns=columns)
        episodes = table.column("episode_index").to_pylist()
        for begin, end in segments(episodes):
            self._start(int(episodes[begin]), table.slice(begin, end - begin))
            yield from self._episode_rows(file)

    def _start(self, episode: int, table: Any) -> None:
        """Turn to an episode."""
        self._episode = episode
        self._known.clear()
        self._frames = {name: table.column(name).to_pylist() for name in table.column_names}
        self._films = {name: self._film(name) for name in self._videos}

    def _episode_rows(self, file: Path) -> Iterator[tuple[str, RecordedRow]]:
        skills = [label_text(label or "") for label in map(_single, self._frames["skill"])]
        parts = [_single(value) for value in self._frames.get("segment", [0] * len(skills))]
        cameras = [*self._images, *self._videos]
        for begin, end in segments(list(zip(skills, parts, strict=True))):
            if not skills[begin]:
                continue
            where = f"{file}: episode {self._episode}, frames {begin} to {end - 1}"
            called = called_skill(skills[begin], where)
            yield (
                where,
                RecordedRow(
                    episode=str(self._episode),
                    skill=called.predicate,
                    arguments=called.terms,
                    success=label_truth(_single(self._frames["success"][end - 1]), where),
                    before=dict.fromkeys(cameras, str(begin)),
                    after=dict.fromkeys(cameras, str(min(end, len(skills) - 1))),
                ),
            )

    def _look(self, camera: str, frame: int) -> NDArray[np.uint8] | bytes | Path:
        if camera in self._films:
            film, first = self._films[camera]
            pixels: NDArray[np.uint8] = film.frame(first + frame)
            return pixels
        shown = self._frames[camera][frame]
        if shown["bytes"] is not None:
            return bytes(shown["bytes"])
        return Path(self._path, str(shown["path"]))

    def _film(self, camera: str) -> tuple[_Film, int]:
        """The file of a camera, and the number of the episode's first frame in it."""
        chunk = self._episode // int(self._info.get("chunks_size", 1000))
        places = {"video_key": camera, "episode_index": self._episode, "episode_chunk": chunk}
        first = 0
        if not str(self._info["codebase_version"]).startswith("v2"):
            entry, name = self._entry(), f"videos/{camera}"
            places |= {key: entry[f"{name}/{key}"] for key in ("chunk_index", "file_index")}
            first = round(float(entry[f"{name}/from_timestamp"]) * float(self._info["fps"]))
        return _Film(self._path / str(self._info["video_path"]).format(**places)), first

    def _entry(self) -> dict[str, Any]:
        """What the list of episodes says of this one."""
        for file in sorted((self._path / "meta" / "episodes").rglob("*.parquet")):
            for entry in self._parquet.read_table(file).to_pylist():
                if entry["episode_index"] == self._episode:
                    return dict(entry)
        raise FileError(f"{self._path}/meta/episodes: expected episode {self._episode}, got none")


class _Film:
    """Frames of a video, by their numbers; quickest in their order.

    Args:
        path: the file.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._frames: Iterator[Any] = iter(())
        self._next = -1

    def frame(self, number: int) -> NDArray[np.uint8]:
        """One frame (height, width, 3).

        Raises:
            MissingDependencyError: if ``av`` is not installed.
            FileError: if there are not so many.
        """
        if self._next < 0 or number < self._next:
            self._frames, self._next = _decoded(self._path), 0
        for shown in self._frames:
            self._next += 1
            if self._next > number:
                found: NDArray[np.uint8] = shown.to_ndarray(format="rgb24")
                return found
        raise FileError(f"{self._path}: expected a frame {number}, got {self._next} frames")


def _decoded(path: Path) -> Iterator[Any]:
    try:
        import av  # noqa: PLC0415
    except ImportError as error:
        raise MissingDependencyError("av", _HOW) from error
    with av.open(str(path)) as container:
        yield from container.decode(video=0)


def _single(value: Any) -> Any:
    """A value that may stand in a list of one."""
    return value[0] if isinstance(value, list) and len(value) == 1 else value
