"""Labels that a run read off its pictures, from ``truth_table.csv``."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.errors import RunFolderError

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
        """Read a truth table; it has a header for every scene.

        Raises:
            RunFolderError: if it is missing or damaged.
        """
        rows: dict[str, dict[str, bool | None]] = {}
        atoms: list[str] = []
        for number, (first, *cells) in enumerate(_lines(path), start=1):
            if first == "observation":
                atoms = cells
            elif len(cells) != len(atoms) or not set(cells) <= set(_VALUES):
                raise RunFolderError(f"{path}:{number}: expected {len(atoms)} labels of 1, 0 or ?")
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


def _lines(path: Path) -> Iterator[list[str]]:
    try:
        with path.open(newline="", encoding="utf-8") as file:
            yield from (line for line in csv.reader(file) if line)
    except OSError as error:
        raise RunFolderError(f"{path}: cannot be read ({error.strerror})") from error
