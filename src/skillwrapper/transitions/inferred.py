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
    own: dict[Scene, dict[str, frozenset[str]]] = {}
    done: set[tuple[Scene, Atom]] = set()
    for where, scene, atom in seen:
        if (scene, atom) in done:
            continue
        done.add((scene, atom))
        if scene not in own:
            own[scene] = {o.name: frozenset(o.types) for o in scene.objects}
        for name in atom.terms:
            if name not in own[scene]:
                raise UnknownNameError("object", name, own[scene], where)
        found = [own[scene][name] for name in atom.terms]
        before = common.setdefault(atom.predicate, found)
        if len(before) != len(found):
            raise ConfigurationError(
                f"{where}: expected {len(before)} terms of {atom.predicate} as before, got {atom}"
            )
        common[atom.predicate] = [a & b for a, b in zip(before, found, strict=True)]
        if frozenset() in common[atom.predicate]:
            raise ConfigurationError(
                f"{where}: no type of the domain covers what {atom.predicate} is said of; give "
                "the predicates with their types"
            )
    return tuple(
        Predicate(name, tuple(types.most_specific(shared)[0] for shared in common[name]))
        for name in sorted(common)
    )
