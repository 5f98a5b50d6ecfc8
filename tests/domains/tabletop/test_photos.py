from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from simulated_arms import one_arm, why_no_pictures

from skillwrapper.domains.tabletop.photos import Photographer
from skillwrapper.domains.tabletop.poses import Pose


def test_pictures_show_the_present_from_any_thread() -> None:
    if why_no_pictures():
        pytest.skip(why_no_pictures())
    world, photographer = one_arm(), Photographer(160, 120)
    without = photographer.take(world, "front")
    world.put("block", Pose.at(0.5, 0.0, 0.02))
    with ThreadPoolExecutor(1) as other:
        block = other.submit(photographer.take, world, "front").result()
    assert block.shape == (120, 160, 3)
    assert np.array_equal(block, photographer.take(world, "front"))
    changed = np.abs(block.astype(int) - without).max(axis=2) > 60
    assert 5 < changed.sum() < 400
