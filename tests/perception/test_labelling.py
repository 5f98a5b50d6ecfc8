"""From pictures to arrays: scenes, time, and labels that may be copied (D11)."""

from __future__ import annotations

import pytest
from notebook import Notebook, instance, make_domain, picture

from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.world import Episode, Transition

HELD = Predicate("held", ("item",))
SUNNY = Predicate("sunny", ())


def notebook(*, failures_change_nothing: bool = False) -> Notebook:
    domain = make_domain(
        types={"robot": (), "item": ()},
        objects={"r": "robot", "a": "item", "b": "item"},
        skills={"Take": "robot item", "Wave": "robot"},
        failures_change_nothing=failures_change_nothing,
    )
    return Notebook(domain, HELD)


def test_one_table_a_scene() -> None:
    book = notebook()
    book.episode(("", "Take(r, a)", True, "held(a)"), scene=("r", "a"))
    book.episode(("", "Take(r, b)", True, "held(b)"), ("held(b)", "Wave(r)", True, "held(b)"))
    book.episode(("", "Take(r, a)", True, "held(a)"), scene=("r", "a"))
    small, large = book.data("Take")
    assert [o.name for o in small.space.objects] == ["r", "a"]
    assert [o.name for o in large.space.objects] == ["r", "a", "b"]
    assert small.ids.tolist() == [0, 3]
    assert large.ids.tolist() == [1]
    assert [t.ids.tolist() for t in book.data("Wave")] == [[2]]
    assert len(book.recorded) == 4


def test_a_picture_is_one_observation_however_often_it_is_seen() -> None:
    book = notebook()
    book.episode(("", "Take(r, a)", True, "held(a)"), ("held(a)", "Take(r, a)", False, "held(a)"))
    (scene,) = book.recorded.scenes
    assert len(book.recorded.observations(scene)) == 2


def test_labels_of_failures_are_read() -> None:
    book = notebook()
    book.failure("", "Take(r, a)", "held(a)")
    (table,) = book.data("Take")
    assert table.after.any()


def test_they_are_copied_only_if_the_domain_says_so() -> None:
    """D11: noise in the picture after a failure is not taken for a change."""
    book = notebook(failures_change_nothing=True)
    book.failure("", "Take(r, a)", "held(a)")
    book.success("", "Take(r, a)", "held(a) #2")
    (table,) = book.data("Take")
    assert not table.change[0].any()
    assert table.change[1].any()
    (scene,) = book.recorded.scenes
    assert len(book.recorded.observations(scene)) == 2


@pytest.mark.parametrize("declared", [True, False])
def test_the_robot_knows_best_whether_anything_changed(*, declared: bool) -> None:
    """What it says stands above what the domain declares of failures."""
    book = notebook(failures_change_nothing=declared)
    seen = [picture(state) for state in ("", "held(a)", "held(b)")]
    wave, take = instance("Wave(r)"), instance("Take(r, a)")
    steps = (
        Transition(seen[0], wave, True, seen[1], changed=False),
        Transition(seen[1], take, False, seen[2], changed=True),
        Transition(seen[2], take, False, seen[0]),
    )
    book.recorded.add(Episode(book.domain.scene(), 0, steps))
    (waved,), (taken,) = book.data("Wave"), book.data("Take")
    assert waved.unchanged.tolist() == [True]
    assert not waved.change.any()
    assert taken.unchanged.tolist() == [False, declared]
    assert taken.change.tolist() == [[-1, 1], [0, 0 if declared else -1]]


def test_equal_pictures_prove_nothing() -> None:
    """A picture too coarse to show a change is no proof that there was none."""
    book = notebook()
    book.success("#1", "Take(r, a)", "#1")
    (table,) = book.data("Take")
    assert table.unchanged.tolist() == [False]


def test_changes_of_unknown_labels_are_undetermined() -> None:
    book = notebook()
    book.success("?held(a)", "Take(r, a)", "held(a) held(b)")
    (table,) = book.data("Take")
    assert table.change.tolist() == [[0, 1]]
    assert table.undetermined.tolist() == [[True, False]]


def test_labels_are_read_once_and_then_kept() -> None:
    book = notebook()
    book.success("", "Take(r, a)", "held(a)")
    labeller = Labeller(book.recorded, book)
    (scene,) = book.recorded.scenes
    assert labeller.values(scene, [HELD, SUNNY]).tolist() == [[0, 0, 0], [1, 0, 0]]
    assert labeller.values(scene, [SUNNY, HELD]).tolist() == [[0, 0, 0], [0, 1, 0]]
    assert labeller.label([HELD]).of_skill("Take")[0].after.tolist() == [[1, 0]]
    assert book.asked == [("held sunny", 2)]


def test_new_pictures_are_read_when_they_are_asked_for() -> None:
    book = notebook()
    book.success("", "Take(r, a)", "held(a)")
    labeller = Labeller(book.recorded, book)
    (scene,) = book.recorded.scenes
    labeller.label([HELD])
    book.success("sunny()", "Take(r, b)", "held(b)")
    assert labeller.values(scene, [HELD]).shape == (4, 2)
    labeller.label([HELD, SUNNY])
    assert book.asked == [("held", 2), ("held", 4), ("sunny", 4)]
    assert labeller.values(scene, []).shape == (4, 0)


def test_what_was_labelled_stays_as_it_is() -> None:
    """Who holds labelled transitions need not fear that they grow under the hands."""
    book = notebook()
    book.success("", "Take(r, a)", "held(a)")
    labeller = Labeller(book.recorded, book)
    first = labeller.label([HELD])
    book.success("", "Take(r, b)", "held(b)")
    assert (len(first), len(labeller.label([HELD]))) == (1, 2)
    assert len(first.of_skill("Take")[0]) == 1


def test_tables_remember_liftings_together() -> None:
    book = notebook()
    for _ in range(2):
        book.success("", "Take(r, a)", "held(a)")
    transitions = Labeller(book.recorded, book).label([HELD])
    (first,), (second,) = (transitions.of_skill("Take") for _ in range(2))
    assert first.successes[0].lifting is second.successes[0].lifting
