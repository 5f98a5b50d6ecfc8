"""The expert's model is exact; what is taken from it is found missing, at the nearest place."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace

from sketched_kitchen import sketched_states

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.state_readers import AtomReader, Situation
from skillwrapper.evaluation.exact.verdicts import Verdict
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.symbols import AbstractModel, Operator, Predicate
from skillwrapper.symbols.predicates import Atom, Literal
from skillwrapper.world import Observation


def check(model: AbstractModel) -> Verification:
    return verify([LabelledStates(sketched_states(), AtomReader(expert_atoms))], model)


def holds(found: Verification) -> tuple[bool | None, bool | None, bool | None]:
    verdicts = found.verdicts
    return (verdicts.sound.known, verdicts.complete.known, verdicts.suitable.known)


def of_skills(found: Verification, figure: str) -> dict[str, float | None]:
    return {name: getattr(tally, figure) for name, tally in found.by_skill.items()}


def changed(name: str, change: Callable[[Operator], Operator]) -> AbstractModel:
    """The expert's model with one operator changed."""
    model = expert_model()
    operators = tuple(change(o) if o.name == name else o for o in model.operators)
    assert operators != model.operators
    return replace(model, operators=operators)


def test_expert_is_exact() -> None:
    found = check(expert_model())
    assert (found.states, found.pairs, found.total.successes) == (2417, 62842, 5806)
    assert found.precision == found.recall == found.effect_accuracy == 1.0
    assert of_skills(found, "recall") == dict.fromkeys(
        ("Pick", "Place", "Stack", "Cut", "Cook"), 1.0
    )
    assert found.vocabulary is not None
    assert found.vocabulary.share == 1.0
    assert holds(found) == (True, True, True)
    assert (found.undecided, found.counterexamples) == (0, ())
    assert found.seconds < 30


def test_no_model_at_all() -> None:
    """Fault 25: what is of nothing is undefined, and never 1."""
    found = check(AbstractModel(expert_model().domain, (), ()))
    assert (found.precision, found.recall, found.effect_accuracy) == (None, 0.0, None)
    assert holds(found) == (None, None, False)
    assert (found.verdicts.sound, found.verdicts.complete) == (Verdict.UNDEFINED,) * 2
    assert found.vocabulary is not None
    assert found.vocabulary.share == 0.0
    assert json.loads(json.dumps(found.to_json()))["precision"] is None


def test_predicates_without_operators() -> None:
    found = check(replace(expert_model(), operators=()))
    assert (found.precision, found.recall, found.effect_accuracy) == (None, 0.0, None)
    assert holds(found) == (None, False, False)


def test_a_poor_vocabulary_predicts_perfectly_and_is_told() -> None:
    """Fault 33: without a word for what Cook does, Cook does nothing, and rightly so."""
    model = expert_model()

    def without_cooked(operator: Operator) -> Operator:
        kept = {
            name: frozenset(x for x in getattr(operator, name) if "is_cooked" not in str(x))
            for name in ("preconditions", "add_effects", "delete_effects")
        }
        return replace(operator, **kept)

    operators = tuple(without_cooked(o) for o in model.operators)
    predicates = tuple(p for p in model.predicates if p.name != "is_cooked")
    found = check(replace(model, predicates=predicates, operators=operators))
    assert found.recall == found.effect_accuracy == 1.0
    assert found.by_skill["Cook"].effect_accuracy == 1.0
    assert found.vocabulary is not None
    assert found.vocabulary.share is not None
    assert found.vocabulary.share < 1.0
    assert [str(atom) for atom in found.vocabulary.undetermined] == ["is_cooked(patty)"]


def test_missing_skill() -> None:
    model = expert_model()
    found = check(replace(model, operators=tuple(o for o in model.operators if o.skill != "Cut")))
    assert found.precision == found.effect_accuracy == 1.0
    assert of_skills(found, "recall") == {"Pick": 1, "Place": 1, "Stack": 1, "Cut": 0, "Cook": 1}
    assert 0.98 < found.recall < 1.0
    assert holds(found) == (True, False, False)
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
    assert found.by_skill["Place"].precision < found.by_skill["Pick"].precision == 1.0
    assert holds(found) == (False, True, False)
    unsound = found.counterexamples[0]
    assert len(unsound.path) == 3
    assert unsound.reason == "applies, but fails"
    assert unsound.before == unsound.after


def test_missing_absence() -> None:
    """D5: taking "from the table" what lies on something else leaves it there, on paper."""
    found = check(changed("Pick_from_table", lambda o: replace(o, absences=frozenset())))
    assert found.precision == found.recall == 1.0
    assert found.effect_accuracy < 1.0
    assert found.by_skill["Pick"].effect_accuracy < found.by_skill["Stack"].effect_accuracy == 1.0
    assert holds(found) == (False, True, False)
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
    assert holds(found) == (False, False, True)
    assert found.counterexamples[0].path == ()
    assert found.counterexamples[0].difference == ("shiny(robot): predicted true, is false",)


def test_forgotten_effect() -> None:
    found = check(changed("Cook", lambda o: replace(o, add_effects=frozenset())))
    assert holds(found) == (False, False, False)
    assert "whether Cook(robot, patty) can follow" in found.counterexamples[-1].reason
    assert found.by_skill["Cook"].effect_accuracy == 0.0


def test_unknown_labels_are_counted_apart() -> None:
    class Unsure(AtomReader):
        def read(self, space: AtomSpace, situations: Sequence[Situation]) -> Labels:
            labels = super().read(space, situations)
            labels[:, [i for i, a in enumerate(space.atoms) if a.predicate == "hand_empty"]] = -1
            return labels

    labelled = LabelledStates(sketched_states(), Unsure(expert_atoms))
    found = verify([labelled], expert_model())
    assert found.undecided > 0
    assert found.precision == 1.0
    assert found.by_skill["Pick"].recall == 0.0


def test_json() -> None:
    model = expert_model()
    found = check(replace(model, operators=model.operators[1:]))
    data = json.loads(json.dumps(found.to_json()))
    assert {"states", "pairs", "precision", "recall", "effect_accuracy", "recall_by_skill"} < {
        *data
    }
    assert {"precision_by_skill", "sound", "complete", "suitable", "counterexamples"} < {*data}
    assert data["counterexamples"][0]["instance"] == "Cook(robot, patty)"


def test_the_layout_is_what_the_reader_gets_to_see() -> None:
    seen: list[Observation] = []

    class FewStates(BurgerEnvironment):
        def reachable_states(self, start: BurgerState | None = None) -> tuple[BurgerState, ...]:
            return (BurgerState(),)

        def successor(self, state: BurgerState, instance: object) -> tuple[bool, BurgerState]:
            return False, state

    class Watching(AtomReader):
        def read(self, space: AtomSpace, situations: Sequence[Situation]) -> Labels:
            seen.extend(situation.look() for situation in situations)
            return super().read(space, situations)

    states = SceneStates(FewStates(), layout=4)
    found = verify([LabelledStates(states, Watching(expert_atoms))], expert_model())
    assert seen == [BurgerEnvironment().reset(seed=4)]
    assert (found.states, found.total.successes, found.recall) == (1, 0, None)
