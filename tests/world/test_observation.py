from __future__ import annotations

import pytest

from skillwrapper.errors import UnknownNameError
from skillwrapper.world import Observation, Picture


def test_key_tells_pictures_and_cameras_apart() -> None:
    one, two = b"one picture", b"another"
    front, side = Picture(one, "front"), Picture(two, "side")
    assert Observation((Picture(one),)).key == Picture(one).sha256
    keys = {
        Observation(pictures).key
        for pictures in ((front,), (side,), (front, side), (Picture(two, "front"), side))
    }
    assert len(keys) == 4
    assert Observation((front, side)).key == Observation((front, side)).key


def test_pictures_are_found_by_their_cameras() -> None:
    front, side = Picture(b"one picture", "front"), Picture(b"another", "side")
    seen = Observation((front, side))
    assert seen.picture() == front
    assert seen.picture("side") == side
    with pytest.raises(UnknownNameError, match="unknown camera 'sight'; known: front, side"):
        seen.picture("sight")
