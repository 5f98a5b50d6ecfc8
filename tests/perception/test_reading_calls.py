"""Calls that reading pictures takes, and would take if nothing were remembered."""

from __future__ import annotations

from collections.abc import Sequence

from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.perception.reading_calls import ReadingCalls
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.symbols import Predicate, all_groundings
from skillwrapper.world import Domain, Object, Observation, Picture, TypeHierarchy

CUPS = tuple(Object(name, ("cup",)) for name in ("red", "blue", "green"))
DOMAIN = Domain("cups", "A hand.", "Cups.", TypeHierarchy({"cup": ()}), CUPS, ())
FULL = Predicate("full", ("cup",))
NEAR = Predicate("near", ("cup", "cup"))


class Reader:
    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        return [
            EvaluationAnswer(dict.fromkeys(all_groundings(q.predicates, q.objects), True))
            for q in questions
        ]


def pictures(count: int) -> list[Observation]:
    return [Observation((Picture(bytes([number])),)) for number in range(count)]


def test_a_batch_a_vote_and_a_picture_is_a_call() -> None:
    truth = TruthTable(DOMAIN, Reader())
    calls = ReadingCalls(truth, batch_size=4, votes=3)
    assert (calls.needed, calls.reasking) == (0, 0)
    truth.labels(AtomSpace((FULL,), CUPS), pictures(2))
    assert calls.needed == 2 * 3
    truth.labels(AtomSpace((FULL, NEAR), CUPS), pictures(3))
    assert calls.needed == 2 * 3 + (2 * 2 + 1 * 3) * 3


def test_asking_everything_again_counts_all_predicates_and_pictures() -> None:
    calls = ReadingCalls(TruthTable(DOMAIN, Reader()), batch_size=4, votes=1)
    calls.count_invention([(AtomSpace((FULL,), CUPS), pictures(2))])
    assert calls.reasking == 2
    everything = AtomSpace((FULL, NEAR), CUPS)
    calls.count_invention([(everything, pictures(5)), (AtomSpace((FULL,), CUPS), pictures(1))])
    assert calls.reasking == 2 + 5 * 3 + 1
    assert calls.needed == 0


def test_new_pictures_are_counted_once() -> None:
    calls = ReadingCalls(TruthTable(DOMAIN, Reader()), batch_size=4, votes=1)
    everything = AtomSpace((FULL, NEAR), CUPS)
    calls.count_arrival([(AtomSpace((FULL,), CUPS), pictures(2))])
    assert calls.reasking == 2
    calls.count_arrival([(everything, pictures(5)), (AtomSpace((FULL,), CUPS[:2]), pictures(1))])
    assert calls.reasking == 2 + 3 * 3 + 1
