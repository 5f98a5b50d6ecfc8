"""Chains: which pictures follow each other, and by what."""

from __future__ import annotations

from notebook import Notebook, make_domain

from skillwrapper.perception.decoding.chains import Step, StepKind, chains_of
from skillwrapper.symbols import Predicate

HELD = Predicate("held", ("item",))


def _book(*, failures_change_nothing: bool = True) -> Notebook:
    domain = make_domain(
        types={"robot": (), "item": ()},
        objects={"r": "robot", "a": "item", "b": "item"},
        skills={"Take": "robot item"},
        failures_change_nothing=failures_change_nothing,
    )
    return Notebook(domain, HELD)


def _edges(book: Notebook) -> list[tuple[int, int, Step]]:
    (chain,) = chains_of(book.recorded)
    columns = (chain.before.tolist(), chain.after.tolist(), chain.which.tolist())
    return [(b, a, chain.steps[w]) for b, a, w in zip(*columns, strict=True)]


TAKE = Step(StepKind.SUCCESS, "Take", ("r", "a"))


def test_successes_are_edges_and_each_is_one_however_often_it_was_run() -> None:
    book = _book()
    book.success("", "Take(r, a)", "held(a)")
    book.success("", "Take(r, a)", "held(a)")
    assert _edges(book) == [(0, 1, TAKE)]


def test_failures_are_edges_only_where_they_may_change_something() -> None:
    for known in (True, False):
        book = _book(failures_change_nothing=known)
        book.failure("", "Take(r, a)", "held(b)")
        failure = Step(StepKind.FAILURE, "Take", ("r", "a"))
        assert _edges(book) == ([] if known else [(0, 1, failure)])


def test_resets_lead_from_the_first_start_to_the_others() -> None:
    book = _book()
    for number in range(3):
        book.success(f"#{number}", "Take(r, a)", f"held(a) #{number}")
    resets = [(b, a) for b, a, step in _edges(book) if step.kind is StepKind.RESET]
    assert resets == [(0, 2), (0, 4)]


def test_an_episode_in_parts_has_one_start() -> None:
    book = _book()
    book.success("", "Take(r, a)", "held(a)")
    book.success("held(a)", "Take(r, b)", "held(a) held(b)")
    assert all(step.kind is StepKind.SUCCESS for _, _, step in _edges(book))


def test_another_picture_after_a_failure_shows_the_same_state() -> None:
    book = _book()
    book.episode(("", "Take(r, a)", False, "#2"), ("#2", "Take(r, b)", True, "held(b)"))
    assert (0, 1, Step(StepKind.SAME)) in _edges(book)


def test_scenes_have_chains_of_their_own() -> None:
    book = _book()
    book.episode(("", "Take(r, a)", True, "held(a)"), scene=("r", "a"))
    book.episode(("", "Take(r, b)", True, "held(b)"))
    assert [chain.nodes for chain in chains_of(book.recorded)] == [2, 2]
