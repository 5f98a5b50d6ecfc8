"""The log of a run, which a resumed run takes up where it ends."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import parse_record, whole_lines
from skillwrapper.files.writing import append_line, explained
from skillwrapper.runs.archive.records import EventRecord


class EventLog:
    """Puts lines into a log that are not there yet.

    A run that goes on meets the events of the earlier one again, in the same order: those are in
    the log already, with the time at which they happened first. A log that goes another way from
    some line on, or is damaged there, is cut off before that line.

    Args:
        path: the file; made with the first line.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._earlier = deque(_readable(path))
        self._met = 0  # bytes of the lines that were met again

    def note(self, name: str, iteration: int, told: Mapping[str, Any]) -> None:
        """Put an event into the log, unless an earlier run has.

        Args:
            name: of the event.
            iteration: in which it happened.
            told: what describes it.

        Raises:
            FileError: if the log cannot be written.
        """
        if self._earlier:
            line, known = self._earlier.popleft()
            if (known.event, known.iteration) == (name, iteration):
                self._met += len(line) + 1
                return
            self._earlier.clear()
        self._cut_off()
        head = {"time": round(time.time(), 3), "event": name, "iteration": iteration}
        self._met += append_line(self._path, {**told, **head}, durable=False)

    def _cut_off(self) -> None:
        """Remove what stands behind the last line that was met or written."""
        with explained(self._path):
            if self._path.exists() and self._path.stat().st_size > self._met:
                os.truncate(self._path, self._met)


def _readable(path: Path) -> Iterator[tuple[bytes, EventRecord]]:
    """The lines of a log with their events, up to the first that is damaged."""
    for number, line in enumerate(whole_lines(path), start=1):
        try:
            yield line, parse_record(line, EventRecord, f"{path}:{number}")
        except FileError:
            return
