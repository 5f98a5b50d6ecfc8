"""What a reading is worth: rates of predicates, dirty pictures, and things that look alike."""

from __future__ import annotations

import numpy as np
from garden import GARDEN, OPEN

from skillwrapper.grounding import UNKNOWN, AtomSpace
from skillwrapper.perception.decoding.readings import ErrorRates
from skillwrapper.perception.reading_model import KnownErrors, ReadingModel
from skillwrapper.symbols import Predicate
from skillwrapper.world import Object

LOCKED = Predicate("locked", ("door",))
SPACE = AtomSpace((OPEN, LOCKED), GARDEN.objects)
TWO_TYPES = (Object("left", ("door",)), Object("right", ("door", "gate")))


def labels(*values: int) -> np.ndarray:
    """Of open(left), open(right), locked(left), locked(right)."""
    return np.array(values, dtype=np.int8)


def nats(model: ReadingModel, true: tuple[int, ...], read: tuple[int, ...]) -> float:
    return float(model.log_likelihood(labels(*true)[np.newaxis], labels(*read))[0])


def test_probabilities_of_all_readings_add_up_to_one() -> None:
    model = ReadingModel.of(SPACE)
    every = np.indices((2, 2, 2, 2)).reshape(4, -1).T
    total = sum(np.exp(nats(model, (1, 0, 0, 1), tuple(read))) for read in every)
    assert np.isclose(total, 1.0)


def test_a_predicate_that_is_often_misread_is_believed_less() -> None:
    known = KnownErrors({"locked": ErrorRates(0.3, 0.3, 50, 50)})
    model, fresh = ReadingModel.of(SPACE, known=known), ReadingModel.of(SPACE)
    misread = (0, 0, 0, 0), (0, 0, 1, 0)
    assert nats(model, *misread) > nats(fresh, *misread)


def test_a_second_error_is_likelier_than_the_first() -> None:
    model = ReadingModel.of(AtomSpace((OPEN, LOCKED), TWO_TYPES))
    none, one, two = (nats(model, (0, 0, 0, 0), r) for r in ((0,) * 4, (1, 0, 0, 0), (1, 0, 1, 0)))
    assert none - one > one - two


def test_things_of_the_same_types_may_be_taken_for_each_other() -> None:
    """Both atoms of a door are then read of the other one: that is one error, not four."""
    alike = ReadingModel.of(SPACE)
    different = ReadingModel.of(AtomSpace((OPEN, LOCKED), TWO_TYPES))
    exchanged = (1, 0, 1, 0), (0, 1, 0, 1)
    assert nats(alike, *exchanged) > nats(different, *exchanged) + 1.0


def test_what_is_unknown_tells_nothing() -> None:
    model = ReadingModel.of(SPACE)
    states = np.array([[0, 0, 0, 0], [1, 1, 1, 1]], dtype=np.int8)
    found = model.log_likelihood(states, labels(*[UNKNOWN] * 4))
    assert np.allclose(found, 0.0)
