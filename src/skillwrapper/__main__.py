"""The command ``skillwrapper``, and ``python -m skillwrapper``."""

from __future__ import annotations

import importlib

from skillwrapper.cli.stopping import stoppable


def main() -> None:
    """Run the command line; signals are heeded from the first moment on."""
    stoppable(lambda: importlib.import_module("skillwrapper.cli.main").run())


if __name__ == "__main__":
    main()
