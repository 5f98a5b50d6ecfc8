"""``skillwrapper review``: look through a run, and correct labels and predicates."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.output import messages, results
from skillwrapper.review.server import ReviewServer
from skillwrapper.review.session import Review
from skillwrapper.runs.archive import RunArchive


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(review)


def review(
    run: Annotated[Path, typer.Argument(help="Folder of a run.")],
    port: Annotated[int, typer.Option(min=0, max=65535, help="On 127.0.0.1; 0 for any.")] = 0,
) -> None:
    """Open a local page that shows labels in doubt, and takes corrections."""
    archive = RunArchive.open(run)
    archive.latest()  # first: a run without a finished iteration has nothing to show
    server = ReviewServer(Review(archive), port)
    results().print(server.url)
    messages().print("open this address in a browser on this machine; stop with Ctrl-C")
    try:
        server.serve()
    except KeyboardInterrupt:
        messages().print("stopped")
