"""The vocabulary: clashes of names, widened types, what is set aside (D3, D8, D9)."""

from __future__ import annotations

from dataclasses import replace

import pytest

from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.symbols import Predicate
from skillwrapper.world import TypeHierarchy

TYPES = TypeHierarchy(
    {
        "robot": (),
        "thing": (),
        "item": ("thing",),
        "cup": ("item",),
        "plate": ("item",),
        "table": ("thing",),
    }
)
CLEAN_CUP = Predicate("clean", ("cup",), "the thing is clean")
HELD = Predicate("held", ("item",))


def vocabulary(*active: Predicate) -> Vocabulary:
    return Vocabulary(TYPES, active)


def test_a_new_predicate_is_fresh() -> None:
    assert vocabulary(HELD).fresh([CLEAN_CUP]) == (CLEAN_CUP,)


def test_known_ones_are_not() -> None:
    words = vocabulary(HELD)
    asleep = Predicate("asleep", ("robot",))
    words.accept(asleep)
    words.set_dormant(asleep)
    rejected = [CLEAN_CUP]
    assert words.fresh([HELD, CLEAN_CUP, asleep], rejected) == ()
    assert words.fresh([Predicate("clean", ("cup",), "The thing is  clean.")], rejected) == ()


def test_another_meaning_is_another_predicate() -> None:
    """Else a rejected or dormant one lends its labels to whatever comes under its name."""
    ajar = Predicate("open", ("cup",), "a gap can be seen")
    wide = Predicate("open", ("cup",), "fully open")
    words = vocabulary()
    assert words.fresh([wide, ajar], rejected=[wide]) == (ajar,)
    words.accept(wide)
    words.set_dormant(wide)
    (renamed,) = words.fresh([ajar])
    assert renamed == Predicate("open_2", ("cup",), "a gap can be seen")
    words.accept(renamed)
    assert (words.active, words.dormant) == ((renamed,), (wide,))
    assert words.fresh([ajar, wide]) == ()


def test_other_words_for_the_types_are_no_other_meaning() -> None:
    known = Predicate("full", ("cup",), "The cup is full.")
    (wider,) = vocabulary(known).fresh([Predicate("full", ("plate",), "the plate is full")])
    assert wider == Predicate("full", ("item",), "The item is full.")
    (renamed,) = vocabulary(known).fresh([Predicate("full", ("plate",), "No room is left on it.")])
    assert renamed == Predicate("full_plate", ("plate",), "No room is left on it.")


def test_one_of_several_with_the_same_name() -> None:
    words = vocabulary()
    assert words.fresh([CLEAN_CUP, CLEAN_CUP, HELD]) == (CLEAN_CUP, HELD)


def test_another_type_widens_the_known_one() -> None:
    """D3: to the most specific type that covers both; the meaning is the known one's."""
    words = vocabulary(CLEAN_CUP, HELD)
    (wider,) = words.fresh([Predicate("clean", ("plate",), "The thing is clean.")])
    assert wider == Predicate("clean", ("item",), CLEAN_CUP.semantics)
    words.accept(wider)
    assert words.active == (HELD, wider)
    (widest,) = words.fresh([Predicate("clean", ("table",))])
    assert widest.types == ("thing",)


def test_a_type_that_is_covered_already_is_nothing_new() -> None:
    words = vocabulary(Predicate("clean", ("item",), CLEAN_CUP.semantics))
    assert words.fresh([CLEAN_CUP]) == ()


def test_a_dormant_one_is_widened_too() -> None:
    words = vocabulary(CLEAN_CUP)
    words.set_dormant(CLEAN_CUP)
    (wider,) = words.fresh([Predicate("clean", ("plate",))])
    assert wider.types == ("item",)
    words.accept(wider)
    assert (words.active, words.dormant) == ((wider,), ())


@pytest.mark.parametrize("types", [("robot",), ("cup", "cup"), ()])
def test_without_a_common_type_it_is_renamed(types: tuple[str, ...]) -> None:
    words = vocabulary(CLEAN_CUP)
    (renamed,) = words.fresh([Predicate("clean", types, "new")])
    assert renamed.name != "clean"
    assert renamed.types == types
    assert renamed.semantics == "new"
    words.accept(renamed)
    assert words.active == (CLEAN_CUP, renamed)
    assert words.fresh([Predicate("clean", types)]) == ()


def test_a_new_name_may_be_taken_as_well() -> None:
    """Else accepting the one would silently replace the other."""
    taken = Predicate("clean_robot", ("cup",))
    words = vocabulary(CLEAN_CUP, taken)
    (renamed,) = words.fresh([Predicate("clean", ("robot",))])
    words.accept(renamed)
    assert words.active == (CLEAN_CUP, taken, renamed)


def test_a_candidate_replaces_one_of_its_name() -> None:
    wider = Predicate("clean", ("item",))
    assert vocabulary(CLEAN_CUP, HELD).with_candidate(wider) == (HELD, wider)


def test_the_known_words_for_other_types_are_no_other_meaning() -> None:
    known = Predicate("full", ("cup",), "The cup is full.")
    (wider,) = vocabulary(known).fresh([replace(known, types=("plate",))])
    assert wider == Predicate("full", ("item",), "The item is full.")


def test_one_of_the_same_meaning_under_another_name_is_widened() -> None:
    known = Predicate("on_shelf", ("cup", "robot"), "the cup is above the robot")
    words = vocabulary(known)
    same = Predicate("over", ("item", "robot"), "The item is above the robot.")
    wider = Predicate("on_shelf", ("item", "robot"), "the item is above the robot")
    assert words.fresh([same]) == (wider,)
    assert words.fresh([replace(same, types=("cup", "robot"), semantics=known.semantics)]) == ()


def test_what_is_rejected_is_not_fresh() -> None:
    words = vocabulary(HELD)
    assert words.fresh([CLEAN_CUP]) == (CLEAN_CUP,)
    assert words.fresh([CLEAN_CUP], rejected=[CLEAN_CUP]) == ()


def test_what_is_dropped_is_forgotten() -> None:
    other, kept = Predicate("other", ()), Predicate("kept", ())
    words = vocabulary(HELD, kept, other)
    words.set_dormant(other)
    words.drop([HELD, other])
    assert (words.active, words.dormant) == ((kept,), ())


def test_an_earlier_vocabulary_is_taken_up_again() -> None:
    other, kept = Predicate("other", ()), Predicate("kept", ())
    words = vocabulary(HELD, kept)
    words.set_dormant(HELD)
    words.accept(other)
    words.use([HELD, kept])
    assert (words.active, words.dormant) == ((HELD, kept), (other,))


def test_all_that_is_said_of_narrower_types_can_be_said_of_wider_ones() -> None:
    full = Predicate("full", ("plate",), "the plate is full")
    wider = vocabulary(CLEAN_CUP, full, HELD).wider(["item"])
    assert [(p.name, p.types) for p in wider] == [("clean", ("item",)), ("full", ("item",))]
