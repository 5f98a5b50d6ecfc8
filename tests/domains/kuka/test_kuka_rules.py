"""The abstract semantics, by enumeration; nothing here needs MuJoCo."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.states import KukaState
from skillwrapper.errors import ConfigurationError
from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.state_readers import AtomReader
from skillwrapper.evaluation.exact.verification import verify
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of
from skillwrapper.world.skills import parse_skill_instance


class Sketched(KukaEnvironment):
    """States as pictures of one pixel, which nobody reads here."""

    def draw(self, state: KukaState, layout: int) -> Picture:
        return picture_of(np.full((1, 1, 3), hash(str(state)) % 256, np.uint8))


def allowed_states() -> list[KukaState]:
    """All that the class does not refuse."""
    found = []
    values = ((False, True), (False, True), ("holder", "hand", "table"))
    for held, opened, knife in itertools.product(*values):
        for blade in ("clean", "coated", "used"):
            try:
                found.append(KukaState(held, opened, knife, blade))  # type: ignore[arg-type]
            except ConfigurationError:
                continue
    return found


def test_exactly_the_states_that_are_not_refused_are_reachable() -> None:
    """But for those in which forces made an open jar slip out of the hand."""
    reached = KukaEnvironment().reachable_states()
    slipped = {state for state in allowed_states() if state.opened and not state.jar_held}
    assert len(reached) == 13
    assert set(reached) == set(allowed_states()) - slipped


@pytest.mark.parametrize(
    ("skill", "state", "obstacle"),
    [
        ("LeftArmPick(robot, jar)", KukaState(), None),
        ("LeftArmPick(robot, jar)", KukaState(jar_held=True), "left hand is full"),
        ("RightArmPick(robot, knife)", KukaState(), None),
        ("RightArmPick(robot, knife)", KukaState(knife="hand"), "right hand is full"),
        ("RightArmPick(robot, knife)", KukaState(knife="table"), "lies flat"),
        ("Open(robot, jar)", KukaState(jar_held=True), None),
        ("Open(robot, jar)", KukaState(), "does not hold the jar"),
        ("Open(robot, jar)", KukaState(True, True), "open already"),
        ("Open(robot, jar)", KukaState(True, knife="hand"), "right hand is full"),
        ("Scoop(robot, knife, jar)", KukaState(True, True, "hand"), None),
        ("Scoop(robot, knife, jar)", KukaState(True, False, "hand"), "jar is closed"),
        ("Scoop(robot, knife, jar)", KukaState(knife="hand"), "does not hold the jar"),
        ("Scoop(robot, knife, jar)", KukaState(True, True), "does not hold the knife"),
        ("Scoop(robot, knife, jar)", KukaState(True, True, "hand", "used"), "already"),
        ("Spread(robot, knife, bread)", KukaState(True, True, "hand", "coated"), None),
        ("Spread(robot, knife, bread)", KukaState(True, True, "hand", "used"), "nothing on"),
        ("Spread(robot, knife, bread)", KukaState(True, True, "table", "coated"), "not hold"),
        ("Drop(robot, knife)", KukaState(knife="hand"), None),
        ("Drop(robot, knife)", KukaState(), "does not hold the knife"),
    ],
)
def test_when_skills_work(skill: str, state: KukaState, obstacle: str | None) -> None:
    found = KukaEnvironment().obstacle(state, parse_skill_instance(skill))
    assert (found is None) if obstacle is None else (obstacle in (found or ""))


def test_what_was_done_is_done_for_good() -> None:
    environment = KukaEnvironment()
    for state in environment.reachable_states():
        for later in environment.reachable_states(state):
            assert later.jar_held >= state.jar_held
            assert later.opened >= state.opened
            assert later.spread >= state.spread
            if state.knife == "table":
                assert later.knife == "table"


def test_states_are_written_and_read() -> None:
    environment = KukaEnvironment()
    for state in environment.reachable_states():
        assert environment.state_from_data(environment.state_to_data(state)) == state


def test_impossible_states_have_at_most_one_reason_that_search_confirms() -> None:
    environment, explain = KukaEnvironment(), find_domain("kuka").impossibility.explain
    for start, goal in itertools.product(environment.reachable_states(), repeat=2):
        if goal in environment.reachable_states(start):
            assert explain(start, goal) is None, (start, goal)


def test_expert_is_exact() -> None:
    expert = find_domain("kuka").expert
    states = LabelledStates(SceneStates(Sketched(), "table"), AtomReader(expert.atoms))
    found = verify([states], expert.model)
    assert found.precision == found.recall == found.effect_accuracy == 1.0
