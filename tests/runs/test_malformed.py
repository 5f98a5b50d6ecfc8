"""Malformed domain files, recordings, replies and models: one sentence each, nothing half done.

Some of them; ``python -m benchmarks.malformed`` takes 2,000.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from benchmarks.malformed import GOOD, Malformed

from skillwrapper.errors import PictureError
from skillwrapper.world.pictures import load_picture


def test_what_is_malformed_is_named_in_one_sentence(tmp_path: Path) -> None:
    malformed = Malformed(tmp_path)
    found = [malformed.try_one(seed) for seed in range(5000, 5048)]
    assert [one for one in found if one.kind not in GOOD] == []
    assert sum(one.kind == "one sentence" for one in found) > 24


def test_a_name_that_no_file_has() -> None:
    with pytest.raises(PictureError, match="expected the name of a file"):
        load_picture(Path("a\0.png"))
