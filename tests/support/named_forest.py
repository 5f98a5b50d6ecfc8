"""A small model whose types, objects, predicates and operator have any names that a test likes."""

from __future__ import annotations

from pddl_readers import Texts

from skillwrapper.symbols import (
    Absence,
    AbstractModel,
    Atom,
    ConditionalEffect,
    Literal,
    Operator,
    Predicate,
    Variable,
)
from skillwrapper.symbols.pddl import print_domain, print_problem
from skillwrapper.symbols.pddl_names import KEYWORDS
from skillwrapper.world import Domain, Object, Parameter, Skill, TypeHierarchy

TROUBLE = (
    *("thing", "thing_2", "object", "object_2", "Object", "any", "other", "x", "and_2"),
    *("open", "done", "finish", "action-0", "scene", "now", "atom", "new-axiom", "a-", "a_", "A"),
    *("agent", "boolean", "integer", "process", "event", "condition", "strips", "typing", "t"),
)
WORDS = sorted(KEYWORDS | set(TROUBLE))


def forest(types: tuple[str, str, str], rest: tuple[str, ...], hot: bool = True) -> AbstractModel:
    """A model in which everything that has a name has one of these.

    Args:
        types: a type, its subtype and one that overlaps with both.
        rest: two objects, two predicates, an operator.
        hot: whether the overlapping type is used.
    """
    above, below, beside = types
    one, two, unary, binary, act = rest
    hierarchy = TypeHierarchy({above: (), below: (above,), beside: ()})
    objects = (
        Object(one, tuple(sorted(types))),
        Object(two, tuple(sorted({above, below}))),
        Object(f"{one}_x", (beside,)),
    )
    skill = Skill(act, (Parameter(unary, above),))
    domain = Domain(unary, "a robot", "a forest", hierarchy, objects, (skill,))
    first, second = f"?{above}", f"?{below}"
    operator = Operator(
        act,
        act,
        (Variable(first, (above,)), Variable(second, (beside,) if hot else (below,))),
        1,
        frozenset({Literal(Atom(unary, (first,)))}),
        frozenset({Absence(Atom(binary, ("?other", first)), ("?other",))}),
        frozenset({Atom(unary, (first,)) if hot else Atom(binary, (first, second))}),
        frozenset(),
        frozenset(
            {
                ConditionalEffect(
                    Variable("?each", (below,)), (), Literal(Atom(unary, ("?each",)), False)
                )
            }
        ),
    )
    vocabulary = (Predicate(unary, (above,), "(is so;"), Predicate(binary, (above, above)))
    return AbstractModel(domain, vocabulary, (operator,))


def printed(model: AbstractModel) -> Texts:
    unary, binary = model.predicates
    one, two, _ = (o.name for o in model.domain.objects)
    goal = (
        Literal(Atom(binary.name, (one, two))),
        Literal(Atom(unary.name, (two,)), False),
    )
    true = [Atom(unary.name, (one,))]
    return print_domain(model), print_problem(model, model.domain.objects, true, goal)


def in_turn(number: int) -> AbstractModel:
    """A model in which a word stands at one place, and its neighbours at the others."""
    above, below, beside, *rest = (WORDS * 2)[number : number + 8]
    return forest((above, below, beside), tuple(rest), hot=number % 2 == 0)


def everywhere(word: str) -> AbstractModel:
    """A model in which all names look like one word."""
    rest = (word, f"{word}_2", word, f"{word}-2", word)
    return forest((word, f"{word}{word}".upper(), f"{word}_2"), rest)
