"""A small domain and model for exploration: two doors that can be opened and shut."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from notebook import Notebook

from skillwrapper.exploration.explorer import Situation
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.learning.fitting import Fit
from skillwrapper.symbols import AbstractModel, Atom, Literal, Operator, Predicate, Variable
from skillwrapper.world import (
    Domain,
    Object,
    Observation,
    Parameter,
    Picture,
    Scene,
    Skill,
    SkillInstance,
    Transition,
    TypeHierarchy,
)

OPEN = Predicate("open", ("door",))
GARDEN = Domain(
    name="garden",
    agent="A gardener.",
    description="Two doors.",
    types=TypeHierarchy({"door": ()}),
    objects=(Object("left", ("door",)), Object("right", ("door",))),
    skills=tuple(Skill(name, (Parameter("door", "door"),)) for name in ("Open", "Shut")),
)
SPACE = AtomSpace((OPEN,), GARDEN.objects)
SEEN = Observation((Picture(b"doors"),))
OPEN_LEFT, OPEN_RIGHT, SHUT_LEFT, SHUT_RIGHT = GARDEN.skill_instances


def operator(skill: str, *, opens: bool) -> Operator:
    door, is_open = Variable("?door", ("door",)), Atom("open", ("?door",))
    return Operator(
        name=f"{skill}_1",
        skill=skill,
        parameters=(door,),
        arity=1,
        preconditions=frozenset({Literal(is_open, not opens)}),
        absences=frozenset(),
        add_effects=frozenset({is_open} if opens else ()),
        delete_effects=frozenset(() if opens else {is_open}),
    )


MODEL = AbstractModel(
    GARDEN, (OPEN,), (operator("Open", opens=True), operator("Shut", opens=False))
)


def state(*labels: int) -> Labels:
    """Labels of ``open(left)`` and ``open(right)``."""
    return np.array(labels, dtype=np.int8)


def is_repetitive(sequence: Sequence[SkillInstance]) -> bool:
    return any(a == b for a, b in pairwise(sequence))


def learned(*failures: tuple[str, SkillInstance]) -> Fit:
    """What is learned of doors that were opened and shut, and of (state, attempt) that failed."""
    notebook = Notebook(GARDEN, OPEN)
    for door in ("left", "right"):
        notebook.success("", f"Open({door})", f"open({door})")
        notebook.success(f"open({door})", f"Shut({door})", "")
    for before, attempt in failures:
        notebook.failure(before, str(attempt))
    return notebook.fit()


TESTED = learned(("open(left)", OPEN_LEFT), ("", SHUT_LEFT))
"""As ``MODEL``; every condition was put to the test."""


def situation(
    now: Labels,
    *done: SkillInstance,
    left: int = 4,
    fit: Fit = TESTED,
    scene: Scene | None = None,
) -> Situation:
    """The doors as they are now, after some skills that succeeded."""
    transitions = tuple(Transition(SEEN, i, True, SEEN) for i in done)
    present = scene or GARDEN.scene()
    return Situation(present, SEEN, transitions, left, lambda: fit, lambda space: now)
