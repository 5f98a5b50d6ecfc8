"""The argument that names a domain, alike in all commands."""

from __future__ import annotations

from typing import Annotated

import typer

from skillwrapper.domains.discovery import domain_names


def _complete(incomplete: str) -> list[str]:
    return [name for name in domain_names() if name.startswith(incomplete)]


_ARGUMENT = typer.Argument(
    help="A bundled or installed domain, the folder of one, or package.module:name.",
    metavar="DOMAIN",
    autocompletion=_complete,
    show_default=False,
)
DomainArgument = Annotated[str, _ARGUMENT]
OptionalDomainArgument = Annotated[str | None, _ARGUMENT]
