"""Replies in JSON, flattened to the lines that the other parsers read."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

from skillwrapper.vlm.parsing.names import words_of
from skillwrapper.vlm.parsing.records import (
    ARGUMENTS,
    GROUPS,
    NAMES,
    entry,
    fold_key,
    is_reason,
    says,
)

_BEGINNING = re.compile(r"(?:\A|\n)[ \t]{0,40}(?:(?:[-*]|\d{1,3}[.)]) )?(?=[\[{])")
_LINE_REST = re.compile(r"[ \t,;]{0,20}(?=\n|\Z)")
_QUOTES = str.maketrans("\u201c\u201d\u2018\u2019", "\"\"''")
_QUOTED = re.compile(r"'([^'\"\\\n]{0,400})'")
_LAST_COMMA = re.compile(r",(?=[ \t\n]{0,200}[}\]])")
_COMMENT = re.compile(r"[ \t]{1,40}(?://|#)[^\n\"]{0,400}(?=\n)")
_WORDS = re.compile(r"\b(?:True|False|None)\b")
_JSON_WORDS = {"True": "true", "False": "false", "None": "null"}
_CONTAINERS = frozenset(
    words_of(
        "labels statements results answers output data predicates atoms groundings evaluation "
        "judgements judgments summary response final sequences plans steps plan sequence actions "
        "skills candidates proposals true false unsure unknown yes no truth values"
    )
)
_VERDICT_WORDS = frozenset(words_of("true false unsure unknown yes no null"))
_LEFT = ("name", "parameter", "variable", "key", "role", "param", "arg", "argument")
_RIGHT = ("type", "value", "object", "kind", "class", "entity")
_MOST_FAILURES = 8
_DEEPEST = 8


class _Object(list[tuple[str, Any]]):
    """An object of JSON: its keys with their values, one that is there twice included."""


_DECODER = json.JSONDecoder(object_pairs_hook=_Object)


def flatten_json(text: str) -> str:
    """The text with everything in JSON as one line for each thing that it says.

    Lists of lists become paragraphs, ``{"atom": true}`` becomes ``atom: true``, and an object
    with a name and arguments becomes ``name(arguments)``. A key that is there twice counts twice.
    What is no JSON stays as it is.
    """
    if "{" not in text and "[" not in text:
        return text
    parts, start, failures = [], 0, 0
    while failures < _MOST_FAILURES:
        found = _BEGINNING.search(text, start)
        if found is None:
            break
        parts.append(text[start : found.end()])
        decoded = _decode(text, found.end())
        start = decoded[1] if decoded else found.end()
        if decoded:
            parts.append("\n".join(_lines(decoded[0], 0)))
        else:
            failures += 1
    return "".join((*parts, text[start:]))


def _decode(text: str, start: int) -> tuple[Any, int] | None:
    """What stands in JSON, or nearly in JSON, at a place, and where it ends."""
    try:
        value, end = _DECODER.raw_decode(text, start)
    except (ValueError, RecursionError):
        return _decode_mended(text, start)
    rest = _LINE_REST.match(text, end)
    return (value, rest.end()) if rest and _says_something(value) else None


def _decode_mended(text: str, start: int) -> tuple[Any, int] | None:
    """The same for what ends with the reply or its code block: other quotes, commas, comments."""
    fence = text.find("\n```", start)
    end = len(text) if fence < 0 else fence
    written = text[start:end].strip().translate(_QUOTES)
    if written[-1:] not in {"}", "]"}:
        return None
    mended = _LAST_COMMA.sub("", _COMMENT.sub("", written))
    mended = _WORDS.sub(lambda word: _JSON_WORDS[word.group()], _QUOTED.sub(r'"\1"', mended))
    try:
        value = _DECODER.decode(mended)
    except (ValueError, RecursionError):
        return None
    return (value, end) if _says_something(value) else None


def _says_something(value: Any) -> bool:
    if isinstance(value, _Object):
        return True
    return isinstance(value, list) and all(isinstance(item, str | list) for item in value)


def _lines(data: Any, depth: int) -> Iterator[str]:
    if depth > _DEEPEST:
        return
    if isinstance(data, _Object):
        yield from _object_lines(data, depth)
    elif isinstance(data, list):
        yield from _list_lines(data, depth)
    else:
        yield _text(data)


def _list_lines(items: list[Any], depth: int) -> Iterator[str]:
    pair = _judged_pair(items) or _named_list(items)
    if pair:
        yield pair
        return
    nested = any(isinstance(item, list) and not isinstance(item, _Object) for item in items)
    group = ""
    for item in items:
        named = _group_of(item)
        if named != group:
            group = named
            yield named
        yield from _short_call(item) or _lines(item, depth + 1)
        if nested:
            yield ""


def _judged_pair(items: list[Any]) -> str | None:
    """``["holding(robot, cup)", true]``."""
    if len(items) != 2 or not isinstance(items[0], str) or "(" not in items[0]:
        return None
    said = _text(items[1]) if _is_plain(items[1]) else ""
    return f"{items[0]}: {said}" if said.casefold() in _VERDICT_WORDS else None


def _named_list(items: list[Any]) -> str | None:
    """``["Pick", ["robot", "cup"]]``."""
    if len(items) != 2 or not isinstance(items[0], str) or _is_plain(items[1]):
        return None
    inside = _arguments(items[1]) if items[0].isidentifier() else "("
    return None if "(" in inside else f"{items[0]}({inside})"


def _group_of(item: Any) -> str:
    """The heading of the sequence that a record says it belongs to."""
    if not isinstance(item, _Object):
        return ""
    fields = (f"{k} {_text(v)}:" for k, v in item if fold_key(k) in GROUPS and _is_plain(v))
    return next(fields, "")


def _short_call(item: Any) -> list[str]:
    """``{"Pick": ["robot", "cup"]}`` in a list."""
    if not isinstance(item, _Object) or len(item) != 1:
        return []
    (name, arguments) = item[0]
    fits = name.isidentifier() and fold_key(name) not in _CONTAINERS
    inside = "(" if not fits or _is_plain(arguments) else _arguments(arguments)
    return [] if "(" in inside else [f"{name}({inside})"]


def _object_lines(data: _Object, depth: int) -> Iterator[str]:
    record = _folded(data)
    with_parts = (key for key, value in record.items() if not _is_plain(value))
    said = entry(_texts(record)) if all(key in ARGUMENTS for key in with_parts) else None
    if said is not None:
        yield said
        return
    pairs = _paired_lists(data)
    if pairs is not None:
        yield from pairs
        return
    for key, value in data:
        if not is_reason(key) or isinstance(value, _Object):
            yield from _field_lines(key, value, depth)


def _paired_lists(data: _Object) -> list[str] | None:
    """``{"statements": ["f()", "g()"], "verdicts": [true, false]}``: nothing if one is shorter."""
    lists = [[_text(item) for item in v] for _, v in data if not _is_plain(v) and _is_flat(v)]
    named = [items for items in lists if all("(" in item for item in items)]
    said = [items for items in lists if _VERDICT_WORDS.issuperset(map(str.casefold, items))]
    if len(named) != 1 or len(said) != 1:
        return None
    fits = len(named[0]) == len(said[0])
    return [f"{a}: {b}" for a, b in zip(*named, *said, strict=True)] if fits else []


def _is_flat(items: list[Any]) -> bool:
    return bool(items) and not isinstance(items, _Object) and all(map(_is_plain, items))


def _field_lines(key: str, value: Any, depth: int) -> Iterator[str]:
    if _is_plain(value):
        yield f"{_text(value)}:" if fold_key(key) in NAMES else f"{key}: {_text(value)}"
    elif isinstance(value, _Object) and _is_said_of(value):
        yield entry({"statement": key, **_texts(_folded(value))}) or key
    elif isinstance(value, _Object) and _is_row(key, value):
        yield from (f"{key}({inner}): {_text(said)}" for inner, said in value)
    else:
        yield f"{key}:"
        yield from _lines(value, depth + 1)
        yield ""


def _is_said_of(value: _Object) -> bool:
    """``{"label": true, "reason": "..."}`` as the value of ``"holding(robot, cup)"``."""
    record = _folded(value)
    return says(record) and not record.keys() & set(NAMES)


def _is_row(key: str, value: _Object) -> bool:
    """``{"robot, cup": true}`` as the value of ``"holding"``."""
    if not key.isidentifier() or fold_key(key) in _CONTAINERS:
        return False
    said = [_text(v).casefold() if _is_plain(v) else "" for _, v in value]
    return all("(" not in k for k, _ in value) and _VERDICT_WORDS.issuperset(said)


def _folded(data: _Object) -> dict[str, Any]:
    return {fold_key(key): value for key, value in reversed(data)}


def _texts(record: Mapping[str, Any]) -> dict[str, str]:
    """The fields of a record as text; parameters beside a list of their types are typed."""
    texts = {key: _text(value) for key, value in record.items() if _is_plain(value)}
    given = [record[key] for key in ARGUMENTS if not _is_plain(record.get(key))]
    lists = [value for value in given if not isinstance(value, _Object)]
    if len(lists) == 2 and len(lists[0]) == len(lists[1]):
        given = [_Object((_argument(a), b) for a, b in zip(*lists, strict=True))]
    for key in ARGUMENTS:
        if texts.get(key, "")[:1] in {"{", "["}:
            decoded = _decode(texts[key], 0)
            given += [decoded[0]] if decoded else []
    return {**texts, ARGUMENTS[0]: _arguments(given[0])} if given else texts


def _arguments(given: list[Any]) -> str:
    if isinstance(given, _Object):
        return ", ".join(f"{key}: {_argument(value)}" for key, value in given)
    return ", ".join(map(_argument, given))


def _argument(item: Any) -> str:
    """One argument; ``{"name": "?r", "type": "robot"}`` is ``?r: robot``."""
    if not isinstance(item, _Object):
        return _text(item) if _is_plain(item) else ""
    record = {fold_key(key): _text(value) for key, value in item if _is_plain(value)}
    sides = [next((record[k] for k in keys if k in record), "") for keys in (_LEFT, _RIGHT)]
    if not any(sides):
        sides = [text for key, value in item[:1] for text in (key, _text(value))]
    return ": ".join(side for side in sides if side)


def _is_plain(value: Any) -> bool:
    """Whether a value has no parts."""
    return not isinstance(value, list)


def _text(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)
