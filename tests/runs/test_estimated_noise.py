"""A noise profile out of a run is one that the embedded model takes."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.embedded.noise import read_profile
from skillwrapper.runs.archive.records import DecodingRecord, ErrorRatesRecord
from skillwrapper.runs.estimated_noise import estimate_profile, print_profile
from skillwrapper.symbols import Predicate


def test_it_can_be_read_back(tmp_path: Path) -> None:
    predicates = (Predicate("wet", ("pot",)), Predicate("over", ("bell", "pot")))
    rates = tuple(
        ErrorRatesRecord(
            predicate=p.name,
            false_positive=0.1,
            false_negative=0.02,
            negatives=200.0,
            positives=100.0,
        )
        for p in predicates
    )
    decoding = DecodingRecord(readings=600, in_doubt=0, dirty=0.4, rates=rates, overruled=())
    path = tmp_path / "estimated.yaml"
    path.write_text(print_profile(estimate_profile(decoding, predicates, "a test")))
    profile = read_profile(path)
    assert profile.clean_pictures == pytest.approx(0.6)
    assert [(f.sort, f.false_positives, f.false_negatives) for f in profile.facts] == [
        ("attribute", 20, 2),
        ("relation", 20, 2),
    ]
    assert profile.other.false_positive == pytest.approx(0.1)
