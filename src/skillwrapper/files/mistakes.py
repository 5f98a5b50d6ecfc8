"""What is wrong with data that do not fit a model: where, what was expected, what came."""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from pydantic import BaseModel, ValidationError

from skillwrapper.redaction import without_secrets

Location = tuple[str | int, ...]
"""Keys and indices that lead to a value, e.g. ``("skills", "Pick", "parameters", 0)``."""

_LONGEST_SHOWN = 60
_EXPECTED: Mapping[str, str] = MappingProxyType(
    {
        "int_parsing": "expected a whole number",
        "int_type": "expected a whole number",
        "int_from_float": "expected a whole number",
        "float_parsing": "expected a number",
        "float_type": "expected a number",
        "bool_parsing": "expected true or false",
        "bool_type": "expected true or false",
        "string_type": "expected text",
        "list_type": "expected a list",
        "tuple_type": "expected a list",
        "dict_type": "expected keys and values",
        "model_type": "expected keys and values",
        "model_attributes_type": "expected keys and values",
        "dataclass_type": "expected keys and values",
    }
)
"""Kinds of mistakes that pydantic words for programmers."""

_LENGTHS: Mapping[str, str] = MappingProxyType(
    {
        "too_short": "at least {min_length} of them",
        "too_long": "at most {max_length} of them",
        "string_too_short": "at least {min_length} characters",
        "string_too_long": "at most {max_length} characters",
        "string_pattern_mismatch": "text of the form {pattern}",
    }
)
"""The same, with what pydantic tells beside."""

_KINDS: Mapping[type, str] = MappingProxyType({str: "text", list: "a list", type(None): "nothing"})


@dataclass(frozen=True)
class Mistake:
    """The first thing that is wrong.

    Attributes:
        location: where.
        text: what was expected and what came; names the place by its keys.
    """

    location: Location
    text: str


def first_mistake(error: ValidationError, model: type[BaseModel]) -> Mistake:
    """The mistake that says most about an error.

    A misspelt key is an unknown one and a missing one: the unknown one comes first.
    """
    mistakes = error.errors(include_url=False)
    unknown = (mistake for mistake in mistakes if mistake["type"] == "extra_forbidden")
    first = next(unknown, mistakes[0])
    location = tuple(part for part in first["loc"] if part != "[key]")
    name = ".".join(_printable(str(part)) for part in location) or "the file"
    if first["type"] == "extra_forbidden":
        return Mistake(location, f"unknown key '{name}'{_nearest_field(model, location)}")
    if first["type"] == "missing":
        return Mistake(location, f"expected a value for '{name}', got none")
    # What a whole file holds is not shown: it may be a file that was named by mistake.
    given = first.get("input")
    got = shorten(repr(given)) if location else _KINDS.get(type(given), type(given).__name__)
    expected = _expected(first["type"], first["msg"], first.get("ctx", {}))
    return Mistake(location, f"'{name}': {expected}, got {got}")


def _printable(text: str) -> str:
    return text if text.isprintable() else repr(text)[1:-1]


def shorten(text: str) -> str:
    """A text that fits into a sentence, without secrets: of one that is cut none is known again."""
    text = without_secrets(text)
    return text if len(text) < _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 3] + "..."


def fields_at(model: type[BaseModel], path: Location) -> list[str]:
    """Names of the fields of the model nested at a path; empty if it cannot be told."""
    models = [model]
    for part in path:
        inner: list[type[BaseModel]] = []
        for candidate in models:
            if isinstance(part, str) and part in candidate.model_fields:
                inner += models_in(candidate.model_fields[part].annotation)
        models = inner or models
    return sorted({name for candidate in models for name in candidate.model_fields})


def models_in(annotation: Any) -> list[type[BaseModel]]:
    """The models that values of an annotated type hold."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    arguments = getattr(annotation, "__args__", ())
    return [model for argument in arguments for model in models_in(argument)]


def _expected(kind: str, message: str, context: Mapping[str, Any]) -> str:
    if kind in _EXPECTED:
        return _EXPECTED[kind]
    if kind in _LENGTHS:
        return f"expected {_LENGTHS[kind].format(**context)}"
    if message.startswith("Input should be "):
        return "expected " + message.removeprefix("Input should be ")
    return message.removeprefix("Value error, ")


def _nearest_field(model: type[BaseModel], location: Location) -> str:
    """A hint naming the valid key nearest to an unknown one."""
    fields = fields_at(model, location[:-1])
    near = difflib.get_close_matches(str(location[-1]), fields, n=1, cutoff=0.4)
    if near:
        return f"; did you mean '{near[0]}'?"
    return f"; expected one of: {', '.join(fields)}" if fields else ""
