"""The truth table: asks only what is missing, in one wave; what is unknown is never false."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from skillwrapper.errors import ModelUnavailableError
from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace
from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.perception.truth_table import TruthTable, encode_labels
from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.world import Domain, Object, Observation, Picture, TypeHierarchy

CUPS = tuple(Object(name, ("cup",)) for name in ("red", "blue", "green"))
DOMAIN = Domain("cups", "A hand.", "Cups.", TypeHierarchy({"cup": ()}), CUPS, ())
FULL = Predicate("full", ("cup",))
NEAR = Predicate("near", ("cup", "cup"))
DARK = Predicate("dark", ())
HOT = Predicate("hot", ("kettle",))
QUICK = settings(max_examples=60, deadline=None, derandomize=True)


def seen(name: str) -> Observation:
    return Observation((Picture(name.encode()),))


class Reader:
    """Reads pictures whose bytes list what is true; remembers every wave of questions."""

    def __init__(self, unsure: Sequence[Atom] = ()) -> None:
        self.waves: list[list[EvaluationQuestion]] = []
        self.unsure = unsure
        self.broken = False

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        if self.broken:
            raise ModelUnavailableError("no answer")
        self.waves.append(list(questions))
        return [EvaluationAnswer(self._read(q)) for q in questions]

    def _read(self, question: EvaluationQuestion) -> Mapping[Atom, bool | None]:
        text = question.observation.pictures[0].png.decode()
        atoms = all_groundings(question.predicates, question.objects)
        return {a: None if a in self.unsure else str(a) in text for a in atoms}


def asked(wave: list[EvaluationQuestion]) -> list[tuple[str, list[str]]]:
    return [(q.observation.pictures[0].png.decode(), [p.name for p in q.predicates]) for q in wave]


def table(**reader: Sequence[Atom]) -> tuple[TruthTable, Reader]:
    evaluator = Reader(**reader)
    return TruthTable(DOMAIN, evaluator), evaluator


def test_labels_stand_in_the_columns_of_the_space() -> None:
    truth, _ = table()
    space = AtomSpace((DARK, FULL, NEAR), CUPS)
    labels = truth.labels(space, [seen("full(blue)"), seen("dark() near(green, red)")])
    assert labels.dtype == np.int8
    assert [space.true_atoms(row) for row in labels] == [
        {Atom("full", ("blue",))},
        {Atom("dark"), Atom("near", ("green", "red"))},
    ]


def test_a_question_a_picture_about_all_that_is_missing_in_one_wave() -> None:
    truth, reader = table()
    truth.labels(AtomSpace((FULL, DARK), CUPS), [seen("a"), seen("b")])
    assert [asked(w) for w in reader.waves] == [[("a", ["full", "dark"]), ("b", ["full", "dark"])]]


class LidReader:
    """Answers by the meaning: the lid is ajar, so a gap can be seen and it is not fully open."""

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        return [
            EvaluationAnswer(
                {
                    atom: "gap" in predicate.semantics
                    for predicate in question.predicates
                    for atom in predicate.groundings(question.objects)
                }
            )
            for question in questions
        ]


@pytest.mark.parametrize("together", [True, False])
def test_one_name_with_two_meanings_has_two_labels(*, together: bool) -> None:
    """Labels read for a rejected meaning once counted for whatever came under its name."""
    wide = Predicate("open", ("cup",), "The lid is fully open.")
    ajar = Predicate("open", ("cup",), "A gap can be seen.")
    truth = TruthTable(DOMAIN, LidReader())
    wanted = [(AtomSpace((p,), CUPS), [seen("ajar")]) for p in (wide, ajar)]
    if together:
        truth.prefetch(wanted)
    assert [truth.labels(*one).tolist() for one in wanted] == [[[0, 0, 0]], [[1, 1, 1]]]


def test_nothing_is_asked_twice() -> None:
    truth, reader = table()
    truth.labels(AtomSpace((FULL,), CUPS), [seen("a"), seen("b")])
    truth.labels(AtomSpace((FULL,), CUPS), [seen("b"), seen("a")])
    assert len(reader.waves) == 1


def test_only_what_is_missing() -> None:
    truth, reader = table()
    truth.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    truth.labels(AtomSpace((NEAR,), CUPS), [seen("b")])
    truth.labels(AtomSpace((FULL, NEAR), CUPS), [seen("a"), seen("b"), seen("c")])
    assert asked(reader.waves[2]) == [("a", ["near"]), ("b", ["full"]), ("c", ["full", "near"])]


def test_what_will_be_needed_is_asked_for_in_one_wave_and_once_a_picture() -> None:
    truth, reader = table()
    few = AtomSpace((FULL,), CUPS[:1])
    truth.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    truth.prefetch(
        [
            (AtomSpace((FULL, DARK), CUPS), [seen("a"), seen("b")]),
            (AtomSpace((NEAR, DARK), CUPS), [seen("b"), seen("c")]),
            (few, [seen("a")]),
        ]
    )
    assert asked(reader.waves[1]) == [
        ("a", ["dark"]),
        ("b", ["full", "dark", "near"]),
        ("c", ["near", "dark"]),
        ("a", ["full"]),
    ]
    truth.prefetch([(few, [seen("a")])])
    truth.labels(AtomSpace((FULL, DARK), CUPS), [seen("a"), seen("b")])
    truth.labels(AtomSpace((NEAR, DARK), CUPS), [seen("b"), seen("c")])
    assert len(reader.waves) == 2
    assert truth.question_sizes == {3: 1, 1: 2, 3 + 1 + 6: 1, 6 + 1: 1}


def test_what_was_fetched_before_is_what_would_have_been_asked() -> None:
    pictures = [seen("full(blue)"), seen("dark() near(green, red)")]
    spaces = [AtomSpace((FULL, DARK), CUPS), AtomSpace((NEAR,), CUPS)]
    (early, _), (late, _) = table(), table()
    early.prefetch((space, pictures) for space in spaces)
    for space in spaces:
        assert np.array_equal(early.labels(space, pictures), late.labels(space, pictures))


def test_agreement_is_averaged_over_all_labels_of_a_predicate() -> None:
    class Voters:
        def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
            answers = []
            for question in questions:
                atoms = all_groundings(question.predicates, question.objects)
                shares = {atom: 0.5 if atom.terms == ("blue",) else 1.0 for atom in atoms}
                answers.append(EvaluationAnswer(dict.fromkeys(atoms, True), shares))
            return answers

    truth = TruthTable(DOMAIN, Voters())
    truth.labels(AtomSpace((FULL, DARK), CUPS), [seen("a"), seen("b")])
    assert truth.agreement(FULL) == pytest.approx(2.5 / 3)
    assert truth.agreement(DARK) == 1.0
    assert truth.agreement(NEAR) is None
    silent, _ = table()
    silent.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    assert silent.agreement(FULL) is None


def test_equal_pictures_are_one() -> None:
    truth, reader = table()
    labels = truth.labels(AtomSpace((DARK,), CUPS), [seen("dark()")] * 3)
    assert len(reader.waves[0]) == 1
    assert labels.tolist() == [[TRUE]] * 3


def test_another_scene_is_another_question() -> None:
    """Which objects there are may change what is to be said of a picture."""
    truth, reader = table()
    truth.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    few = truth.labels(AtomSpace((FULL,), CUPS[:1]), [seen("a")])
    assert few.shape == (1, 1)
    assert reader.waves[1][0].objects == CUPS[:1]


def test_a_predicate_of_other_types_is_another_one() -> None:
    """D3: a widened predicate is asked for afresh."""
    truth, reader = table()
    truth.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    truth.labels(AtomSpace((Predicate("full", ("kettle",)),), CUPS), [seen("a")])
    assert len(reader.waves) == 2


def test_unknown_is_never_false() -> None:
    """D10"""
    unsure = Atom("full", ("blue",))
    truth, _ = table(unsure=[unsure])
    assert truth.labels(AtomSpace((FULL,), CUPS), [seen("full(red)")]).tolist() == [
        [TRUE, UNKNOWN, FALSE]
    ]


def test_after_an_error_all_is_asked_again() -> None:
    truth, reader = table()
    reader.broken = True
    with pytest.raises(ModelUnavailableError):
        truth.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    reader.broken = False
    truth.labels(AtomSpace((FULL,), CUPS), [seen("a")])
    assert len(reader.waves) == 1


@pytest.mark.parametrize(
    ("predicates", "pictures", "shape"),
    [((), ["a"], (1, 0)), ((FULL,), [], (0, 3)), ((HOT,), ["a", "b"], (2, 0))],
)
def test_shapes_of_nothing(predicates, pictures, shape) -> None:
    truth, _ = table()
    labels = truth.labels(AtomSpace(predicates, CUPS), [seen(p) for p in pictures])
    assert labels.shape == shape
    assert labels.dtype == np.int8


@QUICK
@given(st.dictionaries(st.integers(0, 9), st.sampled_from([True, False, None])))
def test_encoding(given_labels: dict[int, bool | None]) -> None:
    """True, false, and unknown if not told or not there at all."""
    atoms = [Atom("p", (str(n),)) for n in range(10)]
    encoded = encode_labels(atoms, {atoms[n]: label for n, label in given_labels.items()})
    assert encoded.dtype == np.int8
    for number, code in enumerate(encoded):
        label = given_labels.get(number)
        assert code == (UNKNOWN if label is None else TRUE if label else FALSE)
