"""Mistakes in the code that users bring along: domains, simulators, scene readers, robots."""

from __future__ import annotations

import sys
import sysconfig
import traceback
from pathlib import Path

_OURS = Path(__file__).parents[1]
_NOT_OWN = tuple(f"{folder}/" for folder in (_OURS, sys.prefix, *sysconfig.get_paths().values()))


def place_in_own_code(error: BaseException) -> str | None:
    """The last line of a file of the user's that an error passed through; None if there is none."""
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if _is_own(frame.filename)]
    return f"{own[-1].filename}:{own[-1].lineno}" if own else None


def _is_own(file: str) -> bool:
    return not file.startswith(("<", *_NOT_OWN)) and Path(file).is_file()
