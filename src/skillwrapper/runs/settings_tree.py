"""A tree of settings as users see it: names with dots, defaults, units, meanings.

Works on any pydantic model of which every field has a description; the unit of a number stands
in ``json_schema_extra``.
"""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import cache
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from pydantic_core import PydanticUndefined

from skillwrapper.errors import UnknownNameError

_KINDS: Mapping[type, str] = types.MappingProxyType(
    {
        int: "whole number",
        float: "number",
        bool: "true or false",
        str: "text",
        Path: "path",
        type(None): "none",
    }
)
_BOUNDS = (("ge", "from"), ("gt", "above"), ("le", "to"), ("lt", "below"))


@dataclass(frozen=True)
class Setting:
    """One setting.

    Attributes:
        name: keys with dots between them, e.g. ``learning.attempts``.
        default: plain data; None also for a setting that has none.
        required: whether a value must be given.
        expected: which values there are, in words.
        unit: of a number; empty for others.
        meaning: what it does.
        annotation: the Python type of its values.
    """

    name: str
    default: Any
    required: bool
    expected: str
    unit: str
    meaning: str
    annotation: Any = field(repr=False, compare=False)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        names = ("name", "default", "required", "expected", "unit", "meaning")
        return {name: getattr(self, name) for name in names}


@cache
def list_settings(model: type[BaseModel], prefix: str = "") -> tuple[Setting, ...]:
    """All settings of a tree, in its order."""
    return tuple(_settings(model, prefix))


def setting(model: type[BaseModel], name: str) -> Setting:
    """One setting.

    Raises:
        UnknownNameError: if there is none of this name.
    """
    known = {s.name: s for s in list_settings(model)}
    if name not in known:
        raise UnknownNameError("setting", name, known)
    return known[name]


def _settings(model: type[BaseModel], prefix: str) -> Iterator[Setting]:
    for name, info in model.model_fields.items():
        annotation = info.annotation
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            yield from _settings(annotation, f"{prefix}{name}.")
        else:
            yield _setting(f"{prefix}{name}", info)


def _setting(name: str, info: FieldInfo) -> Setting:
    required = info.is_required()
    default = None if required else info.get_default(call_default_factory=True)
    extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
    return Setting(
        name=name,
        default=None if default is PydanticUndefined else _plain(default),
        required=required,
        expected=_expected(info.annotation, info.metadata),
        unit=str(extra.get("unit", "")),
        meaning=info.description or "",
        annotation=info.annotation,
    )


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return list(value)
    return str(value) if isinstance(value, Path) else value


def _expected(annotation: Any, metadata: Sequence[Any] = ()) -> str:
    """The values of an annotated type in words, with their bounds."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _expected(arguments[0], metadata)
    if origin in (Union, types.UnionType):
        bounds = {part: () if part is type(None) else metadata for part in arguments}
        return " or ".join(_expected(part, bounds[part]) for part in arguments)
    if origin is tuple:
        return f"list of {_expected(arguments[0])}s"
    if origin is dict:
        return f"{_expected(arguments[0])} and {_expected(arguments[1])}"
    choices = _choices(annotation)
    if choices:
        return f"one of {', '.join(choices)}"
    return _KINDS.get(annotation, str(annotation)) + "".join(_bounds(metadata))


def _choices(annotation: Any) -> tuple[str, ...]:
    """The values of an annotated type that lists them all."""
    if get_origin(annotation) is Literal:
        return tuple(map(str, get_args(annotation)))
    if isinstance(annotation, type) and issubclass(annotation, Enum):
        return tuple(str(member.value) for member in annotation)
    return ()


def _bounds(metadata: Sequence[Any]) -> Iterator[str]:
    for key, word in _BOUNDS:
        for entry in metadata:
            bound = getattr(entry, key, None)
            if bound is not None:
                yield f" {word} {bound:g}"
