"""Whether start and goal are taken as they are read."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer


class Readings(StrEnum):
    """How pictures of start and goal are taken."""

    SINGLE = "single"
    """As they are read."""
    HYPOTHESES = "hypotheses"
    """As what likely lies behind what is read; one hypothesis after the other is tried."""


ReadingsOption = Annotated[
    Readings | None,
    typer.Option(
        help="Take pictures of start and goal as they are read (single, the default), or try what "
        "likely lies behind what is read, one after the other (hypotheses)."
    ),
]
