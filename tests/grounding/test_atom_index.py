"""Looking up columns by numbers of objects finds what looking up ground atoms finds."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from skillwrapper.grounding import AtomSpace
from skillwrapper.grounding.atom_index import ANY
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.types import Object

OBJECTS = (
    Object("r", ("robot",)),
    Object("a", ("food", "thing")),
    Object("b", ("food", "hot", "thing")),
    Object("c", ("hot", "thing")),
)
SPACE = AtomSpace(
    (
        Predicate("dark", ()),
        Predicate("hot", ("hot",)),
        Predicate("on", ("thing", "food")),
        Predicate("gives", ("robot", "food", "thing")),
    ),
    OBJECTS,
)


def column(predicate: Predicate, numbers: tuple[int, ...]) -> int:
    atom = Atom(predicate.name, tuple(OBJECTS[n].name for n in numbers))
    return SPACE.column.get(atom, -1)


@pytest.mark.parametrize("predicate", SPACE.predicates, ids=lambda p: p.name)
def test_every_tuple_of_objects(predicate: Predicate) -> None:
    bindings = list(itertools.product(range(len(OBJECTS)), repeat=3))
    for terms in itertools.product(range(3), repeat=predicate.arity):
        patterns = SPACE.index.patterns([(predicate.name, terms)], 3)
        found = SPACE.index.columns(patterns, np.array(bindings))[:, 0]
        wanted = [column(predicate, tuple(binding[t] for t in terms)) for binding in bindings]
        assert found.tolist() == wanted


@pytest.mark.parametrize("place", range(3))
def test_a_quantified_object_is_every_object_in_turn(place: int) -> None:
    predicate = SPACE.predicates[3]
    terms = [0, 1]
    terms.insert(place, ANY)
    patterns = SPACE.index.patterns([("dark", ()), (predicate.name, tuple(terms))], 2)
    bindings = list(itertools.product(range(len(OBJECTS)), repeat=2))
    found = SPACE.index.open_columns(patterns, np.array(bindings))
    for row, binding in enumerate(bindings):
        for number in range(len(OBJECTS)):
            named = tuple(number if t == ANY else binding[t] for t in terms)
            assert found[row, :, number].tolist() == [0, column(predicate, named)]


def test_no_patterns_and_no_bindings() -> None:
    index = SPACE.index
    nothing = index.patterns([], 2)
    assert index.columns(nothing, np.zeros((3, 2), dtype=np.intp)).shape == (3, 0)
    assert index.open_columns(nothing, np.zeros((3, 2), dtype=np.intp)).shape == (3, 0, 4)
    dark = index.patterns([("dark", ())], 0)
    assert index.columns(dark, np.zeros((2, 0), dtype=np.intp)).tolist() == [[0], [0]]
    assert index.columns(dark, np.zeros((0, 0), dtype=np.intp)).shape == (0, 1)


def test_a_predicate_that_is_not_in_the_vocabulary() -> None:
    patterns = SPACE.index.patterns([("wet", (0,)), ("hot", (0,))], 1)
    assert SPACE.index.columns(patterns, np.array([[0], [3]])).tolist() == [[-1, -1], [-1, 2]]


def test_types() -> None:
    assert SPACE.index.of_types(["food", "hot"]).tolist() == [False, False, True, False]
    assert SPACE.index.of_types([]).all()
