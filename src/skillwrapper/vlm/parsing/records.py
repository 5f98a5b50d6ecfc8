"""Records: one thing said in several named fields, in JSON, in a table or line below line.

Every record becomes the one line that a plain reply would have: ``name(arguments): what is said``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from skillwrapper.vlm.parsing.markup import Line, plain_line
from skillwrapper.vlm.parsing.memory import remembering
from skillwrapper.vlm.parsing.names import fold, words_of

NAMES = words_of(
    "statement atom grounding groundatom predicate signature fact proposition literal skill "
    "action function tool name predicatename skillname actionname"
)
"""Fields that name a statement, a predicate or a skill, the most telling ones first."""
ARGUMENTS = words_of(
    "arguments args parameters params objects types parameter argument variables inputs "
    "entities terms object"
)
"""Fields of what it is about."""
GROUPS = frozenset(("sequence", "plan", "trajectory", "option"))
"""Fields that tell which sequence a skill belongs to."""
_VALUES = words_of(
    "value label truth truthvalue answer verdict holds result judgement judgment status istrue "
    "finalanswer conclusion evaluation state classification finallabel finalverdict"
)
_MEANINGS = words_of(
    "semantics semantic semanticmeaning meaning definition description truewhen interpretation "
    "explanation"
)
_REASONS = words_of(
    "reasoning reason reasons rationale thought thoughts thinking analysis chainofthought cot "
    "evidence note notes comment comments justification observation observations scratchpad "
    "stepbystep confidence remark remarks why explanation"
)
_FIELDS = frozenset((*NAMES, *ARGUMENTS, *_VALUES, *_MEANINGS, *_REASONS))
_VERDICT_FIELDS = {
    "true": "true",
    "t": "true",
    "yes": "true",
    "false": "false",
    "f": "false",
    "no": "false",
    "unsure": "unsure",
    "unknown": "unsure",
    "uncertain": "unsure",
}
_CHECKED = frozenset(["✓", "✔", "✅", "☑", "yes", "true", "1", "•", "●", "o", "[x]"])
_RULE = re.compile(r"[|: +-]{3,}+")


def _fold_key(key: str) -> str:
    """A key as it is known here: no case, no signs, no number at its end."""
    return fold(key).rstrip("0123456789")


fold_key = remembering(_fold_key, len)


def is_reason(key: str) -> bool:
    """Whether a field holds reasoning, which is no answer."""
    return fold_key(key) in _REASONS


def says(keys: Iterable[str]) -> bool:
    """Whether fields with these folded keys say something of what another field names."""
    return any(key in keys for key in (*_VALUES, *_MEANINGS, *ARGUMENTS))


def entry(record: Mapping[str, str]) -> str | None:
    """The line for a record with folded keys; None if it does not name anything."""
    name = _first(record, NAMES)
    if not name:
        return None
    arguments = _first(record, ARGUMENTS)
    if arguments is not None and "(" not in name:
        given = "" if arguments.casefold() in {"none", "-", "null"} else arguments
        name = f"{name}({given.strip('()[]{} ')})"
    said = _first(record, _VALUES) or _marked_field(record)
    if said is None and not record.keys() & _VERDICT_FIELDS.keys():
        said = _first(record, _MEANINGS)
    return f"{name}: {said}" if said else name


def join_records(lines: Sequence[Line]) -> list[Line]:
    """The lines, with every row of a table and every block of fields as one of them."""
    joined: list[Line] = []
    end = 0
    for start in [n for n, line in enumerate(lines) if line.key or "|" in line.whole]:
        if start >= end:
            joined += lines[end:start]
            record, end = _record(lines, start)
            joined += record
    return [*joined, *lines[end:]]


def _record(lines: Sequence[Line], start: int) -> tuple[list[Line], int]:
    """The lines for what begins at a line, and where it ends."""
    line = lines[start]
    if "|" in line.whole and _is_rule(lines, start + 1):
        return _table(lines, start)
    if fold(line.key) in NAMES:
        return _block(lines, start)
    return [line], start + 1


def _first(record: Mapping[str, str], keys: Sequence[str]) -> str | None:
    return next((record[key] for key in keys if key in record), None)


def _marked_field(record: Mapping[str, str]) -> str | None:
    """The one of several fields ``true``, ``false``, ``unsure`` that is marked."""
    fields = [key for key in record if key in _VERDICT_FIELDS]
    if fields == ["true"]:
        return record["true"]
    if len(fields) < 2:
        return None
    cells = {key: record[key].strip().casefold() for key in fields}
    marked = [key for key in fields if cells[key] in _CHECKED]
    marked = marked or [key for key in fields if cells[key] == "x"]
    return _VERDICT_FIELDS[marked[0]] if len(marked) == 1 else None


def _is_rule(lines: Sequence[Line], number: int) -> bool:
    text = lines[number].whole if number < len(lines) else ""
    return "-" in text and _RULE.fullmatch(text) is not None


def _table(lines: Sequence[Line], start: int) -> tuple[list[Line], int]:
    """The rows of a table, and where it ends; rows that are no records stay as they are."""
    keys = tuple(fold_key(cell) for cell in _cells(lines[start].whole))
    rows = [lines[start]] if "(" in lines[start].whole else []
    group = ""
    number = start + 2
    while number < len(lines) and "|" in lines[number].whole:
        said, heading = _row((*keys, lines[number].whole))
        if said and heading != group:
            group = heading
            rows.append(plain_line(heading))
        rows.append(plain_line(said) if said else lines[number])
        number += 1
    return rows, number


def _read_row(keys_and_row: tuple[str, ...]) -> tuple[str | None, str]:
    """The line for a row of a table, and the heading of the group it says it belongs to."""
    *keys, row = keys_and_row
    record = dict(zip(keys, _cells(row), strict=False))
    heading = next((f"{key} {record[key]}:" for key in record if key in GROUPS), "")
    return entry(record), heading


_row = remembering(_read_row, lambda keys_and_row: sum(map(len, keys_and_row)))


def _cells(row: str) -> list[str]:
    return [cell.strip() for cell in row.removeprefix("|").removesuffix("|").split("|")]


def _block(lines: Sequence[Line], start: int) -> tuple[list[Line], int]:
    """A block of fields as one line, a single field as what it holds; and where it ends."""
    record: dict[str, str] = {}
    last, end = "", start + 1
    for number in range(start, len(lines)):
        line = lines[number]
        key = fold(line.key)
        if key in _FIELDS and (key in NAMES) is not bool(record) and key not in record:
            last, record[key] = key, line.value
        elif last in ARGUMENTS and line.listed and line.text and key not in NAMES:
            record[last] = f"{record[last]}, {line.text}".strip(", ")
        elif line.text or not record:
            break
        end = number + 1 if line.text else end
    if len(record) > 1:
        return [plain_line(entry(record) or "")], end
    only = lines[start]
    return [only._replace(text=only.value or only.text)], start + 1
