"""The command ``skillwrapper``."""

from __future__ import annotations

import sys

import typer

from skillwrapper.cli import (
    domains,
    experiments,
    learning,
    model_calls,
    models,
    planning,
    problems,
    reporting,
    settings,
    studies,
)
from skillwrapper.cli.output import messages
from skillwrapper.errors import InternalError, LimitReachedError, SkillWrapperError

app = typer.Typer(
    name="skillwrapper",
    help="Learn symbolic planning models of a robot's black-box skills from pictures.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
_GROUPS = (
    learning,
    models,
    planning,
    domains,
    problems,
    experiments,
    reporting,
    studies,
    model_calls,
    settings,
)
for group in _GROUPS:
    group.register(app)


def main() -> None:
    """Run the command line; a mistake of the user's ends with one sentence and exit code 2."""
    try:
        app()
    except KeyboardInterrupt:
        messages().print("[yellow]stopped[/]; run the same command again to go on")
        sys.exit(130)
    except LimitReachedError as error:
        messages().print(f"[yellow]stopped:[/] {error}", markup=True)
        sys.exit(error.exit_code)
    except SkillWrapperError as error:
        kind = "internal error" if isinstance(error, InternalError) else "error"
        console = messages()
        console.print(f"[red]{kind}:[/] ", end="")
        console.print(str(error), markup=False, soft_wrap=True)
        sys.exit(error.exit_code)


if __name__ == "__main__":
    main()
