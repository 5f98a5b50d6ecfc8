"""The data set: scenes, time, and labels that may be copied (D11)."""

from __future__ import annotations

from notebook import Notebook, make_domain

from skillwrapper.symbols import Predicate
from skillwrapper.transitions.dataset import Reading

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
    assert book.dataset.numbers_of("Wave") == (2,)
    assert len(book.dataset) == 4


def test_a_picture_is_one_observation_however_often_it_is_seen() -> None:
    book = notebook()
    book.episode(("", "Take(r, a)", True, "held(a)"), ("held(a)", "Take(r, a)", False, "held(a)"))
    (scene,) = book.dataset.scenes
    assert len(book.dataset.observations(scene)) == 2


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
    (scene,) = book.dataset.scenes
    assert len(book.dataset.observations(scene)) == 2


def test_what_is_unchanged_is_told_by_the_pictures() -> None:
    book = notebook()
    book.success("#1", "Take(r, a)", "#2")
    book.success("#1", "Take(r, a)", "#1")
    (table,) = book.data("Take")
    assert table.unchanged.tolist() == [False, True]


def test_changes_of_unknown_labels_are_undetermined() -> None:
    book = notebook()
    book.success("?held(a)", "Take(r, a)", "held(a) held(b)")
    (table,) = book.data("Take")
    assert table.change.tolist() == [[0, 1]]
    assert table.undetermined.tolist() == [[True, False]]


def test_labels_are_read_once_and_then_kept() -> None:
    book = notebook()
    book.success("", "Take(r, a)", "held(a)")
    reading = Reading(book.dataset, book)
    (scene,) = book.dataset.scenes
    assert reading.labels(scene, [HELD, SUNNY]).tolist() == [[0, 0, 0], [1, 0, 0]]
    assert reading.labels(scene, [SUNNY, HELD]).tolist() == [[0, 0, 0], [0, 1, 0]]
    assert reading.skill_data("Take", [HELD])[0].after.tolist() == [[1, 0]]
    assert book.asked == [("held sunny", 2)]


def test_new_pictures_are_read_when_they_are_asked_for() -> None:
    book = notebook()
    book.success("", "Take(r, a)", "held(a)")
    reading = Reading(book.dataset, book)
    (scene,) = book.dataset.scenes
    reading.labels(scene, [HELD])
    book.success("sunny()", "Take(r, b)", "held(b)")
    assert reading.labels(scene, [HELD]).shape == (4, 2)
    reading.labels(scene, [HELD, SUNNY])
    assert book.asked == [("held", 2), ("held", 4), ("sunny", 4)]
    assert reading.labels(scene, []).shape == (4, 0)


def test_tables_remember_liftings_together() -> None:
    book = notebook()
    for _ in range(2):
        book.success("", "Take(r, a)", "held(a)")
    reading = Reading(book.dataset, book)
    (first,), (second,) = (reading.skill_data("Take", [HELD]) for _ in range(2))
    assert first.successes[0].lifting is second.successes[0].lifting
