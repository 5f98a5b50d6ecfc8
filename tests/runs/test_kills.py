"""A run that is killed at any change to its files goes on and ends as if nothing had been.

Some of the changes; ``python -m benchmarks.kills`` takes all of them, and those of experiments.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from lamp_shop import write_lamp_shop

ROOT = Path(__file__).parents[2]
EVERY = 19

_SWEEP = """
import sys
from functools import partial
from pathlib import Path
from benchmarks.kills import Sweep, learn_in
place = Path(sys.argv[1])
learning = partial(learn_in, str(place / "shop"), 1, 4)
learning(place / "first")
sweep = Sweep.of(learning, place / "whole")
outcomes = list(sweep.kills(place, int(sys.argv[2])))
print(len(outcomes), [one for one in outcomes if one.wrong])
"""


def test_some_kills(tmp_path: Path) -> None:
    """In a process of its own, without threads: it is copied for every kill."""
    write_lamp_shop(tmp_path / "shop")
    line = [sys.executable, "-c", _SWEEP, str(tmp_path), str(EVERY)]
    done = subprocess.run(line, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    count, wrong = done.stdout.split(" ", 1)
    assert int(count) >= 4
    assert wrong.strip() == "[]", done.stderr
