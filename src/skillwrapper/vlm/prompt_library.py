"""The prompts: Jinja2 templates, any of which a user can replace by a file of the same name."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType
from typing import Any

import jinja2
import jinja2.meta

from skillwrapper.errors import ConfigurationError, UnknownNameError

_SUFFIX = ".j2"


class PromptKind(StrEnum):
    """The prompts there are; the template's file is named after the value."""

    SYSTEM = "system"
    PROPOSE_SEQUENCES = "propose_sequences"
    INVENT_PRECONDITION = "invent_precondition"
    INVENT_EFFECT = "invent_effect"
    INVENT_DETERMINISM = "invent_determinism"
    INVENT_UNEXPLAINED = "invent_unexplained"
    INVENT_BATCH = "invent_batch"
    EVALUATE = "evaluate"
    SUMMARISE = "summarise"
    NEXT_ACTION = "next_action"
    ASK_AGAIN = "ask_again"


_WITNESSES = frozenset({"domain", "skill", "executions", "captions", "objects"})
_INVENTION = _WITNESSES | {"slots", "current", "rejected", "count", "attempt"}
_SCENE = frozenset({"domain", "objects", "captions"})
_EXPLORATION = frozenset({"predicates", "operators", "least_explored", "scarce_skills"})

PROMPT_VARIABLES: Mapping[PromptKind, frozenset[str]] = MappingProxyType(
    {
        PromptKind.SYSTEM: frozenset({"domain"}),
        PromptKind.PROPOSE_SEQUENCES: _SCENE | _EXPLORATION | {"count", "length"},
        PromptKind.INVENT_PRECONDITION: _INVENTION,
        PromptKind.INVENT_EFFECT: _INVENTION,
        PromptKind.INVENT_DETERMINISM: _INVENTION,
        PromptKind.INVENT_UNEXPLAINED: _INVENTION | {"unexplained"},
        PromptKind.INVENT_BATCH: _SCENE | {"slots", "count"},
        PromptKind.EVALUATE: _SCENE | {"predicates", "atoms"},
        PromptKind.SUMMARISE: frozenset({"domain", "objects", "predicates", "atoms", "response"}),
        PromptKind.NEXT_ACTION: _SCENE | {"history"},
        PromptKind.ASK_AGAIN: frozenset({"problem", "time"}),
    }
)
"""What every template may speak of."""


class PromptLibrary:
    """All prompt templates, compiled once and checked before the first use.

    Args:
        overrides: a folder with templates that replace ours by file name, e.g. ``evaluate.j2``;
            they may import the pieces in ``_parts.j2``.

    Raises:
        ConfigurationError: if the folder or a template in it cannot be used; names the template
            and the variable or line.
    """

    def __init__(self, overrides: Path | None = None) -> None:
        self._environment = _make_environment(overrides)
        if overrides is not None:
            _check_folder(overrides)
        self._templates = {kind: self._compile(kind) for kind in PromptKind}

    def render(self, kind: PromptKind, **variables: Any) -> str:
        """Fill in a template.

        Raises:
            ConfigurationError: if it speaks of an attribute that does not exist.
        """
        try:
            return self._templates[kind].render(variables).strip()
        except jinja2.UndefinedError as error:
            raise ConfigurationError(
                f"prompt template {kind}{_SUFFIX}: {error.message}; "
                f"known variables: {_listing(PROMPT_VARIABLES[kind])}"
            ) from error

    def _compile(self, kind: PromptKind) -> jinja2.Template:
        name = f"{kind}{_SUFFIX}"
        try:
            self._check_variables(kind)
            return self._environment.get_template(name)
        except jinja2.TemplateSyntaxError as error:
            place = error.name or name
            raise ConfigurationError(
                f"prompt template {place}, line {error.lineno}: {error.message}"
            ) from error
        except jinja2.TemplateError as error:
            raise ConfigurationError(f"prompt template {name}: {error}") from error

    def _check_variables(self, kind: PromptKind) -> None:
        loader = self._environment.loader
        if loader is None:
            return
        source, _, _ = loader.get_source(self._environment, f"{kind}{_SUFFIX}")
        used = jinja2.meta.find_undeclared_variables(self._environment.parse(source))
        unknown = sorted(used - PROMPT_VARIABLES[kind])
        if unknown:
            where = f"prompt template {kind}{_SUFFIX}"
            raise ConfigurationError(
                f"{where}: unknown variable '{unknown[0]}'; "
                f"expected one of: {_listing(PROMPT_VARIABLES[kind])}"
            )


def _make_environment(overrides: Path | None) -> jinja2.Environment:
    ours = jinja2.FileSystemLoader(Path(__file__).parent / "prompts")
    loaders: list[jinja2.BaseLoader] = [ours]
    if overrides is not None:
        loaders.insert(0, jinja2.FileSystemLoader(overrides))
    return jinja2.Environment(
        loader=jinja2.ChoiceLoader(loaders),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=False,
        auto_reload=False,
    )


def _check_folder(folder: Path) -> None:
    """A misspelt file name would be ignored in silence, so it is an error."""
    if not folder.is_dir():
        raise ConfigurationError(f"{folder}: expected a folder with prompt templates")
    known = {f"{kind}{_SUFFIX}" for kind in PromptKind}
    for path in sorted(folder.glob(f"*{_SUFFIX}")):
        if path.name not in known and not path.name.startswith("_"):
            raise UnknownNameError("prompt template", path.name, known, str(folder))


def _listing(names: frozenset[str]) -> str:
    return ", ".join(sorted(names))
