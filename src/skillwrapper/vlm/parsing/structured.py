"""Replies in JSON, flattened to the lines that the other parsers read."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

_FENCED = re.compile(r"```[\w-]*\s*\n(.*?)```", re.DOTALL)
_NAMES = ("predicate", "skill", "action", "name", "atom", "statement", "grounding")
_ARGUMENTS = ("arguments", "args", "parameters", "params", "objects", "types")
_VALUES = ("value", "label", "truth", "truth_value", "answer", "verdict", "holds", "result")
_MEANINGS = ("semantics", "semantic", "meaning", "definition", "description")
_DEEPEST = 8


def flatten_json(reply: str) -> str:
    """The reply itself, or if it is JSON, one line for each thing it says.

    Lists of lists become paragraphs, ``{"atom": true}`` becomes ``atom: true``, and an object
    with a name and arguments becomes ``name(arguments)``.
    """
    for candidate in (*_FENCED.findall(reply), reply):
        text = candidate.strip()
        if text[:1] in {"{", "["} and text[-1:] in {"}", "]"}:
            try:
                return "\n".join(_lines(json.loads(text), 0))
            except (ValueError, RecursionError):
                continue
    return reply


def _lines(data: Any, depth: int) -> Iterator[str]:
    if depth > _DEEPEST:
        return
    if isinstance(data, list):
        nested = any(isinstance(item, list) for item in data)
        for item in data:
            yield from _lines(item, depth + 1)
            if nested:
                yield ""
    elif isinstance(data, dict):
        entry = _entry(data)
        if entry is not None:
            yield entry
        else:
            yield from _pairs(data, depth)
    else:
        yield _scalar(data)


def _pairs(data: dict[str, Any], depth: int) -> Iterator[str]:
    for key, value in data.items():
        if isinstance(value, dict | list):
            yield f"{key}:"
            yield from _lines(value, depth + 1)
            yield ""
        else:
            yield f"{key}: {_scalar(value)}"


def _entry(data: dict[str, Any]) -> str | None:
    """``name(arguments): value or meaning`` of an object that is one entry of a list."""
    name = _first(data, _NAMES)
    if not isinstance(name, str):
        return None
    arguments = _first(data, _ARGUMENTS)
    if isinstance(arguments, dict):
        arguments = list(arguments.values())
    if isinstance(arguments, list) and "(" not in name:
        name = f"{name}({', '.join(map(_scalar, arguments))})"
    rest = [_first(data, keys) for keys in (_VALUES, _MEANINGS)]
    said = [_scalar(value) for value in rest if isinstance(value, str | bool | None)]
    said = [text for text in said if text != "null"]
    return f"{name}: {' '.join(said)}" if said else name


def _first(data: dict[str, Any], keys: tuple[str, ...]) -> Any:
    folded = {key.casefold(): value for key, value in data.items()}
    return next((folded[key] for key in keys if key in folded), None)


def _scalar(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)
