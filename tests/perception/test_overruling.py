"""Which readings decoding overrules, and how often it is right."""

from __future__ import annotations

import numpy as np
from misread_kitchen import VOCABULARY, MisreadKitchen

from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.overruling import certify_decoding, check_overruling


class _Truth:
    def __init__(self, kitchen: MisreadKitchen) -> None:
        self.prefetch, self.labels = kitchen.prefetch, kitchen.truth


def _labeller(kitchen: MisreadKitchen) -> DecodedLabeller:
    return DecodedLabeller(kitchen.recorded, kitchen, lambda: VOCABULARY)


def test_every_overruled_reading_is_told_with_its_picture() -> None:
    kitchen = MisreadKitchen(150, seed=1, rate=0.05)
    labeller = _labeller(kitchen)
    found = certify_decoding(labeller, sure=0.9)
    (scene,) = kitchen.recorded.scenes
    space = AtomSpace(VOCABULARY, scene.objects)
    for one in found.overruled:
        read = kitchen.labels(space, [one.observation])[0, space.column[one.atom]]
        assert one.read == bool(read)
        assert (one.posterior > 0.5) != one.read
    seen = kitchen.recorded.observations(scene)
    assert found.readings == len(seen) * len(space.atoms)
    changed = labeller.readings(scene, VOCABULARY) != labeller.values(scene, VOCABULARY)
    assert len(found.overruled) == np.count_nonzero(changed)
    assert found.rates.keys() == set(VOCABULARY)


def test_most_of_what_is_overruled_was_misread() -> None:
    kitchen = MisreadKitchen(300, seed=2, rate=0.04)
    check = check_overruling(_labeller(kitchen), _Truth(kitchen))
    assert check.misread > 100
    assert check.right > 0.95 * check.misread
    assert check.right > 0.95 * check.overruled


def test_nothing_is_overruled_where_nothing_is_misread() -> None:
    kitchen = MisreadKitchen(150, seed=3)
    found = certify_decoding(_labeller(kitchen), sure=0.9)
    assert found.overruled == ()
    assert found.dirty < 0.1
    assert check_overruling(_labeller(kitchen), _Truth(kitchen)).overruled == 0
