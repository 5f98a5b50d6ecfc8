"""The shipped problems are what they say, proven by searching all states."""

from __future__ import annotations

from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.impossibility import impossibility
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.evaluation.problems.problem_files import read_problems, write_problems
from skillwrapper.evaluation.problems.problem_generator import ProblemGenerator
from skillwrapper.evaluation.problems.problems import (
    Problem,
    ProblemClass,
    ProblemSet,
)

EASY, HARD, IMPOSSIBLE = ProblemClass


@cache
def shipped() -> ProblemSet:
    return read_problems(find_domain("burger").problems, BurgerEnvironment())


@cache
def space() -> StateSpace:
    return StateSpace.of(BurgerEnvironment())


def number_of(state: BurgerState) -> int:
    return space().states.index(state)


def states(problem: Problem) -> tuple[BurgerState, BurgerState]:
    kitchen = BurgerEnvironment()
    return kitchen.state_from_data(problem.initial), kitchen.state_from_data(problem.goal)


@pytest.mark.parametrize("problem", shipped().problems, ids=lambda p: p.name)
def test_length_or_impossibility_by_exhaustion(problem: Problem) -> None:
    start, goal = states(problem)
    distance = int(space().distances_from(number_of(start))[number_of(goal)])
    if problem.kind is IMPOSSIBLE:
        assert distance == -1
        assert goal not in BurgerEnvironment().reachable_states(start)
        found = impossibility(start, goal)
        assert found is not None
        assert found[1] == problem.reason
    else:
        assert distance == problem.length
        assert distance in (range(1, 8) if problem.kind is EASY else range(8, 16))


def test_shipped_set_is_spread() -> None:
    problems = shipped()
    assert [len(problems.of(kind)) for kind in ProblemClass] == [20, 20, 10]
    for kind, lengths in ((EASY, range(1, 8)), (HARD, range(8, 16))):
        counts = Counter(p.length for p in problems.of(kind))
        assert set(counts) == set(lengths)
        assert max(counts.values()) <= 3
    reference = find_domain("burger")
    built = Counter(reference.structure(states(p)[1]) for p in problems.problems)
    assert len(built) >= 30
    assert len({p.layout for p in problems.problems}) == 50
    kinds = Counter((impossibility(*states(p)) or ("",))[0] for p in problems.of(IMPOSSIBLE))
    assert set(kinds) == set(reference.impossibility.kinds)


def test_same_seed_makes_the_same_problems(tmp_path: Path) -> None:
    kitchen, reference = BurgerEnvironment(), find_domain("burger")
    first = ProblemGenerator(kitchen, reference, seed=5).generate(3, 3, 6)
    again = ProblemGenerator(kitchen, reference, seed=5).generate(3, 3, 6)
    other = ProblemGenerator(kitchen, reference, seed=6).generate(3, 3, 6)
    assert first == again != other
    write_problems(first, tmp_path / "problems.yaml")
    assert read_problems(tmp_path / "problems.yaml", kitchen) == first


def test_shipped_set_was_made_by_the_generator() -> None:
    generator = ProblemGenerator(BurgerEnvironment(), find_domain("burger"), shipped().seed)
    assert generator.generate(20, 20, 10) == shipped()


def test_first_problems_of_each_class() -> None:
    chosen = shipped().first(2, 0, 1)
    assert [p.name for p in chosen.problems] == ["easy-01", "easy-02", "impossible-01"]


def test_more_problems_than_there_are() -> None:
    generator = ProblemGenerator(BurgerEnvironment(), find_domain("burger"), 0)
    with pytest.raises(ConfigurationError, match="found no more optimal solutions of 99 skills"):
        generator._draw(
            lambda start: generator._at_distance(99, start),
            "optimal solutions of 99 skills",
            standard=True,
        )


def test_no_reason_where_several_or_none_are_known() -> None:
    start = BurgerState(("board", "table", "table", "table"), cut=True)
    assert impossibility(start, start) is None
    assert impossibility(start, BurgerState()) is None


MISTAKES = (
    ("class: easy", "class: medium", r":5: 'problems\.0\.class': expected 'easy'"),
    ("length: 1", "lenght: 1", r":6: unknown key 'problems\.0\.lenght'"),
    ("class: easy", "class: impossible", "expected a reason and no length for a problem of"),
    ("domain: burger", "domain: panda", r":1: expected problems of burger, got problems of panda"),
    ("cut: false", "cut: 3", r":8: expected true or false for cut and cooked; got 3"),
)


@pytest.mark.parametrize(("old", "new", "message"), MISTAKES)
def test_mistakes_in_a_file(tmp_path: Path, old: str, new: str, message: str) -> None:
    path = tmp_path / "problems.yaml"
    write_problems(shipped().first(1, 0, 0), path)
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(ConfigurationError, match=message) as caught:
        read_problems(path, BurgerEnvironment())
    assert str(path) in str(caught.value)


def test_names_are_unique(tmp_path: Path) -> None:
    one = shipped().problems[0]
    write_problems(ProblemSet("burger", 0, (one, one)), tmp_path / "twice.yaml")
    with pytest.raises(ConfigurationError, match="expected different names, got 'easy-01' twice"):
        read_problems(tmp_path / "twice.yaml", BurgerEnvironment())


def test_domain_without_a_reference() -> None:
    with pytest.raises(UnknownNameError, match="did you mean 'burger'"):
        find_domain("burgers")
