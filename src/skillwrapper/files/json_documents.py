"""Reading JSON and lines of JSON so that every complaint names the file and the line."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError

from skillwrapper.errors import FileError
from skillwrapper.files.bounded import bounded_lines, read_bounded
from skillwrapper.files.mistakes import Location, first_mistake
from skillwrapper.files.yaml_documents import YamlDocument, compose

Model = TypeVar("Model", bound=BaseModel)

_AT_LINE = re.compile(r" at line (\d+) column \d+$")


def read_text(path: Path) -> str:
    """The text of a file.

    Raises:
        FileError: if it is missing, cannot be read, or is no UTF-8.
    """
    try:
        return str(read_bounded(path), "utf-8").replace("\r\n", "\n").replace("\r", "\n")
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise FileError(f"{path}: expected UTF-8 text") from error


def read_json(path: Path, model: type[Model]) -> Model:
    """The content of a JSON file as a pydantic model.

    Raises:
        FileError: if it is missing or something else; names the file and the line.
    """
    text = read_text(path)
    try:
        return model.model_validate_json(text)
    except ValidationError as error:
        line = _line_of_syntax(error)
        if line is not None:
            raise FileError(f"{path}:{line}: expected JSON") from error
        mistake = first_mistake(error, model)
        raise FileError(f"{_place(path, text, mistake.location)}: {mistake.text}") from error


def read_records(
    path: Path, model: type[Model], first: int = 1, last: int | None = None
) -> list[Model]:
    """The lines of a file of JSON lines, each as a pydantic model; none if there is no file.

    A last line that a crash cut short is left out; ``append_line`` removes it.

    Args:
        path: the file.
        model: what a line holds.
        first: number of the first line to read, from 1.
        last: number of the last line to read; None for all.

    Raises:
        FileError: if another line is something else; names the file and the line.
    """
    lines = enumerate(whole_lines(path)[first - 1 : last], start=first)
    return [parse_record(line, model, f"{path}:{number}") for number, line in lines]


def read_entries(path: Path, model: type[Model]) -> Iterator[tuple[str, Model]]:
    """The lines of a file of JSON lines that people write, each with its place, ``FILE:LINE``.

    Empty lines do not count; unlike ``read_records``, the file must be there, and its last line
    need not end.

    Raises:
        FileError: if it cannot be read, or a line is something else; names the file and the line.
    """
    for number, line in enumerate(_lines(path), start=1):
        if line.strip():
            where = f"{path}:{number}"
            yield where, parse_record(line, model, where)


def _lines(path: Path) -> Iterator[str]:
    """The lines of a text file without what ends them, never all at once in memory."""
    try:
        for line in bounded_lines(path):
            text = str(line, "utf-8").replace("\r\n", "\n").removesuffix("\n").removesuffix("\r")
            yield from text.replace("\r", "\n").split("\n")
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise FileError(f"{path}: expected UTF-8 text") from error


def parse_record(line: str | bytes, model: type[Model], where: str) -> Model:
    """A line of JSON as a pydantic model.

    Raises:
        FileError: if it is something else; names the place.
    """
    try:
        return model.model_validate_json(line)
    except ValidationError as error:
        if _line_of_syntax(error) is not None:
            raise FileError(f"{where}: expected a line of JSON") from error
        raise FileError(f"{where}: {first_mistake(error, model).text}") from error


def read_lines(path: Path) -> list[dict[str, Any]]:
    """The same as plain data.

    Raises:
        FileError: if a line is no JSON object.
    """
    found = []
    for number, line in enumerate(whole_lines(path), start=1):
        try:
            entry = json.loads(line)
        except (ValueError, RecursionError) as error:
            raise FileError(f"{path}:{number}: expected a line of JSON") from error
        if not isinstance(entry, dict):
            raise FileError(f"{path}:{number}: expected an object of JSON, got {line[:60]!r}")
        found.append(entry)
    return found


def whole_lines(path: Path) -> list[bytes]:
    """The lines of a file that were written to their end; none if there is no file.

    Raises:
        FileError: if it cannot be read.
    """
    try:
        data = read_bounded(path)
    except FileNotFoundError:
        return []
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror})") from error
    return data[: data.rfind(b"\n") + 1].split(b"\n")[:-1]


def _line_of_syntax(error: ValidationError) -> int | None:
    """The line where a text stops being JSON; None if it is JSON, but of something else."""
    first = error.errors(include_url=False)[0]
    if first["type"] != "json_invalid":
        return None
    found = _AT_LINE.search(str(first.get("ctx", {}).get("error", "")))
    return int(found[1]) if found else 1


def _place(path: Path, text: str, location: Location) -> str:
    try:
        return YamlDocument(path, None, compose(text)).place(location)
    except (yaml.YAMLError, RecursionError):
        return str(path)
