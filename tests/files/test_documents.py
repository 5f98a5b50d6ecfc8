"""Damaged files are told in one sentence, with the file and the line."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest
from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.errors import ConfigurationError, FileError
from skillwrapper.files import json_documents
from skillwrapper.files.bounded import bounded_lines, read_bounded
from skillwrapper.files.json_documents import (
    read_json,
    read_lines,
    read_records,
    read_text,
    whole_lines,
)
from skillwrapper.files.yaml_documents import YamlDocument


class Part(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    name: str
    count: int = Field(default=1, ge=1)


class Whole(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)
    parts: tuple[Part, ...]


BOMB = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n" + "".join(
    f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]\n" for n in range(1, 9)
)
"""A few lines that hold 100 million values if all aliases are written out."""

GOOD = '{\n "parts": [\n  {\n   "name": "a",\n   "count": 2\n  }\n ]\n}\n'


def test_json_that_fits(tmp_path: Path) -> None:
    path = tmp_path / "whole.json"
    path.write_text(GOOD)
    assert read_json(path, Whole).parts[0].count == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r"whole\.json:1: expected JSON"),
        ('{\n "parts": [\n', r"whole\.json:\d: expected JSON"),
        ("[" * 100_000, r"whole\.json:1: expected JSON"),
        ("[]", r"whole\.json:1: 'the file': expected keys and values"),
        (GOOD.replace('"count"', '"cuont"'), r":5: unknown key 'parts.0.cuont'; did you mean"),
        (GOOD.replace("2", '"2"'), r":5: 'parts.0.count': expected a whole number, got '2'"),
        (GOOD.replace("2", "0"), r":5: 'parts.0.count': expected greater than or equal to 1"),
        (GOOD.replace('"name"', '"count"'), r":3: expected a value for 'parts.0.name', got none"),
    ],
)
def test_json_that_does_not(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "whole.json"
    path.write_text(text)
    with pytest.raises(FileError, match=message):
        read_json(path, Whole)


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    (tmp_path / "binary").write_bytes(b"\xff\xfe")
    for name, message in (("nothing", "No such file"), ("binary", "UTF-8"), (".", "directory")):
        with pytest.raises(FileError, match=message):
            read_json(tmp_path / name, Whole)


@pytest.mark.parametrize("read", [read_text, whole_lines])
def test_a_file_without_an_end(
    read: Callable[[Path], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    """From a fault found by use: a device named by mistake took all memory."""
    monkeypatch.setattr(json_documents, "read_bounded", partial(read_bounded, most=1 << 20))
    with pytest.raises(FileError, match=r"/dev/zero: cannot be read \(File too large\)"):
        read(Path("/dev/zero"))


def test_a_file_that_is_larger_than_any_sensible_one(tmp_path: Path) -> None:
    (tmp_path / "large").write_bytes(b"123456")
    assert read_bounded(tmp_path / "large", 6) == b"123456"
    with pytest.raises(OSError, match="too large"):
        read_bounded(tmp_path / "large", 5)


def test_lines_that_do_not_fit_are_named(tmp_path: Path) -> None:
    path = tmp_path / "parts.jsonl"
    path.write_text('{"name": "a"}\n{"name"\n{"name": "c"}\n')
    for read in (read_lines, lambda path: read_records(path, Part)):
        with pytest.raises(FileError, match=r"parts\.jsonl:2: expected a line of JSON"):
            read(path)
    path.write_text('{"name": "a"}\n{"name": 3}\n')
    with pytest.raises(FileError, match=r"parts\.jsonl:2: 'name': expected text, got 3"):
        read_records(path, Part)
    path.write_text("3\n")
    with pytest.raises(FileError, match=r"parts\.jsonl:1: expected an object of JSON"):
        read_lines(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a: 1\nb: 2\na: 3\n", r":3: expected valid YAML \(the key 'a' is given twice\)"),
        ("a:\n  b: 1\n  b: 2\n", r":3: .*'b' is given twice"),
        ("a: !!python/object/apply:os.getcwd []\n", r":1: expected valid YAML"),
        ("a: !thing 3\n", r":1: expected valid YAML"),
        ("? [a, b]\n: 1\n? {c: 1}\n: 2\n", r":1: .*expected text as a key"),
        ("[" * 300, r":1: .*expected at most 100 levels of nesting"),
        ("a: 1\nb: " + "{c: " * 200, r":2: .*levels of nesting"),
        ("a: 1\nb: &b [1, *b]\n", r":2: .*expected nothing that holds itself"),
        ("a: 1\nb: &b {c: {<<: *b}}\n", r":2: .*expected nothing that holds itself"),
        (BOMB, r":6: .*expected at most 200000 values with all aliases written out"),
        ("a: |\n" + "  x\n" * 300_000, r"file.yaml: expected at most 1000000 bytes, got more"),
        ("a: 1\nb: " + "9" * 6000, r":2: .*expected a value of the kind int"),
        ("a: 1\nb: !!int six\n", r":2: .*expected a value of the kind int"),
        ('a: 1\nb: "\\ud800"\n', r":2: .*got half a character"),
        ("a: [1\n", r":2: expected valid YAML"),
        ("a: 1\nb: a\0b\n", r":2: expected valid YAML \(got '\\x00'\)"),
        ("a: 1\nb: a\x1b[31m\n", r":2: expected valid YAML \(got '\\x1b'\)"),
    ],
)
def test_yaml_that_says_two_things_or_none(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=message):
        YamlDocument.read(path)


@pytest.mark.parametrize("encoding", ["utf-16", "latin-1"])
def test_yaml_in_another_encoding(tmp_path: Path, encoding: str) -> None:
    path = tmp_path / "file.yaml"
    path.write_bytes("a: 1\nb: é\n".encode(encoding))
    line = 1 if encoding == "utf-16" else 2
    with pytest.raises(ConfigurationError, match=rf"file\.yaml:{line}: expected UTF-8 text"):
        YamlDocument.read(path)


def test_yaml_with_a_mark_of_its_byte_order(tmp_path: Path) -> None:
    (tmp_path / "file.yaml").write_text("a: 1\n", encoding="utf-8-sig")
    assert YamlDocument.read(tmp_path / "file.yaml").data == {"a": 1}


def test_a_file_that_was_named_by_mistake_is_not_shown(tmp_path: Path) -> None:
    path = tmp_path / "passwd"
    path.write_text("root:x:0:0:root:/root:/bin/bash\ndaemon:x:1:1\n")
    with pytest.raises(ConfigurationError) as caught:
        YamlDocument.read(path).validate(Whole)
    assert str(caught.value) == f"{path}:1: 'the file': expected keys and values, got text"


def test_dates_stay_text(tmp_path: Path) -> None:
    """Also those that are none, which YAML's own reader ends with a traceback."""
    path = tmp_path / "file.yaml"
    path.write_text("a: 2001-99-99\nb: 2001-01-01\n")
    assert YamlDocument.read(path).data == {"a": "2001-99-99", "b": "2001-01-01"}


def test_a_part_knows_its_lines(tmp_path: Path) -> None:
    path = tmp_path / "file.yaml"
    path.write_text("other: 1\npart:\n  name: a\n  count: none\n")
    with pytest.raises(ConfigurationError, match=r"file\.yaml:4: 'count': expected a whole number"):
        YamlDocument.read(path).part("part").validate(Part)


def test_lines_come_one_by_one_and_are_bounded(tmp_path: Path) -> None:
    path = tmp_path / "lines"
    path.write_bytes(b"one\r\n\ntwo\nend")
    assert list(bounded_lines(path)) == [b"one\r\n", b"\n", b"two\n", b"end"]
    with pytest.raises(OSError, match="too large"):
        list(bounded_lines(path, 5))
    with pytest.raises(OSError, match="too large"):
        list(bounded_lines(Path("/dev/zero"), 1 << 20))
