"""Settings of all tests."""

from __future__ import annotations

import functools
import gc
import signal

import typer.main
import typer.testing
from hypothesis import settings

from skillwrapper.threads import use_one_thread

use_one_thread()

# A shell that runs us in the background ignores Ctrl-C for us, and so for all that tests start.
signal.signal(signal.SIGINT, signal.default_int_handler)

# The same examples every time: a failure in one run is a failure in all.
settings.register_profile("fixed", derandomize=True, deadline=None)
settings.load_profile("fixed")

# Typer makes its commands anew for every line, which takes longer than most of them run.
_command_of = functools.cache(typer.main.get_command)
typer.main.get_command = typer.testing._get_command = _command_of


def pytest_collection_finish() -> None:
    """What was imported stays: nobody need look through it for garbage again and again."""
    gc.collect()
    gc.freeze()
