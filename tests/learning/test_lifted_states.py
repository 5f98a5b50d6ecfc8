"""Lemma 1's lifted states (D15): what is seen around the arguments, whatever it is called."""

from __future__ import annotations

import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from notebook import Notebook, instance, picture
from random_worlds import DOMAIN, PREDICATES, QUICK

from skillwrapper.grounding import TRUE, AtomSpace
from skillwrapper.learning.lifted_states import is_lifted_state_known, lifted_state
from skillwrapper.world import Object

SPACE = AtomSpace(PREDICATES, DOMAIN.objects)
NOTEBOOK = Notebook(DOMAIN, *PREDICATES)


def seen(state: str, skill: str = "Use(r, a)") -> object:
    return lifted_state(SPACE, NOTEBOOK.labels(SPACE, [picture(state)])[0], instance(skill))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("", "dark()"),
        ("", "clean(a)"),
        ("", "holds(r, a)"),
        ("on(a, d)", "on(d, a)"),
        ("on(a, d)", "on(a, d) clean(d)"),
        ("on(a, c)", "on(a, c) ready(c)"),
        ("on(a, b) on(d, a)", "on(a, b) on(b, a)"),
        ("on(a, b) clean(b) on(d, a)", "on(a, b) on(d, a) clean(d)"),
    ],
    ids=str,
)
def test_told_apart(one: str, other: str) -> None:
    """Nullary atoms, atoms of arguments, relations, unary atoms of context objects."""
    assert seen(one) != seen(other)


def test_types_of_arguments_and_context_are_told_apart() -> None:
    assert seen("", "Use(r, a)") != seen("", "Use(r, c)")
    assert seen("on(a, c)", "Use(r, a)") != seen("on(a, d)", "Use(r, a)")


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("", "clean(d)"),
        ("", "on(b, c)"),
        ("on(a, d)", "on(a, d) on(d, c)"),
    ],
    ids=str,
)
def test_not_told_apart(one: str, other: str) -> None:
    """What concerns other things alone."""
    assert seen(one) == seen(other)


@QUICK
@given(st.integers(0, 10**9))
def test_renaming_objects_of_the_same_types_changes_nothing(seed: int) -> None:
    chance = random.Random(seed)
    types = {o.name: o.types for o in DOMAIN.objects}
    new = dict(zip(types, chance.sample("uvwxyz", len(types)), strict=True))
    renamed = [Object(new[name], own) for name, own in types.items()]
    other_space = AtomSpace(PREDICATES, tuple(chance.sample(renamed, len(renamed))))
    state = np.array([chance.choice((0, 0, 1)) for _ in SPACE.atoms], dtype=np.int8)
    true = {a.substitute(new) for a in SPACE.true_atoms(state)}
    other = np.array([TRUE if a in true else 0 for a in other_space.atoms], dtype=np.int8)
    skill = chance.choice(DOMAIN.skill_instances)
    arguments = ", ".join(new[a] for a in skill.arguments)

    expected = lifted_state(SPACE, state, skill)
    assert lifted_state(other_space, other, instance(f"{skill.skill}({arguments})")) == expected


@pytest.mark.parametrize(
    ("state", "known"),
    [
        ("on(a, d)", True),
        ("on(a, d) ?on(d, c)", True),
        ("on(a, d) ?clean(c)", True),
        ("on(a, d) ?clean(d)", False),
        ("on(a, d) ?clean(a)", False),
        ("on(a, d) ?on(b, a)", False),
        ("on(a, d) ?dark()", False),
    ],
)
def test_whether_it_is_known(state: str, known: bool) -> None:
    labels = NOTEBOOK.labels(SPACE, [picture(state)])[0]
    assert is_lifted_state_known(SPACE, labels, instance("Use(r, a)")) is known
