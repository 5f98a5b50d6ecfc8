"""Narrowing: what only things of some types ever become is said of these alone (D3).

Whether a bun is cut into pieces need not be asked of every picture, nor be a condition that has to
be tested, where only skills that take what can be cut ever change it.
"""

from __future__ import annotations

from collections.abc import Iterator

from skillwrapper.invention.shaping import with_types
from skillwrapper.learning.fitting import Fit
from skillwrapper.symbols import Atom, Operator, Predicate
from skillwrapper.world.domain import Domain


def narrower(predicate: Predicate, fit: Fit) -> Predicate | None:
    """A predicate for the types of which the skills take what they change of it.

    Args:
        predicate: one of the vocabulary.
        fit: what was learned with it.

    Returns:
        None if no operator changes it, or if its types are no wider.
    """
    taken: list[set[str]] = [set() for _ in predicate.types]
    for learned in fit.operators:
        for atom in _changed(learned.operator):
            if atom.predicate == predicate.name:
                for place, term in enumerate(atom.terms):
                    known = _declared(learned.operator, term, fit.domain)
                    taken[place].add(known or predicate.types[place])
    types = [_common(own, fit.domain) for own in taken]
    narrowed = [
        new if new is not None and fit.domain.types.is_subtype(new, old) else old
        for new, old in zip(types, predicate.types, strict=True)
    ]
    return with_types(predicate, narrowed) if tuple(narrowed) != predicate.types else None


def _changed(operator: Operator) -> Iterator[Atom]:
    yield from sorted(operator.add_effects | operator.delete_effects)
    yield from (effect.effect.atom for effect in sorted(operator.conditional_effects))


def _declared(operator: Operator, term: str, domain: Domain) -> str | None:
    """The type that the skill declares for one of its arguments; None for any other term."""
    parameters = domain.skill_by_name[operator.skill].parameters
    names = (variable.name for variable in operator.parameters)
    types = {name: p.type for name, p in zip(names, parameters, strict=False)}
    return types.get(term)


def _common(types: set[str], domain: Domain) -> str | None:
    """The most specific type that covers all; None if there is none."""
    if not types:
        return None
    shared = frozenset.intersection(*(domain.types.ancestors[name] for name in types))
    return next(iter(domain.types.most_specific(shared)), None)
