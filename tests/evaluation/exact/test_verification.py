"""The expert's model is exact; what is taken from it is found missing, at the nearest place."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.errors import InternalError
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.symbols import AbstractModel, Operator, Predicate
from skillwrapper.symbols.predicates import Atom, Literal
from skillwrapper.world import Observation, Picture


class SketchedKitchen(BurgerEnvironment):
    """Draws a state by writing it down: drawing all states in colour takes too long here."""

    def draw(self, state: BurgerState, layout: int) -> Picture:
        return Picture(repr(state).encode())


@cache
def state_of_sketch() -> dict[bytes, BurgerState]:
    return {repr(state).encode(): state for state in BurgerEnvironment().reachable_states()}


def reader(model: AbstractModel) -> Callable[[Sequence[Observation]], Labels]:
    """A labeller without error."""
    space = AtomSpace(model.predicates, model.domain.objects)

    def read(observations: Sequence[Observation]) -> Labels:
        labels = np.zeros((len(observations), len(space.atoms)), dtype=np.int8)
        for row, observation in enumerate(observations):
            state = state_of_sketch()[observation.pictures[0].png]
            true = set(expert_atoms(state)) & set(space.atoms)
            labels[row, space.columns(true)] = 1
        return labels

    return read


def check(model: AbstractModel) -> Verification:
    return verify(SketchedKitchen(), model, reader(model))


def changed(name: str, change: Callable[[Operator], Operator]) -> AbstractModel:
    """The expert's model with one operator changed."""
    model = expert_model()
    operators = tuple(change(o) if o.name == name else o for o in model.operators)
    assert operators != model.operators
    return replace(model, operators=operators)


def test_expert_is_exact() -> None:
    found = check(expert_model())
    assert (found.states, found.pairs, found.successes) == (2417, 62842, 5806)
    assert found.precision == found.recall == found.effect_accuracy == 1.0
    assert set(found.recall_by_skill.items()) == {
        (skill, 1.0) for skill in ("Pick", "Place", "Stack", "Cut", "Cook")
    }
    assert (found.sound, found.complete, found.suitable) == (True, True, True)
    assert (found.undecided, found.counterexamples) == (0, ())
    assert found.seconds < 30


def test_no_model_at_all() -> None:
    found = check(AbstractModel(expert_model().domain, (), ()))
    assert (found.precision, found.recall, found.effect_accuracy) == (1.0, 0.0, 1.0)
    # Without predicates all states look the same, so the empty plan leads everywhere.
    assert (found.sound, found.complete, found.suitable) == (True, True, False)


def test_missing_skill() -> None:
    model = expert_model()
    found = check(replace(model, operators=tuple(o for o in model.operators if o.skill != "Cut")))
    assert found.precision == found.effect_accuracy == 1.0
    assert found.recall_by_skill == {"Pick": 1, "Place": 1, "Stack": 1, "Cut": 0, "Cook": 1}
    assert 0.98 < found.recall < 1.0
    assert (found.sound, found.complete, found.suitable) == (True, False, False)
    incomplete, unsuitable = found.counterexamples
    assert incomplete.verdict == "complete"
    assert [str(i) for i in incomplete.path] == [
        "Pick(robot, lettuce)",
        "Place(robot, lettuce, board)",
    ]
    assert str(incomplete.instance) == "Cut(robot, lettuce)"
    assert (unsuitable.instance, unsuitable.path) == (incomplete.instance, incomplete.path)
    assert "no operator applies" in unsuitable.reason


def test_missing_precondition() -> None:
    free = Literal(Atom("station_free", ("?station",)))
    found = check(changed("Place", lambda o: replace(o, preconditions=o.preconditions - {free})))
    assert found.recall == found.effect_accuracy == 1.0
    assert found.precision < 1.0
    assert found.precision_by_skill["Place"] < found.precision_by_skill["Pick"] == 1.0
    assert (found.sound, found.complete, found.suitable) == (False, True, False)
    unsound = found.counterexamples[0]
    assert len(unsound.path) == 3
    assert unsound.reason == "applies, but fails"
    assert unsound.before == unsound.after


def test_missing_absence() -> None:
    """D5: taking "from the table" what lies on something else leaves it there, on paper."""
    found = check(changed("Pick_from_table", lambda o: replace(o, absences=frozenset())))
    assert found.precision == found.recall == 1.0
    assert found.effect_accuracy < 1.0
    assert found.effect_accuracy_by_skill["Pick"] < found.effect_accuracy_by_skill["Stack"] == 1.0
    assert (found.sound, found.complete, found.suitable) == (False, True, False)
    unsound = found.counterexamples[0]
    assert len(unsound.path) == 2
    assert unsound.instance.skill == "Pick"
    assert any(": predicted true, is false" in line for line in unsound.difference)


def test_wrong_effect_that_nothing_depends_on() -> None:
    shiny = Predicate("shiny", ("robot",))
    model = changed(
        "Pick_from_table",
        lambda o: replace(o, add_effects=o.add_effects | {Atom("shiny", ("?robot",))}),
    )
    found = check(replace(model, predicates=(*model.predicates, shiny)))
    assert (found.sound, found.complete, found.suitable) == (False, False, True)
    assert found.counterexamples[0].path == ()
    assert found.counterexamples[0].difference == ("shiny(robot): predicted true, is false",)


def test_forgotten_effect() -> None:
    found = check(changed("Cook", lambda o: replace(o, add_effects=frozenset())))
    assert (found.sound, found.complete, found.suitable) == (False, False, False)
    assert "whether Cook(robot, patty) can follow" in found.counterexamples[-1].reason
    assert found.effect_accuracy_by_skill["Cook"] == 0.0


def test_unknown_labels_are_counted_apart() -> None:
    model = expert_model()

    def read(observations: Sequence[Observation]) -> Labels:
        labels = reader(model)(observations)
        labels[:, 0] = -1  # the hand
        return labels

    found = verify(SketchedKitchen(), model, read)
    assert found.undecided > 0
    assert found.precision == 1.0
    assert found.recall_by_skill["Pick"] == 0.0


def test_labels_of_the_wrong_shape() -> None:
    with pytest.raises(InternalError, match=r"expected labels of shape \(2417, 33\), got \(1, 2\)"):
        verify(SketchedKitchen(), expert_model(), lambda _: np.zeros((1, 2), dtype=np.int8))


def test_json_and_pictures(tmp_path: Path) -> None:
    model = expert_model()
    found = check(replace(model, operators=model.operators[1:]))
    data = json.loads(json.dumps(found.to_json()))
    assert {"states", "pairs", "precision", "recall", "effect_accuracy", "recall_by_skill"} < {
        *data
    }
    assert {"precision_by_skill", "sound", "complete", "suitable", "counterexamples"} < {*data}
    assert data["counterexamples"][0]["instance"] == "Cook(robot, patty)"
    written = found.counterexamples[0].save_pictures(tmp_path / "counterexamples")
    assert [p.name for p in written] == ["complete-before-main.png", "complete-after-main.png"]
    assert all(p.read_bytes() for p in written)


def test_real_pictures_of_some_states() -> None:
    """The seed's layout is what the labeller gets to see."""
    seen: list[Observation] = []

    class FewStates(BurgerEnvironment):
        def reachable_states(self, start: BurgerState | None = None) -> tuple[BurgerState, ...]:
            return (BurgerState(),)

        def successor(self, state: BurgerState, instance: object) -> tuple[bool, BurgerState]:
            return False, state

    def read(observations: Sequence[Observation]) -> Labels:
        seen.extend(observations)
        return np.zeros((1, 33), dtype=np.int8)

    found = verify(FewStates(), expert_model(), read, seed=4)
    assert seen == [BurgerEnvironment().reset(seed=4)]
    assert (found.states, found.successes) == (1, 0)
