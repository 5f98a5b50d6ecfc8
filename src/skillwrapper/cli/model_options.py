"""The options about models, as commands take them."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.vlm.protocol import Role

ModelOption = Annotated[str, typer.Option(help="embedded, openai:NAME or recorded:DIR.")]
BaseUrlOption = Annotated[
    str | None,
    typer.Option(help="Address of an OpenAI-compatible endpoint, e.g. http://localhost:8000/v1."),
]
RolesOption = Annotated[
    list[str] | None,
    typer.Option("--role", help="ROLE=MODEL: another model for one role; may be repeated."),
]
PromptsOption = Annotated[
    Path | None, typer.Option(help="Folder with prompt templates that replace the built-in ones.")
]
ParallelOption = Annotated[int, typer.Option(min=1, help="Calls in flight at the same time.")]
VotesOption = Annotated[int, typer.Option(min=1, help="How often every label is asked for.")]
MarginOption = Annotated[
    float, typer.Option(min=0.0, max=1.0, help="Lead that a majority needs, as a share of votes.")
]
StoreOption = Annotated[
    Path | None, typer.Option(help="File in which several runs share replies; made if missing.")
]
MaxCallsOption = Annotated[int | None, typer.Option(min=0, help="Stop after so many calls.")]
MaxCostOption = Annotated[
    float | None, typer.Option(min=0.0, help="Stop after so many dollars, where prices are known.")
]
MaxSecondsOption = Annotated[float | None, typer.Option(min=0.0, help="Stop after so long.")]


class Until(StrEnum):
    """What ends a run before its last iteration."""

    CONVERGED = "converged"


def parse_roles(entries: Sequence[str]) -> dict[Role, str]:
    """Models of single roles from ``ROLE=MODEL``.

    Raises:
        ConfigurationError: if an entry has another form, or a role is given twice.
        UnknownNameError: if there is no such role.
    """
    roles: dict[Role, str] = {}
    for entry in entries:
        name, equals, model = entry.partition("=")
        if not (equals and model):
            raise ConfigurationError(
                f"--role: expected ROLE=MODEL, e.g. invent=openai:gpt-5, got '{entry}'"
            )
        if name not in list(Role):
            raise UnknownNameError("role", name, map(str, Role))
        if Role(name) in roles:
            raise ConfigurationError(f"--role: expected one model for '{name}', got two")
        roles[Role(name)] = model
    return roles
