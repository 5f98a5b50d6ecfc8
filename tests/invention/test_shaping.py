"""Hidden constants are lifted, narrow relations widened (D8)."""

from __future__ import annotations

import pytest
from notebook import make_domain

from skillwrapper.invention.shaping import hidden_constant, lift, widen
from skillwrapper.symbols import Predicate

GARAGE = make_domain(
    types={
        "robot": (),
        "part": (),
        "wheel": ("part",),
        "place": (),
        "lift": ("place",),
        "tool-rack": ("place",),
    },
    objects={
        "robot": "robot",
        "rim": "wheel",
        "door": "part",
        "ramp": "lift",
        "left_rack": "tool-rack",
        "right_rack": "tool-rack",
    },
    skills={"Fetch": "robot part place", "Pump": "robot wheel"},
)


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        (
            Predicate("on_ramp", ("wheel",), "The wheel stands on the ramp."),
            Predicate("on_place", ("wheel", "place"), "The wheel stands on the place."),
        ),
        (
            Predicate("hangs", ("wheel",), "the wheel hangs on the Left Rack."),
            Predicate("hangs", ("wheel", "tool-rack"), "the wheel hangs on the tool-rack."),
        ),
        (
            Predicate("in_left_rack", (), "something is in the left_rack"),
            Predicate("in_tool-rack", ("tool-rack",), "something is in the tool-rack"),
        ),
        (
            Predicate("is_flat", ("wheel",), "the rim has no air"),
            Predicate("is_flat", ("wheel",), "the wheel has no air"),
        ),
    ],
)
def test_a_named_object_becomes_a_parameter(given: Predicate, wanted: Predicate) -> None:
    found = lift(given, GARAGE)
    assert found is not None
    assert hidden_constant(found, GARAGE) is None
    assert (found.types, found.semantics) == (wanted.types, wanted.semantics)
    assert found.name == wanted.name


@pytest.mark.parametrize(
    ("given", "name", "meaning"),
    [
        ("on_a_place", "on_place", "The wheel stands on a place."),
        ("stands", "stands", "the wheel stands on some place."),
    ],
)
def test_what_says_some_is_a_case_of_a_relation(given: str, name: str, meaning: str) -> None:
    found = lift(Predicate(given, ("wheel",), meaning), GARAGE)
    assert found is not None
    assert (found.name, found.types) == (name, ("wheel", "place"))
    assert found.semantics.casefold() == "the wheel stands on the place."


@pytest.mark.parametrize("meaning", ["no place is near the wheel", "the wheel is a part"])
def test_what_says_none_or_means_itself_stays(meaning: str) -> None:
    given = Predicate("alone", ("wheel",), meaning)
    assert lift(given, GARAGE) == given


@pytest.mark.parametrize(
    "harmless",
    [
        Predicate("held", ("part",), "the robot holds the part"),
        Predicate("trims", ("wheel",), "the wheel is rimmed, doorlike and ramped"),
        Predicate("on", ("part", "place"), "the part lies on the place"),
    ],
)
def test_an_object_without_others_of_its_kind_may_be_named(harmless: Predicate) -> None:
    assert lift(harmless, GARAGE) == harmless


def test_what_would_need_a_third_parameter_is_no_candidate() -> None:
    assert lift(Predicate("between", ("wheel", "robot"), "near the ramp"), GARAGE) is None


def test_relations_are_widened_to_what_skills_take() -> None:
    narrow = Predicate("stands_on", ("wheel", "lift"), "The wheel stands on the lift.")
    wide = Predicate("stands_on", ("part", "place"), "The part stands on the place.")
    assert widen(narrow, GARAGE) == wide
    assert widen(wide, GARAGE) == wide


def test_properties_keep_their_type() -> None:
    flat = Predicate("is_flat", ("wheel",), "the wheel has no air")
    assert widen(flat, GARAGE) == flat
