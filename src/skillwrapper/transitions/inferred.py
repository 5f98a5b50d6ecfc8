"""A vocabulary inferred from the atoms that occur, where nobody gives one."""

from __future__ import annotations

from collections.abc import Iterable

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.scenes import Scene
from skillwrapper.world.types import TypeHierarchy


def infer_predicates(
    types: TypeHierarchy, seen: Iterable[tuple[str, Scene, Atom]]
) -> tuple[Predicate, ...]:
    """Predicates with the most specific types that cover all objects seen, sorted by name.

    Args:
        types: the type hierarchy.
        seen: where an atom stands, for complaints; the objects present; the atom.

    Raises:
        UnknownNameError: if an atom names an object that is not there.
        ConfigurationError: if a predicate has different numbers of terms, or objects that no
            type covers.
    """
    common: dict[str, list[frozenset[str]]] = {}
    places: dict[tuple[Scene, Atom], str] = {}
    for where, scene, atom in seen:
        places.setdefault((scene, atom), where)
    for (scene, atom), where in places.items():
        found = _types_of(atom, scene, where)
        common[atom.predicate] = _shared(atom, common.get(atom.predicate, found), found, where)
    return tuple(
        Predicate(name, tuple(types.most_specific(shared)[0] for shared in common[name]))
        for name in sorted(common)
    )


def _types_of(atom: Atom, scene: Scene, where: str) -> list[frozenset[str]]:
    """All types of each term."""
    present = {o.name: frozenset(o.types) for o in scene.objects}
    for name in atom.terms:
        if name not in present:
            raise UnknownNameError("object", name, present, where)
    return [present[name] for name in atom.terms]


def _shared(
    atom: Atom, before: list[frozenset[str]], found: list[frozenset[str]], where: str
) -> list[frozenset[str]]:
    """The types that the terms of an atom share with those of its predicate's other atoms."""
    if len(before) != len(found):
        raise ConfigurationError(
            f"{where}: expected {len(before)} terms of {atom.predicate} as before, got {atom}"
        )
    shared = [a & b for a, b in zip(before, found, strict=True)]
    if frozenset() in shared:
        raise ConfigurationError(
            f"{where}: no type of the domain covers what {atom.predicate} is said of; give "
            "the predicates with their types"
        )
    return shared
