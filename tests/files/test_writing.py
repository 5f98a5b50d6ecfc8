"""Files are written whole or not at all, and never put in the place of something else."""

from __future__ import annotations

import os
import stat
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import read_lines
from skillwrapper.files.writing import append_line, is_leftover, write_atomically, write_json


class CrashError(Exception):
    pass


def contents(path: Path) -> dict[str, bytes]:
    return {str(p.relative_to(path)): p.read_bytes() for p in path.rglob("*") if p.is_file()}


def test_writing_is_all_or_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A crash in the middle leaves the old file and, if anything can still run, no other one."""
    path = tmp_path / "deep" / "file"
    write_atomically(path, "old")

    def crash(handle: int) -> None:
        raise CrashError

    monkeypatch.setattr(os, "fsync", crash)
    with pytest.raises(CrashError):
        write_atomically(path, "new one")
    monkeypatch.undo()
    assert contents(path.parent) == {"file": b"old"}
    write_atomically(path, "new one")
    assert contents(path.parent) == {"file": b"new one"}


def test_content_is_on_the_disk_before_it_takes_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file first, then its name, then the folder (fault: no fsync before rename)."""
    steps: list[str] = []
    sync, replace = os.fsync, Path.replace

    def note_sync(handle: int) -> None:
        steps.append("folder" if stat.S_ISDIR(os.fstat(handle).st_mode) else "file")
        sync(handle)

    def note_replace(self: Path, target: Path) -> Path:
        steps.append("name")
        return replace(self, target)

    monkeypatch.setattr(os, "fsync", note_sync)
    monkeypatch.setattr(Path, "replace", note_replace)
    write_atomically(tmp_path / "file", "content")
    assert steps == ["file", "name", "folder"]


@pytest.mark.parametrize("device", ["/dev/null", "/dev/stdout"])
def test_devices_are_written_through(device: str, tmp_path: Path) -> None:
    """As root, ``--out /dev/null`` once put a file in the place of the device."""
    before = os.stat(device, follow_symlinks=False)
    through_link = tmp_path / "link"
    through_link.symlink_to(device)
    for path in (Path(device), through_link):
        write_atomically(path, b"")
    after = os.stat(device, follow_symlinks=False)
    assert (after.st_mode, after.st_ino) == (before.st_mode, before.st_ino)
    assert through_link.is_symlink()


def test_pipes_are_written_through(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    heard: list[bytes] = []
    listener = threading.Thread(target=lambda: heard.append(pipe.read_bytes()))
    listener.start()
    write_atomically(pipe, "for the other end")
    listener.join(timeout=10)
    assert heard == [b"for the other end"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert os.listdir(tmp_path) == ["pipe"]


@pytest.mark.parametrize("exists", [True, False])
def test_links_are_followed(tmp_path: Path, exists: bool) -> None:
    target = tmp_path / "elsewhere" / "file"
    if exists:
        write_atomically(target, "old")
    link = tmp_path / "link"
    link.symlink_to(target)
    write_atomically(link, "new")
    assert link.is_symlink()
    assert target.read_text() == "new"


def test_a_file_keeps_its_rights(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_text("old")
    path.chmod(0o640)
    write_atomically(path, "new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda folder: folder, "expected the name of a file, got a folder"),
        (lambda folder: folder / "file" / "inside", "cannot be written"),
        (lambda folder: folder / ("x" * 300), "File name too long"),
        (lambda folder: folder / "a\0b", "cannot be written"),
        (lambda folder: Path("/proc/nothing/here"), "cannot be written"),
        (lambda folder: folder / "round", "cannot be written"),
    ],
)
def test_what_cannot_be_written_is_one_sentence_and_leaves_nothing(
    tmp_path: Path, make: Callable[[Path], Path], reason: str
) -> None:
    (tmp_path / "file").write_text("mine")
    (tmp_path / "round").symlink_to(tmp_path / "round")
    before = sorted(os.listdir(tmp_path))
    with pytest.raises(FileError, match=reason):
        write_atomically(make(tmp_path), "x")
    with pytest.raises(FileError, match="cannot be written"):
        append_line(make(tmp_path), {})
    assert sorted(os.listdir(tmp_path)) == before
    assert (tmp_path / "file").read_text() == "mine"


def test_json_is_written_in_one_way(tmp_path: Path) -> None:
    for number, content in enumerate(({"b": 1, "a": [2]}, {"a": [2], "b": 1})):
        write_json(tmp_path / str(number), content)
    assert (tmp_path / "0").read_bytes() == (tmp_path / "1").read_bytes()


def test_what_a_crash_left_is_told_from_files() -> None:
    assert is_leftover(Path("x/.config.yaml.123.tmp"))
    assert not is_leftover(Path("x/config.yaml"))
    assert not is_leftover(Path("x/notes.tmp"))


def test_lines(tmp_path: Path) -> None:
    path = tmp_path / "lines.jsonl"
    assert read_lines(path) == []
    entries = [{"text": "line\nbreak\u2028"}, {"number": 1}]
    for entry in entries:
        append_line(path, entry)
    assert read_lines(path) == entries


@pytest.mark.parametrize("cut", ['{"a": 1}\n{"b"', '{"a": 1}\n{"b": 2}', '{"a": 1}\n'])
def test_a_last_line_that_was_cut_is_dropped(tmp_path: Path, cut: str) -> None:
    """Without a line break it was not written to its end, even if it looks whole.

    Reading changes nothing; the next line takes its place.
    """
    path = tmp_path / "lines.jsonl"
    path.write_text(cut)
    assert read_lines(path) == [{"a": 1}]
    assert path.read_text() == cut
    append_line(path, {"c": 3})
    assert read_lines(path) == [{"a": 1}, {"c": 3}]


def test_nothing_but_a_cut_line(tmp_path: Path) -> None:
    path = tmp_path / "lines.jsonl"
    path.write_text('{"a"')
    assert read_lines(path) == []
    append_line(path, {"c": 3})
    assert path.read_text() == '{"c": 3}\n'
