"""Random small planning domains, and all or some of what can be tried in them."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from hypothesis import strategies as st

from skillwrapper.action_models.joins import EQUAL, Literal
from skillwrapper.action_models.skeleton import DomainSkeleton, LiftedAtom, Schema, TypedName
from skillwrapper.action_models.steps import State, Step
from skillwrapper.action_models.strips import Action, Strips
from skillwrapper.world.types import TypeHierarchy

_BOX, _THING = ("box",), ("thing",)
OBJECTS = {"b1": "box", "t1": "thing"}
CONSTANT = TypedName("home", _BOX)


@dataclass(frozen=True)
class World:
    """A domain with all its ground atoms and everything that can be tried.

    Attributes:
        true: the domain.
        atoms: the ground atoms.
        instances: names and arguments of all actions.
    """

    true: Strips
    atoms: tuple[str, ...]
    instances: tuple[tuple[str, tuple[str, ...]], ...]

    @property
    def states(self) -> Iterator[State]:
        """Every combination of atoms."""
        for chosen in itertools.product((False, True), repeat=len(self.atoms)):
            yield frozenset(itertools.compress(self.atoms, chosen))

    def steps(self, states: Iterable[State]) -> Iterator[Step]:
        """What comes of every action in some states."""
        for state in states:
            good = set(self.true.applicable(state, OBJECTS))
            for name, arguments in self.instances:
                done = (name, arguments) in good
                after = self.true.actions[name].apply(state, arguments) if done else state
                yield Step(name, arguments, done, state, after)


@st.composite
def worlds(draw: st.DrawFn) -> World:
    """Worlds of one action, with subtypes, constants, negative preconditions and conditions."""
    predicates = draw(st.sampled_from(_VOCABULARIES))
    parameters = tuple(
        TypedName(f"?x{number}", draw(st.sampled_from([_BOX, _THING])))
        for number in range(draw(st.integers(0, 2)))
    )
    constants = (CONSTANT,) if draw(st.booleans()) else ()
    schema = Schema("act", parameters)
    skeleton = DomainSkeleton(
        "random",
        TypeHierarchy({"thing": (), "box": ("thing",)}),
        constants,
        {predicate.name: predicate for predicate in predicates},
        {"act": schema},
        frozenset({":negative-preconditions", ":equality"}),
    )
    atoms = list(skeleton.atoms_of(schema))
    action = Action("act", parameters, _precondition(draw, schema, atoms), _effects(draw, atoms))
    objects = {**OBJECTS, **{c.name: c.types[0] for c in constants}}
    free = Strips(skeleton, {"act": Action("act", parameters, (), ())})
    ground = tuple(_ground_atoms(skeleton, objects))
    return World(
        Strips(skeleton, {"act": action}), ground, tuple(free.applicable(frozenset(), objects))
    )


_VOCABULARIES: Sequence[tuple[Schema, ...]] = (
    (Schema("on", (TypedName("?a", _THING),)), Schema("power")),
    (Schema("in", (TypedName("?a", _THING), TypedName("?b", _BOX))),),
    (Schema("on", (TypedName("?a", _THING),)), Schema("open", (TypedName("?a", _BOX),))),
)


def _precondition(
    draw: st.DrawFn, schema: Schema, atoms: Sequence[LiftedAtom]
) -> tuple[Literal, ...]:
    literals = [*_literals(draw, atoms, most=2)]
    if len(schema.parameters) == 2 and draw(st.booleans()):
        literals.append((False, (EQUAL, *(p.name for p in schema.parameters))))
    return tuple(literals)


def _effects(
    draw: st.DrawFn, atoms: Sequence[LiftedAtom]
) -> tuple[tuple[tuple[Literal, ...], Literal], ...]:
    changes = _literals(draw, atoms, most=2)
    when = _literals(draw, atoms, most=1) if draw(st.booleans()) else ()
    return tuple((when if number == 0 else (), c) for number, c in enumerate(changes))


def _literals(draw: st.DrawFn, atoms: Sequence[LiftedAtom], most: int) -> tuple[Literal, ...]:
    if not atoms:
        return ()
    chosen = draw(st.lists(st.sampled_from(atoms), max_size=most, unique=True))
    return tuple((draw(st.booleans()), (atom.predicate, *atom.terms)) for atom in chosen)


def _ground_atoms(skeleton: DomainSkeleton, objects: dict[str, str]) -> Iterator[str]:
    for predicate in skeleton.predicates.values():
        choices = [
            [n for n, kind in objects.items() if skeleton.accepts(kind, slot)]
            for slot in predicate.parameters
        ]
        for terms in itertools.product(*choices):
            yield LiftedAtom(predicate.name, terms).ground({})
