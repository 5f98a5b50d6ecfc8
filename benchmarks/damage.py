"""Damaging files in the ways that crashes, disks and editors do."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

_JUNK: tuple[Any, ...] = (
    None, True, -1, 0, 10**30, 1.5, 1e308, "", "x", "../../etc/passwd", [], {}, [[]], {"a": {}},
)  # fmt: skip


def damage(path: Path, chance: random.Random) -> None:
    """Damage a file, or a structure in it if it holds JSON."""
    ways = [_cut, _empty, _flip, _insert, _drop_line, _double_line, _remove]
    if path.suffix in (".json", ".jsonl"):
        ways += [_replace_value, _drop_key] * 3
    chance.choice(ways)(path, chance)


def _cut(path: Path, chance: random.Random) -> None:
    data = path.read_bytes()
    path.write_bytes(data[: chance.randrange(len(data) + 1)])


def _empty(path: Path, chance: random.Random) -> None:
    path.write_bytes(b"")


def _remove(path: Path, chance: random.Random) -> None:
    path.unlink()


def _flip(path: Path, chance: random.Random) -> None:
    data = bytearray(path.read_bytes())
    for _ in range(min(len(data), chance.choice([1, 3, 30]))):
        data[chance.randrange(len(data))] = chance.randrange(256)
    path.write_bytes(data)


def _insert(path: Path, chance: random.Random) -> None:
    data, junk = path.read_bytes(), chance.choice([b"\0", b"\xff", b"[" * 2000, b"{}", b"\n", b"'"])
    place = chance.randrange(len(data) + 1)
    path.write_bytes(data[:place] + junk + data[place:])


def _drop_line(path: Path, chance: random.Random) -> None:
    lines = path.read_bytes().splitlines(keepends=True)
    if lines:
        del lines[chance.randrange(len(lines))]
    path.write_bytes(b"".join(lines))


def _double_line(path: Path, chance: random.Random) -> None:
    lines = path.read_bytes().splitlines(keepends=True)
    if lines:
        lines.insert(chance.randrange(len(lines)), chance.choice(lines))
    path.write_bytes(b"".join(lines))


def _replace_value(path: Path, chance: random.Random) -> None:
    def replace(holder: Any, key: Any) -> None:
        holder[key] = chance.choice(_JUNK)

    _change(path, chance, replace)


def _drop_key(path: Path, chance: random.Random) -> None:
    def drop(holder: Any, key: Any) -> None:
        del holder[key]

    _change(path, chance, drop)


def _change(path: Path, chance: random.Random, change: Callable[[Any, Any], None]) -> None:
    """Change one value anywhere in a document, or in one of its lines."""
    try:
        lines = path.read_text().splitlines() if path.suffix == ".jsonl" else [path.read_text()]
        number = chance.randrange(len(lines))
        whole = [json.loads(lines[number])]
    except (ValueError, IndexError):
        return
    change(*chance.choice(list(_places(whole))))
    lines[number] = json.dumps(whole[0]) if whole else ""
    path.write_text("\n".join(lines) + "\n")


def _places(holder: Any) -> Iterator[tuple[Any, Any]]:
    keys = holder if isinstance(holder, dict) else range(len(holder))
    for key in keys:
        yield holder, key
        if isinstance(holder[key], dict | list):
            yield from _places(holder[key])
