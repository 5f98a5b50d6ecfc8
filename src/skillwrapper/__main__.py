"""The command ``skillwrapper``, and ``python -m skillwrapper``."""

from __future__ import annotations

import importlib

from skillwrapper.cli.stopping import stoppable
from skillwrapper.threads import use_one_thread


def main() -> None:
    """Run the command line; signals are heeded from the first moment on."""
    use_one_thread()
    stoppable(lambda: importlib.import_module("skillwrapper.cli.main").run())


if __name__ == "__main__":
    main()
