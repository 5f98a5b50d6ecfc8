"""The folder of a run: where everything stands, and how it gets there safely.

config.yaml        what was asked for, with versions and commit
domain.yaml        the domain as it was
episodes/          001.jsonl ...: what was executed, a line each skill
images/            <sha256>.png
calls.sqlite       every model call
iterations/001/    truth table, predicates, operators, decisions, certificate
model/             domain.pddl, predicates.yaml, model.json
events.jsonl       what happened when
"""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import yaml

from skillwrapper.errors import RunFolderError
from skillwrapper.files.writing import is_leftover, write_atomically
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.runs.provenance import provenance
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world.observation import Observation, Picture

CONFIG = "config.yaml"


@dataclass(frozen=True)
class RunFolder:
    """The folder of one run.

    Attributes:
        path: where it is.
    """

    path: Path

    @classmethod
    def create_or_resume(cls, path: Path, config: RunSettings, domain_file: Path) -> RunFolder:
        """A new folder, or the folder of a run with the same configuration.

        Raises:
            RunFolderError: if the path holds something else, or a run with other settings.
        """
        folder = cls(path)
        if path.exists() and not path.is_dir():
            raise RunFolderError(f"{path}: expected a folder, got a file; choose another --out")
        if (path / CONFIG).exists():
            difference = folder.config().difference(config)
            if difference:
                raise RunFolderError(
                    f"{path} holds a run with other settings ({difference}); "
                    "give the same settings to resume it, or choose another --out"
                )
            folder._keep_domain(domain_file)
            return folder
        if path.exists() and not all(map(is_leftover, path.iterdir())):
            raise RunFolderError(
                f"{path} is not empty and holds no run; choose another --out, nothing was changed"
            )
        path.mkdir(parents=True, exist_ok=True)
        entries = {"run": config.model_dump(mode="json"), "made_with": provenance()}
        # First what makes the folder a run: one that was stopped right here can be resumed.
        write_atomically(path / CONFIG, yaml.safe_dump(entries, sort_keys=False))
        folder._keep_domain(domain_file)
        return folder

    @classmethod
    def open(cls, path: Path) -> RunFolder:
        """The folder of an existing run.

        Raises:
            RunFolderError: if there is no run.
        """
        if not (path / CONFIG).is_file():
            raise RunFolderError(
                f"{path}: expected the folder of a run (with {CONFIG}); "
                "make one with: skillwrapper learn DOMAIN --out DIR"
            )
        return cls(path)

    def _keep_domain(self, domain_file: Path) -> None:
        """Keep the domain as it is when the run starts."""
        kept = self.path / "domain.yaml"
        if not kept.exists():
            write_atomically(kept, domain_file.read_text(encoding="utf-8"))

    def config(self) -> RunSettings:
        """What the run was asked to do.

        Raises:
            ConfigurationError: if the file was damaged.
        """
        return YamlDocument.read(self.path / CONFIG).part("run").validate(RunSettings)

    @property
    def model(self) -> Path:
        """Where the learned model stands."""
        return self.path / "model"

    @property
    def calls(self) -> Path:
        """The store of model calls."""
        return self.path / "calls.sqlite"

    @property
    def events(self) -> Path:
        """The log of events."""
        return self.path / "events.jsonl"

    def episode(self, number: int) -> Path:
        """Where an episode (from 1) is recorded."""
        return self.path / "episodes" / f"{number:03d}.jsonl"

    def iteration(self, number: int) -> Path:
        """Where an iteration (from 1) is described."""
        return self.path / "iterations" / f"{number:03d}"

    def discard_beginning(self) -> None:
        """Remove what ``create_or_resume`` and a start without any result have written."""
        stores = self.path.glob(f"{self.calls.name}*")
        for path in (self.path / CONFIG, self.path / "domain.yaml", self.events, *stores):
            path.unlink(missing_ok=True)

    def finished_iterations(self) -> int:
        """How many iterations are complete."""
        number = 0
        while (self.iteration(number + 1) / "summary.json").exists():
            number += 1
        return number

    def save_observation(self, observation: Observation) -> list[dict[str, str]]:
        """Save the pictures; what is returned goes into a record."""
        for picture in observation.pictures:
            path = self.path / "images" / f"{picture.sha256}.png"
            if not path.exists():
                write_atomically(path, picture.png)
        return [{"camera": p.camera, "sha256": p.sha256} for p in observation.pictures]

    def load_observation(self, record: list[dict[str, str]]) -> Observation:
        """The observation of a record.

        Raises:
            RunFolderError: if a picture is missing or was changed.
        """
        return Observation(tuple(self._picture(r["sha256"], r["camera"]) for r in record))

    def _picture(self, sha256: str, camera: str) -> Picture:
        path = self.path / "images" / f"{sha256}.png"
        try:
            picture = Picture(path.read_bytes(), camera)
        except OSError as error:
            raise RunFolderError(f"{path}: the picture is missing") from error
        if picture.sha256 != sha256:
            raise RunFolderError(f"{path}: the picture was changed since it was recorded")
        return picture


@contextmanager
def held(path: Path) -> Iterator[None]:
    """Keep other runs out of a folder; one that is made for it and stays empty is removed.

    The operating system lets go of the folder when the process ends, however it ends.

    Raises:
        RunFolderError: if another run is at work in it, or it is a file.
    """
    if path.exists() and not path.is_dir():
        raise RunFolderError(f"{path}: expected a folder, got a file; choose another --out")
    is_new = not path.exists()
    path.mkdir(parents=True, exist_ok=True)
    handle = os.open(path, os.O_RDONLY)
    try:
        _lock(handle, path)
        yield
    finally:
        os.close(handle)
        if is_new and not any(path.iterdir()):
            path.rmdir()


def _lock(handle: int, path: Path) -> None:
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        raise RunFolderError(
            f"{path}: another process is learning in this folder; wait until it ends, or choose "
            "another --out"
        ) from error
    except OSError:
        """A file system without locks: nobody can be kept out."""
