"""Recordings of skills from elsewhere (docs/running.md), as the episodes of a run.

A recording is taken as a whole or not at all: everything is read and checked first, and the folder
of the run appears in one step.
"""

from __future__ import annotations

import csv
import json
import os
import shutil
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from io import StringIO
from pathlib import Path
from typing import Protocol, TypeVar

from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import FileError, RunFolderError, UserError
from skillwrapper.files.json_documents import parse_record, read_entries, read_text
from skillwrapper.files.writing import explained
from skillwrapper.runs.archive import EpisodeFile, make_archive
from skillwrapper.runs.episodes import EpisodeSoFar
from skillwrapper.runs.lerobot import LeRobotDataset
from skillwrapper.runs.minari import MinariDataset
from skillwrapper.runs.recorded_rows import COLUMNS, RecordedRow
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_picture
from skillwrapper.world.skills import SkillInstance

Result = TypeVar("Result")


class PictureSource(Protocol):
    """Where the pictures of a recording are."""

    def load(self, files: Mapping[str, str]) -> Observation:
        """The observation of some cameras, by their names in the recording."""
        ...


def read_recording(path: Path, domain: Domain) -> tuple[EpisodeSoFar, ...]:
    """The episodes of a recording, in the order of their first rows.

    Args:
        path: a file ``.csv`` with a line of column names, or ``.jsonl``; pictures are named
            relative to it. Or a dataset of Minari (its folder, or its file ``.hdf5``) or of
            LeRobot (its folder).
        domain: what skills and objects there are.

    Raises:
        UserError: if anything in it is not what it should be; names file and line.
    """
    if MinariDataset.is_one(path):
        with MinariDataset.open(path) as dataset:
            return _read(path, dataset.rows(), dataset, domain)
    if LeRobotDataset.is_one(path):
        with LeRobotDataset.open(path) as lerobot:
            return _read(path, lerobot.rows(), lerobot, domain)
    return _read(path, _rows(path), _Pictures(path.parent), domain)


def _read(
    path: Path, rows: Iterator[tuple[str, RecordedRow]], pictures: PictureSource, domain: Domain
) -> tuple[EpisodeSoFar, ...]:
    """The episodes of rows, each with where it stands."""
    episodes: dict[str, EpisodeSoFar] = {}
    sizes: dict[str, tuple[int, int]] = {}
    for where, row in rows:
        transition = _checked(where, partial(_take, row, episodes, domain, pictures))
        for seen in (transition.before, transition.after):
            _checked(where, partial(_expect_sizes, seen, sizes))
    if not episodes:
        raise FileError(f"{path}: expected at least one execution, got none")
    return tuple(episodes.values())


def import_recording(package: DomainPackage, path: Path, out: Path) -> tuple[EpisodeSoFar, ...]:
    """Make the folder of a run out of a recording; nothing is learned yet.

    Args:
        package: the domain.
        path: the recording.
        out: the folder, which does not exist yet.

    Raises:
        UserError: if anything in it is not what it should be, or the folder exists; then there is
            no folder.
    """
    if out.exists():
        raise RunFolderError(f"{out}: expected a new folder, got one that exists; choose another")
    episodes = read_recording(path, package.domain)
    settings = RunSettings(domain=package.reference, iterations=len(episodes))
    beginning = out.with_name(f".{out.name}.{os.getpid()}.tmp")
    try:
        archive = make_archive(beginning, settings, package.domain)
        for number, episode in enumerate(episodes, start=1):
            file = EpisodeFile(archive.layout, number)
            file.start(episode.scene, episode.seed, episode.start, given=True)
            seen = episode.start
            for transition in episode.transitions:
                file.add(transition, seen)
                seen = transition.after
        with explained(out):
            beginning.rename(out)
    finally:
        shutil.rmtree(beginning, ignore_errors=True)
    return episodes


class _Pictures:
    """Reads each file once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._known: dict[tuple[tuple[str, str], ...], Observation] = {}

    def load(self, files: Mapping[str, str]) -> Observation:
        """The observation of some cameras."""
        if not files or not all(files.values()):
            raise FileError("expected a picture, got none")
        key = tuple(files.items())
        if key not in self._known:
            self._known[key] = Observation(
                tuple(load_picture(self._folder / file, camera) for camera, file in key)
            )
        return self._known[key]


def _take(
    row: RecordedRow, episodes: dict[str, EpisodeSoFar], domain: Domain, pictures: PictureSource
) -> Transition:
    """Add a row to the episode that it is of; what was added."""
    scene = domain.scene(row.scene)
    instance = SkillInstance(row.skill, row.arguments)
    domain.check_instance(instance, scene)
    before, after = pictures.load(row.before), pictures.load(row.after)
    episode = episodes.setdefault(row.episode, EpisodeSoFar(scene, 0, before, given=True))
    if episode.scene != scene:
        raise FileError(
            f"expected episode '{row.episode}' to stay in the scene '{episode.scene.name}', "
            f"got '{scene.name}'"
        )
    for seen in (before, after):
        if _cameras(seen) != _cameras(episode.start):
            expected, got = ", ".join(_cameras(episode.start)), ", ".join(_cameras(seen))
            raise FileError(f"expected pictures of {expected} as before, got {got}")
    episode.transitions.append(Transition(before, instance, row.success, after))
    return episode.transitions[-1]


def _expect_sizes(seen: Observation, sizes: dict[str, tuple[int, int]]) -> None:
    """Raise ``FileError`` unless each camera goes on giving pictures of one size.

    Args:
        seen: what cameras show.
        sizes: width and height so far, by camera; those of cameras not seen before are added.
    """
    for picture in seen.pictures:
        expected = sizes.setdefault(picture.camera, picture.size)
        if picture.size != expected:
            raise FileError(
                f"expected pictures of the camera '{picture.camera}' of {expected[0]} x "
                f"{expected[1]} pixels as before, got {picture.size[0]} x {picture.size[1]}; "
                "scale them alike, or give pictures of another view another camera"
            )


def _rows(path: Path) -> Iterator[tuple[str, RecordedRow]]:
    match path.suffix.lower():
        case ".csv":
            yield from _csv_rows(path)
        case ".jsonl":
            yield from read_entries(path, RecordedRow)
        case _:
            raise FileError(
                f"{path}: expected a file .csv, .jsonl or .hdf5, or a folder of Minari or LeRobot; "
                "its name says none of these"
            )


def _csv_rows(path: Path) -> Iterator[tuple[str, RecordedRow]]:
    reader = csv.DictReader(StringIO(read_text(path), newline=""), strict=True)
    try:
        names = [name.strip() for name in reader.fieldnames or ()]
        if set(names) | {"scene"} != set(COLUMNS) or len(set(names)) < len(names):
            raise FileError(
                f"{path}:1: expected the columns {', '.join(COLUMNS)} (scene may be missing), "
                f"got {', '.join(names) or 'none'}"
            )
        reader.fieldnames = names
        for entries in reader:
            where = f"{path}:{reader.line_num}"
            if None in entries or None in entries.values():
                raise FileError(f"{where}: expected {len(names)} values, got another number")
            yield where, parse_record(json.dumps(entries), RecordedRow, where)
    except csv.Error as error:
        raise FileError(f"{path}:{reader.line_num}: expected CSV ({error})") from error


def _checked(where: str, call: Callable[[], Result]) -> Result:
    """The result of a call; what is wrong gets its place."""
    try:
        return call()
    except UserError as error:
        raise FileError(f"{where}: {error}") from error


def _cameras(seen: Observation) -> list[str]:
    return sorted(picture.camera for picture in seen.pictures)
