"""The pictures of a run: each once, named by its content."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.errors import FileError
from skillwrapper.files.writing import write_atomically
from skillwrapper.runs.archive.records import PictureRecord
from skillwrapper.world.observation import Observation, Picture


@dataclass(frozen=True)
class PictureStore:
    """The folder ``images/``.

    Attributes:
        folder: where it is.
    """

    folder: Path

    def path(self, sha256: str) -> Path:
        """Where a picture is kept."""
        return self.folder / f"{sha256}.png"

    def save(self, observation: Observation) -> tuple[PictureRecord, ...]:
        """Save the pictures of an observation; what is returned goes into a record."""
        for picture in observation.pictures:
            path = self.path(picture.sha256)
            if not path.exists():
                write_atomically(path, picture.png)
        return tuple(PictureRecord(camera=p.camera, sha256=p.sha256) for p in observation.pictures)

    def load(self, records: Sequence[PictureRecord]) -> Observation:
        """The observation of a record.

        Raises:
            FileError: if a picture is missing or was changed.
        """
        return Observation(tuple(Picture(self._read(r.sha256), r.camera) for r in records))

    def find(self, sha256: str) -> bytes | None:
        """The bytes of a picture; None if it is missing or was changed."""
        try:
            return self._read(sha256)
        except FileError:
            return None

    def _read(self, sha256: str) -> bytes:
        path = self.path(sha256)
        try:
            png = path.read_bytes()
        except OSError as error:
            raise FileError(f"{path}: the picture is missing") from error
        if Picture(png).sha256 != sha256:
            raise FileError(f"{path}: the picture was changed since it was recorded")
        return png
