"""Candidates in the most general form: no hidden constants, no types narrower than need be (D8)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from skillwrapper.symbols import Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.types import Object

_MOST_PARAMETERS = 2
_SOME = r"(?<![A-Za-z])(?:an?|some|any|one|one of the)"


def hidden_constant(predicate: Predicate, domain: Domain) -> Object | None:
    """The first object that a predicate's name or meaning names, although others are of its kind.

    An object of which there is only one kind hides no choice: it may be named.
    """
    text = f"{predicate.name} {predicate.semantics}"
    kinds = {_spoken(name) for name in domain.types.names}
    named = (o for o in domain.objects if _spoken(o.name) not in kinds)
    named = (o for o in named if _shared_types(o, domain) and _phrase(o.name).search(text))
    return next(named, None)


def lift(predicate: Predicate, domain: Domain) -> Predicate | None:
    """The relation that a predicate about a certain object is a case of.

    The object's name gives way to a type that it shares with others: ``on_tray(?cup)`` becomes
    ``on_furniture(?cup, ?furniture)``. A name that can only mean one of the parameters becomes
    the type of that parameter. Likewise what says that there is some object of a type, "on some
    furniture", is a case of a relation to it; operators can say "some" by themselves (D2).

    Returns:
        The predicate itself if it names no object; None if it cannot be lifted.
    """
    lifted = _lift_constants(predicate, domain)
    return lifted and _lift_existential(lifted, domain)


def _lift_constants(predicate: Predicate, domain: Domain) -> Predicate | None:
    for _ in range(_MOST_PARAMETERS + 1):
        constant = hidden_constant(predicate, domain)
        if constant is None:
            return predicate
        meant = [t for t in predicate.types if t in constant.types]
        if meant:
            predicate = _reworded(predicate, constant.name, meant[0], predicate.types)
        elif len(predicate.types) < _MOST_PARAMETERS:
            wanted = _shared_types(constant, domain)[0]
            types = (*predicate.types, wanted)
            predicate = _reworded(predicate, constant.name, wanted, types)
        else:
            return None
    return None


def _lift_existential(predicate: Predicate, domain: Domain) -> Predicate:
    """A property that says "some object of a type" as a relation to that object."""
    related = domain.types.closure(predicate.types)
    for name in domain.types.names if predicate.arity == 1 else ():
        some = re.compile(rf"(?:{_SOME})[ _-]{_phrase(name).pattern}", re.IGNORECASE)
        is_other = name not in related and not domain.types.ancestors[name] & set(predicate.types)
        if is_other and some.search(predicate.semantics):
            return Predicate(
                some.sub(name, predicate.name),
                (*predicate.types, name),
                some.sub(f"the {name}", predicate.semantics),
            )
    return predicate


def widen(predicate: Predicate, domain: Domain) -> Predicate:
    """A relation over the widest types that skills take: what is handled alike is related alike."""
    if len(predicate.types) < _MOST_PARAMETERS:
        return predicate
    widest = {t: _widest(t, domain) for t in predicate.types}
    return with_types(predicate, [widest[t] for t in predicate.types])


def with_types(predicate: Predicate, types: Sequence[str]) -> Predicate:
    """A predicate for other types, which its meaning then speaks of."""
    semantics = predicate.semantics
    for old, new in dict(zip(predicate.types, types, strict=True)).items():
        semantics = _replaced(semantics, old, new)
    return replace(predicate, types=tuple(types), semantics=semantics)


def _widest(type_name: str, domain: Domain) -> str:
    """The type or that ancestor of it, among the types of skills' parameters, with most objects."""
    taken = {p.type for skill in domain.skills for p in skill.parameters}
    choice = [type_name, *sorted(domain.types.ancestors[type_name] & taken)]
    return max(choice, key=lambda name: sum(name in o.types for o in domain.objects))


def _shared_types(constant: Object, domain: Domain) -> tuple[str, ...]:
    """The most specific types that an object shares with others."""
    shared = {t for t in constant.types for o in domain.objects if o != constant and t in o.types}
    return domain.types.most_specific(frozenset(shared)) if shared else ()


def _reworded(predicate: Predicate, name: str, type_name: str, types: tuple[str, ...]) -> Predicate:
    return Predicate(
        _replaced(predicate.name, name, type_name),
        types,
        _replaced(predicate.semantics, name, type_name),
    )


def _replaced(text: str, old: str, new: str) -> str:
    """Text with a name in place of another, in whatever way that is written."""
    return _phrase(old).sub(new, text)


def _phrase(name: str) -> re.Pattern[str]:
    """A name as whole words, written with blanks, underscores or hyphens."""
    words = (re.escape(word) for word in _words(name))
    return re.compile(rf"(?<![A-Za-z0-9]){r'[ _-]'.join(words)}(?![A-Za-z0-9])", re.IGNORECASE)


def _spoken(text: str) -> str:
    return " ".join(_words(text)).casefold()


def _words(text: str) -> list[str]:
    return re.findall(r"[A-Za-z0-9]+", text)
