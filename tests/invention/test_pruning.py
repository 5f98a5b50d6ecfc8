"""Pruning (D9): synonyms, antonyms, superfluous predicates, and predicates that only split."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from notebook import Notebook, make_domain
from random_worlds import DOMAIN, PREDICATES, QUICK, random_notebook

from skillwrapper.invention.pruning import find_burdens, prune
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.symbols import Predicate
from skillwrapper.world import Episode

KITCHEN = make_domain(
    types={"robot": (), "item": (), "place": ()},
    objects={"r": "robot", "a": "item", "b": "item", "x": "place", "y": "place"},
    skills={"Take": "robot item"},
)
EMPTY = Predicate("empty", ("robot",))
FREE_HAND = Predicate("free_hand", ("robot",))
FULL = Predicate("full", ("robot",))
HELD = Predicate("held", ("item",))
NEAR = Predicate("near", ("item", "place"))
SHINY = Predicate("shiny", ("item",))
SUNNY = Predicate("sunny", ())
FOG = Predicate("fog", ("robot",))


def recorded() -> Notebook:
    """When it works is told by ``empty``, what it does by ``held``; the rest is names or noise."""
    notebook = Notebook(KITCHEN)
    for item, more in (("a", ""), ("b", "sunny()"), ("a", "sunny()")):
        ready = f"empty(r) free_hand(r) {more}"
        notebook.success(ready, f"Take(r, {item})", f"{ready} held({item})")
        notebook.failure(f"full(r) {more}", f"Take(r, {item})")
    return notebook


def pruned(notebook: Notebook, *predicates: Predicate) -> tuple[list[str], list[str]]:
    """(active, reasons) after pruning a vocabulary."""
    words = Vocabulary(KITCHEN.types, predicates)
    found = prune(notebook.fitter(), words)
    assert {p.predicate for p in found} == set(words.dormant)
    assert {*words.active, *words.dormant} == set(predicates)
    return [p.name for p in words.active], [f"{p.predicate.name}: {p.reason}" for p in found]


def test_synonyms_and_antonyms_are_merged_into_the_first() -> None:
    active, reasons = pruned(recorded(), EMPTY, HELD, FREE_HAND, FULL)
    assert active == ["empty", "held"]
    assert reasons == [
        "free_hand: synonym of empty on all data",
        "full: antonym of empty on all data",
    ]


def test_predicates_of_other_types_are_never_merged() -> None:
    notebook = Notebook(KITCHEN)
    notebook.success("empty(r) sunny()", "Take(r, a)", "held(a)")
    notebook.failure("", "Take(r, b)")
    words = Vocabulary(KITCHEN.types, (EMPTY, SUNNY, HELD))
    assert not [p for p in prune(notebook.fitter(), words) if "nonym" in p.reason]


def test_nothing_is_a_synonym_of_what_is_never_known() -> None:
    """A label that is unknown everywhere says neither that two are equal nor that they differ."""
    notebook = Notebook(KITCHEN)
    unknown = "?fog(r)"
    notebook.success(f"empty(r) {unknown}", "Take(r, a)", f"empty(r) held(a) {unknown}")
    notebook.failure(f"{unknown}", "Take(r, b)")
    active, _ = pruned(notebook, FOG, EMPTY, HELD)
    assert active == ["empty", "held"]


def test_superfluous_predicates_are_set_dormant() -> None:
    active, reasons = pruned(recorded(), SUNNY, EMPTY, HELD)
    assert active == ["empty", "held"]
    assert reasons == ["sunny: its removal adds no inconsistency"]


def test_nothing_needed_is_set_dormant() -> None:
    notebook = recorded()
    before = notebook.fit(EMPTY, HELD)
    assert not before.inconsistencies
    assert pruned(notebook, EMPTY, HELD) == (["empty", "held"], [])
    assert pruned(notebook, HELD, EMPTY) == (["held", "empty"], [])


def test_witnesses_are_compared_as_sets_not_counted() -> None:
    """Without ``shiny`` another transition is wrong, though no more than with it."""
    notebook = Notebook(KITCHEN)
    notebook.success("shiny(a)", "Take(r, a)", "shiny(a) held(a)")
    notebook.success("shiny(a)", "Take(r, a)", "shiny(a) held(a) shiny(b)")
    notebook.failure("", "Take(r, a)")
    with_it, without = notebook.fit(SHINY, HELD), notebook.fit(HELD)
    assert len(with_it.witnesses) == len(without.witnesses) == 1
    assert with_it.witnesses != without.witnesses
    assert pruned(notebook, SHINY, HELD)[0] == ["shiny", "held"]


def test_the_least_used_goes_first() -> None:
    """``near`` tells successes from failures as ``empty`` does, and what they change as well."""
    notebook = Notebook(KITCHEN)
    for item in "ab":
        ready = f"empty(r) near({item}, x)"
        notebook.success(ready, f"Take(r, {item})", f"empty(r) held({item})")
    notebook.failure("", "Take(r, a)")
    assert pruned(notebook, HELD, EMPTY, NEAR) == (
        ["near"],
        ["empty: its removal adds no inconsistency", "held: its removal adds no inconsistency"],
    )


def test_of_two_that_are_used_alike_the_later_goes() -> None:
    notebook = Notebook(KITCHEN)
    for item in "ab":
        ready = f"empty(r) shiny({item})"
        notebook.success(ready, f"Take(r, {item})", f"{ready} held({item})")
    notebook.failure("", "Take(r, a)")
    assert pruned(notebook, HELD, EMPTY, SHINY)[0] == ["held", "empty"]
    assert pruned(notebook, HELD, SHINY, EMPTY)[0] == ["held", "shiny"]


def test_the_vocabulary_after_pruning_cannot_be_pruned() -> None:
    notebook = recorded()
    words = Vocabulary(KITCHEN.types, (SUNNY, FULL, EMPTY, HELD, FREE_HAND))
    prune(notebook.fitter(), words)
    assert prune(notebook.fitter(), words) == ()


@pytest.fixture
def divided() -> Notebook:
    """Each taking changes what is near what, at random; ``held`` alone tells all."""
    notebook = Notebook(KITCHEN)
    for before, after in (
        ("near(a, x)", "near(a, y)"),
        ("near(a, x) near(a, y)", ""),
        ("", "near(a, x) near(a, y)"),
        ("near(a, y)", ""),
    ):
        notebook.success(before, "Take(r, a)", f"held(a) {after}")
    return notebook


def test_a_predicate_that_only_splits_is_a_burden(divided: Notebook) -> None:
    words = Vocabulary(KITCHEN.types, (HELD, NEAR))
    fitter = divided.fitter()
    assert len(fitter.fit([HELD, NEAR]).operators) > len(fitter.fit([HELD]).operators) == 1
    assert find_burdens(fitter, words) == (NEAR,)
    assert find_burdens(fitter, words, spared={NEAR}) == ()


def test_what_explains_as_much_as_it_splits_is_none() -> None:
    words = Vocabulary(KITCHEN.types, (EMPTY, HELD))
    assert find_burdens(recorded().fitter(), words) == ()


@settings(QUICK, max_examples=15)
@given(st.lists(st.integers(0, 10**9), min_size=1, max_size=2))
def test_burdens_are_those_of_weighing_every_vocabulary_in_full(seeds: list[int]) -> None:
    """One that is known to be dearer is not weighed to its end."""
    notebook = Notebook(DOMAIN, *PREDICATES)
    for seed in seeds:
        records = random_notebook(seed).recorded.records
        for record in records:
            notebook.recorded.add(Episode(record.scene, 0, (record.transition,)))
    fitter = notebook.fitter()
    remaining, weighed = PREDICATES, [PREDICATES]
    while remaining:
        fewer = [tuple(q for q in remaining if q != p) for p in reversed(remaining)]
        remaining = min(fewer, key=lambda words: fitter.fit(words).cost)
        weighed.append(remaining)
    best = min(weighed, key=lambda words: fitter.fit(words).cost)
    words = Vocabulary(DOMAIN.types, PREDICATES)
    burdens = find_burdens(notebook.fitter(), words, keeps_consistent=False)
    assert burdens == tuple(p for p in PREDICATES if p not in best)


@settings(QUICK, max_examples=15)
@given(st.integers(0, 10**9))
def test_taking_back_brings_no_violation(seed: int) -> None:
    """D9: else what was taken back is asked for again."""
    notebook = Notebook(DOMAIN, *PREDICATES)
    for record in random_notebook(seed).recorded.records:
        notebook.recorded.add(Episode(record.scene, 0, (record.transition,)))
    fitter = notebook.fitter()
    burdens = find_burdens(fitter, Vocabulary(DOMAIN.types, PREDICATES))
    left = [p for p in PREDICATES if p not in burdens]
    whole, without = fitter.fit(PREDICATES), fitter.fit(left)
    assert without.witnesses <= whole.witnesses
    assert without.cost <= whole.cost
