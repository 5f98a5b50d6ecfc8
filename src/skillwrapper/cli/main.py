"""The command ``skillwrapper``."""

from __future__ import annotations

import sys

import typer
from rich.text import Text

from skillwrapper.cli import (
    domains,
    execution,
    experiments,
    explaining,
    exporting,
    learning,
    model_calls,
    models,
    operators,
    planning,
    problems,
    projects,
    recording,
    reporting,
    reviewing,
    settings,
    simulation,
    studies,
    theory,
    verification,
)
from skillwrapper.cli.output import messages
from skillwrapper.cli.own_code import place_in_own_code
from skillwrapper.cli.stopping import stoppable
from skillwrapper.errors import InternalError, LimitReachedError, RobotError, SkillWrapperError
from skillwrapper.redaction import without_secrets

app = typer.Typer(
    name="skillwrapper",
    help="Learn symbolic planning models of a robot's black-box skills from pictures.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
_GROUPS = (
    projects,
    execution,
    recording,
    learning,
    models,
    explaining,
    verification,
    operators,
    planning,
    exporting,
    domains,
    problems,
    experiments,
    reporting,
    reviewing,
    studies,
    theory,
    model_calls,
    settings,
    simulation,
)
for group in _GROUPS:
    group.register(app)


def main() -> None:
    """Run the command line, and end it when a signal says so."""
    stoppable(run)


def run() -> None:
    """Run the command line; a mistake of the user's ends with one sentence.

    So does one in code that they bring along.
    """
    try:
        app()
    except SkillWrapperError as error:
        _tell(error)
        sys.exit(error.exit_code)
    except Exception as error:
        place = place_in_own_code(error)
        if place is None:
            raise
        told = RobotError(f"{place}: {type(error).__name__}: {error}")
        _tell(told)
        sys.exit(told.exit_code)


def _tell(error: SkillWrapperError) -> None:
    kind, colour = "error:", "red"
    if isinstance(error, LimitReachedError):
        kind, colour = "stopped:", "yellow"
    elif isinstance(error, InternalError):
        kind = "internal error:"
    # Redacted once more: whatever a library wrote into a message, this is where it is seen.
    messages().print(
        Text.assemble((kind, colour), " ", without_secrets(str(error))), soft_wrap=True
    )


if __name__ == "__main__":
    main()
