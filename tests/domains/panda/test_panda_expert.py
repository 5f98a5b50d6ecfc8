"""The expert's model is exact in every state of every scene."""

from __future__ import annotations

import numpy as np
import pytest

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.states import PandaState
from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.state_readers import AtomReader
from skillwrapper.evaluation.exact.verification import verify
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of


class SketchedPanda(PandaEnvironment):
    """States as pictures of one pixel, which nobody reads here."""

    def draw(self, state: PandaState, layout: int) -> Picture:
        return picture_of(np.full((1, 1, 3), hash(str(state)) % 256, np.uint8))


@pytest.mark.parametrize("scene", ["table", "pouring", "wiping", "stacking"])
def test_expert_is_exact(scene: str) -> None:
    environment = SketchedPanda()
    expert = find_domain("panda").expert
    states = LabelledStates(SceneStates(environment, scene), AtomReader(expert.atoms))
    found = verify([states], expert.model)
    assert found.precision == found.recall == found.effect_accuracy == 1.0
