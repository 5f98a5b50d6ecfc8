"""Writing files that a crash cannot spoil, and reading lines that it cut short."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from skillwrapper.errors import RunFolderError


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a file so that at any moment it is either the old one or the new one, whole."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    data = content.encode("utf-8") if isinstance(content, str) else content
    temporary.write_bytes(data)
    temporary.replace(path)


def write_json(path: Path, content: object) -> None:
    """Write JSON with sorted keys, atomically."""
    write_atomically(path, json.dumps(content, indent=1, sort_keys=True) + "\n")


def append_line(path: Path, entry: Mapping[str, Any]) -> None:
    """Append a JSON line in a single write."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("ab") as file:
        file.write(json.dumps(entry, sort_keys=True).encode("utf-8") + b"\n")


def read_lines(path: Path) -> Iterator[dict[str, Any]]:
    """The JSON lines of a file; a last line that a crash cut short is removed from the file.

    Raises:
        RunFolderError: if another line is no JSON.
    """
    if not path.exists():
        return
    data = path.read_bytes()
    whole = data[: data.rfind(b"\n") + 1]
    if len(whole) < len(data):
        write_atomically(path, whole)
    for number, line in enumerate(whole.splitlines(), start=1):
        try:
            yield json.loads(line)
        except ValueError as error:
            raise RunFolderError(f"{path}:{number}: expected a line of JSON") from error
