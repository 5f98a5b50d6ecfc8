"""Hypothesis strategies for whole models over a domain whose types form no tree."""

from __future__ import annotations

from hypothesis import strategies as st

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
from skillwrapper.world import Domain, Object, Parameter, Skill, TypeHierarchy

TYPES = TypeHierarchy(
    {
        "robot": (),
        "item": (),
        "food": ("item",),
        "tool": ("item",),
        "Hot-Thing": (),
        "place": (),
    },
    {"Hot-Thing": "something one should not touch"},
)


def _object(name: str, *types: str) -> Object:
    return Object(name, tuple(sorted(TYPES.closure(types))))


DOMAIN = Domain(
    name="Forest",
    agent="a robot",
    description="a camp",
    types=TYPES,
    objects=(
        _object("robot", "robot"),
        _object("soup", "food", "Hot-Thing"),
        _object("Bread", "food"),
        _object("saw", "tool"),
        _object("fire", "place", "Hot-Thing"),
        _object("tent", "place"),
    ),
    skills=(
        Skill("Take", (Parameter("robot", "robot"), Parameter("item", "item"))),
        Skill("Wait", ()),
    ),
)

_NAMES = st.from_regex(r"[A-Za-z][A-Za-z0-9_-]{0,7}", fullmatch=True)
_ONE_LINE = st.text(st.characters(exclude_categories=("Cc", "Cs", "Zl", "Zp")), max_size=30)
_TYPE_NAMES = st.sampled_from(TYPES.names)


@st.composite
def predicates(draw: st.DrawFn) -> tuple[Predicate, ...]:
    """Up to five predicates, some of whose names differ in case only."""
    names = draw(st.lists(_NAMES, max_size=5, unique=True))
    return tuple(
        Predicate(name, tuple(draw(st.lists(_TYPE_NAMES, max_size=3))), draw(_ONE_LINE))
        for name in names
    )


def _atoms(vocabulary: tuple[Predicate, ...], terms: dict[str, tuple[str, ...]]) -> list[Atom]:
    """Well-typed atoms over terms with types; one for each way to fill in the first term."""
    found = []
    for predicate in vocabulary:
        for shift in range(2):
            chosen = []
            for type_name in predicate.types:
                fitting = [t for t, types in terms.items() if type_name in TYPES.closure(types)]
                chosen += fitting[shift : shift + 1]
            if len(chosen) == predicate.arity:
                found.append(Atom(predicate.name, tuple(chosen)))
    return sorted(set(found))


def _some(items: list[Atom]) -> st.SearchStrategy[list[Atom]]:
    chosen = st.lists(st.sampled_from(items), unique=True, max_size=4) if items else st.just([])
    return chosen.map(sorted)


@st.composite
def operators(draw: st.DrawFn, vocabulary: tuple[Predicate, ...], name: str) -> Operator:
    """An operator with everything that an operator can have."""
    skill = draw(st.sampled_from(DOMAIN.skills))
    own = [Variable(f"?{p.name}", (p.type,)) for p in skill.parameters]
    context = [
        Variable(f"?{n}", (draw(_TYPE_NAMES),)) for n in draw(st.sets(st.sampled_from("aAb")))
    ]
    parameters = tuple(own + sorted(context))
    atoms = _atoms(vocabulary, {v.name: v.types for v in parameters})
    added = draw(_some(atoms))
    other = Variable("?other", (draw(_TYPE_NAMES),))
    around = _atoms(vocabulary, {other.name: other.types} | {v.name: v.types for v in parameters})
    about_other = [a for a in around if "?other" in a.terms and a.terms.count("?other") == 1]
    return Operator(
        name,
        skill.name,
        parameters,
        len(own),
        frozenset(Literal(a, draw(st.booleans())) for a in draw(_some(atoms))),
        frozenset(Absence(a, ("?other",)) for a in draw(_some(about_other))),
        frozenset(added),
        frozenset(draw(_some([a for a in atoms if a not in added]))),
        frozenset(
            ConditionalEffect(
                other,
                tuple(Literal(c, draw(st.booleans())) for c in draw(_some(around))),
                Literal(a, draw(st.booleans())),
            )
            for a in draw(_some(about_other))
        ),
    )


@st.composite
def models(draw: st.DrawFn) -> AbstractModel:
    """A model of the forest camp."""
    vocabulary = draw(predicates())
    names = [
        f"{'Op' if number else 'op'}_{number // 2}" for number in range(draw(st.integers(0, 3)))
    ]
    return AbstractModel(
        DOMAIN, vocabulary, tuple(draw(operators(vocabulary, name)) for name in names)
    )
