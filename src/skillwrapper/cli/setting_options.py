"""Settings on the command line: the popular ones as options, all of them by file and ``--set``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any

import typer

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.runs.settings import RunSettings
from skillwrapper.runs.settings_layers import SettingsLayers
from skillwrapper.runs.settings_tree import Setting, setting
from skillwrapper.vlm.protocol import Role

ConfigOption = Annotated[
    Path | None,
    typer.Option(
        "--config", help="YAML file of settings, e.g. config.yaml of another run; see settings."
    ),
]
SetOption = Annotated[
    list[str] | None,
    typer.Option(
        "--set", help="NAME=VALUE: any setting, e.g. learning.attempts=5; may be repeated."
    ),
]
BaseUrlOption = Annotated[
    str | None,
    typer.Option(help="Address of an OpenAI-compatible endpoint, e.g. http://localhost:8000/v1."),
]
PromptsOption = Annotated[
    Path | None, typer.Option(help="Folder with prompt templates that replace the built-in ones.")
]
RolesOption = Annotated[
    list[str] | None,
    typer.Option("--role", help="ROLE=MODEL: another model for one role; may be repeated."),
]


class Until(StrEnum):
    """What ends a run before its last iteration."""

    CONVERGED = "converged"


UntilOption = Annotated[
    Until | None, typer.Option(help="Stop when an iteration brings nothing new.")
]

_POPULAR: Mapping[str, str] = MappingProxyType(
    {
        "seed": "seed",
        "iterations": "iterations",
        "budget": "exploration.budget",
        "explore": "exploration.explorer",
        "labels": "perception.labels",
        "learner": "learning.learner",
        "candidates": "exploration.candidates",
        "threshold": "learning.threshold",
        "model": "model.name",
        "base_url": "model.base_url",
        "prompts": "model.prompts",
        "noise": "model.noise",
        "parallel": "model.asking.parallel",
        "summarise": "model.asking.summarise",
        "votes": "model.asking.votes",
        "margin": "model.asking.margin",
        "timeout": "model.endpoint.timeout",
        "temperature": "model.endpoint.temperature",
        "max_output_tokens": "model.endpoint.max_output_tokens",
        "reasoning_effort": "model.endpoint.reasoning_effort",
        "image_size": "model.endpoint.image_size",
        "store": "calls.shared_store",
        "max_calls": "calls.max_calls",
        "max_cost": "calls.max_cost",
        "max_seconds": "calls.max_seconds",
    }
)
"""Settings with an option of their own, by the name of the parameter."""


def option(parameter: str) -> Any:
    """The option of a popular setting, with its meaning and default from the tree of settings."""
    found = setting(RunSettings, _POPULAR[parameter])
    return typer.Option(help=_help(found), show_default=_default(found))


def options_given(parameters: Mapping[str, Any]) -> dict[str, tuple[str, Any]]:
    """The settings that a command's parameters give, each with its value and where it came from.

    Raises:
        ConfigurationError: if a role is not given as ``ROLE=MODEL``.
        UnknownNameError: if there is no such role.
    """
    given = {
        setting_name: (f"--{name.replace('_', '-')}", parameters[name])
        for name, setting_name in _POPULAR.items()
        if parameters.get(name) is not None
    }
    if parameters.get("domain"):
        given["domain"] = ("DOMAIN", parameters["domain"])
    if parameters.get("role"):
        given["model.roles"] = ("--role", parse_roles(parameters["role"]))
    if parameters.get("until"):
        given["until_converged"] = ("--until", True)
    return given


def run_settings(
    config: Path | None, options: Mapping[str, tuple[str, Any]], assignments: Iterable[str]
) -> RunSettings:
    """The settings of a run: defaults, over them the file, the options, and ``--set``.

    Args:
        config: a YAML file; the ``run`` part of it, if it is the ``config.yaml`` of a run.
        options: by the name of the setting the option and its value.
        assignments: texts such as ``learning.attempts=5``.

    Raises:
        ConfigurationError: if a value is not what it should be; says where it came from.
        UnknownNameError: if there is no such setting.
    """
    layers = SettingsLayers(RunSettings)
    if config is not None:
        document = YamlDocument.read(config)
        is_of_run = isinstance(document.data, dict) and "run" in document.data
        layers.add_file(document.part("run") if is_of_run else document)
    for name, (origin, value) in options.items():
        layers.add(name, value, origin)
    for text in assignments:
        layers.assign(text)
    return layers.build()


def parse_roles(entries: Sequence[str]) -> dict[str, str]:
    """Models of single roles from ``ROLE=MODEL``.

    Raises:
        ConfigurationError: if an entry has another form, or a role is given twice.
        UnknownNameError: if there is no such role.
    """
    roles: dict[str, str] = {}
    for entry in entries:
        name, equals, model = entry.partition("=")
        if not (equals and model):
            raise ConfigurationError(
                f"--role: expected ROLE=MODEL, e.g. invent=openai:gpt-5, got '{entry}'"
            )
        if name not in list(Role):
            raise UnknownNameError("role", name, map(str, Role))
        if name in roles:
            raise ConfigurationError(f"--role: expected one model for '{name}', got two")
        roles[name] = model
    return roles


def _help(found: Setting) -> str:
    unit = f" ({found.unit})" if found.unit else ""
    return f"{found.meaning[0].upper()}{found.meaning[1:]}{unit}."


def _default(found: Setting) -> str | bool:
    return False if found.default in (None, [], {}) else str(found.default)
