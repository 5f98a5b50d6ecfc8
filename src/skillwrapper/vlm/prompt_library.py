"""The prompts: Jinja2 templates, any of which a user can replace by a file of the same name."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import jinja2
import jinja2.meta
from jinja2 import nodes

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.vlm.template_sandbox import TemplateSandbox

_SUFFIX = ".j2"
_REFERENCES = (nodes.Include, nodes.Import, nodes.FromImport, nodes.Extends)


class PromptKind(StrEnum):
    """The prompts there are; the template's file is named after the value."""

    SYSTEM = "system"
    PROPOSE_SEQUENCES = "propose_sequences"
    INVENT_PRECONDITION = "invent_precondition"
    INVENT_EFFECT = "invent_effect"
    INVENT_DETERMINISM = "invent_determinism"
    INVENT_UNEXPLAINED = "invent_unexplained"
    INVENT_UNNOTICED = "invent_unnoticed"
    INVENT_BATCH = "invent_batch"
    REPHRASE = "rephrase"
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
        PromptKind.INVENT_UNNOTICED: _INVENTION | {"wide", "long"},
        PromptKind.INVENT_BATCH: _SCENE | {"slots", "count"},
        PromptKind.REPHRASE: frozenset({"domain", "candidate", "slots", "wanted"}),
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
        folders = [Path(__file__).parent / "prompts"]
        if overrides is not None:
            _check_folder(overrides)
            folders.insert(0, overrides)
        self._sandbox = TemplateSandbox(folders)
        self._templates = {kind: self._compile(kind) for kind in PromptKind}

    def render(self, kind: PromptKind, **variables: Any) -> str:
        """Fill in a template.

        Raises:
            ConfigurationError: if it fails, loops without end, or makes too long a text; names
                file and line.
        """
        return self._sandbox.render_bounded(self._templates[kind], variables).strip()

    def _compile(self, kind: PromptKind) -> jinja2.Template:
        name = f"{kind}{_SUFFIX}"
        parsed, file = self._sandbox.source_of(name)
        with self._sandbox.told(name):
            used = jinja2.meta.find_undeclared_variables(parsed)
        unknown = sorted(used - PROMPT_VARIABLES[kind])
        if unknown:
            raise ConfigurationError(
                f"prompt template {file}: unknown variable '{unknown[0]}'; "
                f"expected one of: {', '.join(sorted(PROMPT_VARIABLES[kind]))}"
            )
        self._check_referenced(parsed, {name})
        with self._sandbox.told(name):
            return self._sandbox.get_template(name)

    def _check_referenced(self, parsed: nodes.Template, known: set[str]) -> None:
        """Templates that are included or imported must be there and well formed themselves."""
        for reference in parsed.find_all(_REFERENCES):
            wanted = getattr(reference, "template", None)
            if not isinstance(wanted, nodes.Const) or getattr(reference, "ignore_missing", False):
                continue
            if str(wanted.value) not in known:
                known.add(str(wanted.value))
                try:
                    inner, _ = self._sandbox.source_of(str(wanted.value))
                except ConfigurationError as error:
                    raise ConfigurationError(
                        f"{error} (line {reference.lineno} of the template that names it)"
                    ) from error
                self._check_referenced(inner, known)


@cache
def shipped_prompts() -> PromptLibrary:
    """Our own templates, compiled once for all who use them."""
    return PromptLibrary()


def _check_folder(folder: Path) -> None:
    """A misspelt file name would be ignored in silence, so it is an error."""
    if not folder.is_dir():
        raise ConfigurationError(f"{folder}: expected a folder with prompt templates")
    known = {f"{kind}{_SUFFIX}" for kind in PromptKind}
    for path in sorted(folder.glob(f"*{_SUFFIX}")):
        if path.name not in known and not path.name.startswith("_"):
            raise UnknownNameError("prompt template", path.name, known, str(folder))
