"""Running commands in the process of the test."""

from __future__ import annotations

import sys
from pathlib import Path

from skillwrapper.cli.main import main


def command(*words: str | Path) -> int:
    """Run a command; its exit code."""
    before, sys.argv = sys.argv, ["skillwrapper", *map(str, words)]
    try:
        main()
    except SystemExit as ended:
        return int(ended.code or 0)
    finally:
        sys.argv = before
    return 0
