"""What reads differently at starts that are one state is no predicate of the state."""

from __future__ import annotations

from notebook import Notebook, make_domain, picture

from skillwrapper.invention.steadiness import Steadiness
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions

ALIKE = make_domain(types={"cup": ()}, objects={"a": "cup", "b": "cup"}, skills={"Take": "cup"},
                   resets_restore_state=True)  # fmt: skip
FULL, LEFT = Predicate("full", ("cup",)), Predicate("left", ("cup",))


def judged(*starts: str, tolerance: float = 0.0) -> tuple[Predicate, ...]:
    steadiness = Steadiness(Labeller(RecordedTransitions(ALIKE), Notebook(ALIKE)), tolerance)
    for start in starts:
        steadiness.note(ALIKE.scene(), picture(start))
    return steadiness.unsteady([FULL, LEFT])


def test_one_start_tells_nothing() -> None:
    assert judged("full(a) left(a)") == ()


def test_what_differs_is_unsteady() -> None:
    assert judged("full(a) left(a)", "full(a) left(b)") == (LEFT,)
    assert judged("full(a) left(a)", "left(a) full(a) #2") == ()


def test_unknown_labels_tell_nothing() -> None:
    assert judged("full(a) left(a)", "full(a) ?left(a)") == ()


def test_so_many_starts_may_be_misread() -> None:
    starts = ["full(a) left(a)", *(f"full(a) left(b) #{n}" for n in range(4))]
    assert judged(*starts, tolerance=0.1) == (LEFT,)
    assert judged(*starts, tolerance=0.2) == ()


def around_failures(*pairs: tuple[str, str], still: bool = False) -> tuple[Predicate, ...]:
    room = make_domain(types={"cup": ()}, objects={"a": "cup", "b": "cup"}, skills={"Take": "cup"},
                       failures_change_nothing=still)  # fmt: skip
    notebook = Notebook(room)
    for before, after in pairs:
        notebook.failure(before, "Take(b)", after)
    return Steadiness(Labeller(notebook.recorded, notebook)).unsteady([FULL, LEFT])


def test_what_changes_around_a_failure_that_changes_nothing_is_unsteady() -> None:
    assert around_failures(("full(b) left(b)", "full(b)"), still=True) == (LEFT,)


def test_what_often_changes_around_failures_elsewhere_is_unsteady() -> None:
    flickers = [(f"full(b) #{n}", f"full(b) left(a) #{n}") for n in range(3)]
    assert around_failures(*flickers) == (LEFT,)
    assert around_failures(flickers[0]) == ()


def test_what_failures_change_of_their_arguments_may_be_their_doing() -> None:
    spills = [(f"full(b) #{n}", f"left(a) #{n}") for n in range(3)]
    assert FULL not in around_failures(*spills)


class Doubting(Labeller):
    """Takes a hundredth of all readings for wrong."""

    @property
    def misread(self) -> float:
        return 0.01


def judged_in_doubt(*starts: str) -> tuple[Predicate, ...]:
    steadiness = Steadiness(Doubting(RecordedTransitions(ALIKE), Notebook(ALIKE)))
    for start in starts:
        steadiness.note(ALIKE.scene(), picture(start))
    return steadiness.unsteady([FULL, LEFT])


def test_a_predicate_that_is_often_misread_is_not_unsteady() -> None:
    """Whether one cup is full is misread in nearly half of the pictures; what is left is not."""
    starts = [f"{'full(a)' if n % 2 else ''} left(a) #{n}" for n in range(11)]
    assert judged_in_doubt(*starts) == ()


def test_what_varies_of_all_things_is_unsteady_even_in_doubt() -> None:
    sides = ("", "left(a)", "left(b)", "left(a) left(b)")
    starts = [f"full(a) {sides[n % 4]} #{n}" for n in range(12)]
    assert judged_in_doubt(*starts) == (LEFT,)
