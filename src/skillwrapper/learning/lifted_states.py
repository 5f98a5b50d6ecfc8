"""Lifted abstract states: what is seen around the arguments of a skill instance.

Two states are the same, seen from their skill instances, if one turns into the other by renaming
(Lemma 1 as of D15): the restriction to atoms of the arguments, nullary atoms, the types
of the arguments, and of every context object its types and its unary atoms.
"""

from __future__ import annotations

import numpy as np

from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols import Atom
from skillwrapper.world.skills import SkillInstance

LiftedState = tuple[object, ...]


def lifted_state(space: AtomSpace, state: Labels, instance: SkillInstance) -> LiftedState:
    """The lifted state (atoms,) seen from a skill instance, as a value that can be compared.

    Each context object is described by itself, so sorting the descriptions decides equality up
    to renaming as long as no atom of the arguments holds two context objects; such an atom is
    described without telling the two apart.
    """
    objects = {o.name: o for o in space.objects}
    position = {name: f"#{number}" for number, name in enumerate(instance.arguments)}
    true = [space.atoms[i] for i in np.flatnonzero(state == TRUE)]
    near = [a for a in true if not a.terms or position.keys() & set(a.terms)]
    context = {t for atom in near for t in atom.terms} - position.keys()
    return (
        tuple(objects[name].types for name in instance.arguments),
        tuple(sorted(str(a.substitute(position)) for a in near if position.keys() >= set(a.terms))),
        tuple(sorted(_describe(objects[c].types, c, near, true, position) for c in context)),
    )


def is_lifted_state_known(space: AtomSpace, state: Labels, instance: SkillInstance) -> bool:
    """Whether no unknown label in a state (atoms,) belongs to its lifted state."""
    unknown = [space.atoms[i] for i in np.flatnonzero(state == UNKNOWN)]
    if not unknown:
        return True
    near = set(instance.arguments)
    if any(not a.terms or near.intersection(a.terms) for a in unknown):
        return False
    true = (space.atoms[i] for i in np.flatnonzero(state == TRUE))
    context = {t for a in true if near.intersection(a.terms) for t in a.terms}
    return not any(len(a.terms) == 1 and a.terms[0] in context for a in unknown)


def _describe(
    types: tuple[str, ...],
    name: str,
    near: list[Atom],
    true: list[Atom],
    position: dict[str, str],
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    own = {**position, name: "?"}
    relations = [
        f"{a.predicate}{[own.get(t, '*') for t in a.terms]}" for a in near if name in a.terms
    ]
    unary = [a.predicate for a in true if a.terms == (name,)]
    return types, tuple(sorted(relations + unary))
