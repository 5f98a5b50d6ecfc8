"""Labels that a run read off its pictures: ``truth_table.csv``, with a header for each scene."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import read_text
from skillwrapper.runs.results import SceneLabels

_VALUES: Mapping[str, bool | None] = {"1": True, "0": False, "?": None}


@dataclass(frozen=True)
class RecordedLabels:
    """Labels by observation.

    Attributes:
        rows: for every observation's key the label of every ground atom, in order; None is
            unknown.
    """

    rows: Mapping[str, Mapping[str, bool | None]]

    @classmethod
    def read(cls, path: Path) -> RecordedLabels:
        """Read a truth table.

        Raises:
            FileError: if it is missing or damaged; names the file and the line.
        """
        rows: dict[str, dict[str, bool | None]] = {}
        atoms: list[str] = []
        for number, (first, *cells) in _lines(path):
            if first == "observation":
                atoms = cells
            elif len(cells) != len(atoms) or not set(cells) <= set(_VALUES):
                raise FileError(f"{path}:{number}: expected {len(atoms)} labels of 1, 0 or ?")
            else:
                values = (_VALUES[cell] for cell in cells)
                rows.setdefault(first, {}).update(zip(atoms, values, strict=True))
        return cls(rows)

    def of(self, key: str) -> Mapping[str, bool | None]:
        """The labels of an observation; empty if it was not read."""
        return self.rows.get(key, {})

    def count(self, predicate: str) -> Counter[bool | None]:
        """How often the groundings of a predicate were read as true, false and unknown."""
        start = f"{predicate}("
        return Counter(
            value for row in self.rows.values() for a, value in row.items() if a.startswith(start)
        )


def truth_table(scenes: Iterable[SceneLabels]) -> str:
    """Labels as CSV: 1 true, 0 false, ? unknown."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for scene in scenes:
        writer.writerow(["observation", *map(str, scene.space.atoms)])
        for observation, row in zip(scene.observations, scene.labels, strict=True):
            writer.writerow([observation.key, *("?" if v < 0 else int(v) for v in row)])
    return text.getvalue()


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """The lines that are not empty, with their numbers."""
    reader = csv.reader(io.StringIO(read_text(path)), strict=True)
    try:
        for line in reader:
            if line:
                yield reader.line_num, line
    except csv.Error as error:
        raise FileError(f"{path}:{reader.line_num}: expected a line of CSV ({error})") from error
