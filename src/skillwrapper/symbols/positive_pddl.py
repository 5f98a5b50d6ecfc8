"""A model over the objects of one scene as PDDL of the plainest kind.

Planners such as POPF, which PlanSys2 runs, take conjunctions of atoms: no negation but in effects,
no disjunction, no ``forall``, no equality. What a model says beyond that is compiled away:

- A predicate ``on`` gets a partner ``no_on`` that is true where it is false; effects change both.
- "Different objects" becomes a static predicate that the problem lists.
- An object whose type has subtypes gets a subtype of its own: POPF crashes otherwise.
- "No other object stands in the relation" becomes one atom ``no_on`` for each object. Where the
  objects that are excepted from that matter, the action is written once for each choice of them.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.errors import SymbolError
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, Operator, Variable
from skillwrapper.symbols.pddl_layout import block, clause, comment, conjunction
from skillwrapper.symbols.pddl_names import PlannerNames, unique_name, variable_names
from skillwrapper.symbols.pddl_types import PddlTypes
from skillwrapper.symbols.predicates import Atom, Literal, Predicate
from skillwrapper.world.types import Object

_MOST_ACTIONS = 2000
"""An operator that would become more actions than this is refused."""


@dataclass(frozen=True)
class PositiveAction:
    """An operator, or a part of it in which objects are chosen for some parameters.

    Attributes:
        name: in the PDDL.
        operator: of the model.
        chosen: the objects chosen, by the names of parameters.
    """

    name: str
    operator: Operator
    chosen: Mapping[str, str]


@dataclass(frozen=True)
class PositivePddl:
    """Prints a model for one scene.

    Attributes:
        model: the model.
        objects: the objects of the scene.

    Raises:
        SymbolError: if an operator has conditional effects, or would become too many actions.
    """

    model: AbstractModel
    objects: tuple[Object, ...]

    def __post_init__(self) -> None:
        for operator in self.model.operators:
            if operator.conditional_effects:
                raise SymbolError(
                    f"operator {operator.name}: it changes every other object that meets a "
                    "condition, which planners without conditional effects cannot be told; "
                    "export it as pddl or up"
                )

    @cached_property
    def names(self) -> PlannerNames:
        """The names of what the model itself speaks of."""
        return PlannerNames.of(self.model, self.objects)

    @cached_property
    def actions(self) -> tuple[PositiveAction, ...]:
        """All actions, in the order of the operators."""
        return tuple(
            action
            for operator in sorted(self.model.operators, key=lambda o: o.name)
            for action in self._split(operator)
        )

    def partner(self, predicate: str) -> str:
        """The name of what is true where a predicate is false."""
        return self._helpers.partner[predicate]

    def domain(self) -> str:
        """The domain; it names the objects of the scene as constants."""
        parts = [
            "  (:requirements :strips :typing)",
            *self._type_section(),
            *block(":constants", (self._constant(item) for item in self.objects)),
            *block(":predicates", self._predicate_lines()),
            *(line for action in self.actions for line in self._action(action)),
        ]
        return f"(define (domain {self.names.domain})\n" + "\n".join(parts) + "\n)\n"

    def problem(self, true_atoms: Iterable[Atom], goal: Iterable[Literal]) -> str:
        """A problem of that domain.

        Args:
            true_atoms: the ground atoms that are true at the start; all others are false.
            goal: the ground literals to reach.
        """
        names, domain = self.names.objects, self.names.domain
        wanted = conjunction(self._literal(literal, names) for literal in sorted(goal))
        lines = [f"(define (problem {domain}-problem)", f"  (:domain {domain})", "  (:objects)"]
        lines += block(":init", self._facts(frozenset(true_atoms)))
        lines += block(":goal", [wanted])
        return "\n".join(lines) + "\n)\n"

    @cached_property
    def _types(self) -> PddlTypes:
        types = PddlTypes.of(self.model)
        for item in self.objects:
            types.check_object(item)
        return types

    @cached_property
    def _helpers(self) -> _Helpers:
        """Names beside those of the model."""
        own = self.names
        groups = (own.types, own.predicates, own.operators, own.objects)
        taken = {own.root, *itertools.chain.from_iterable(group.values() for group in groups)}
        return _Helpers(
            {p: unique_name(f"no_{safe}", taken) for p, safe in own.predicates.items()},
            unique_name("different", taken),
            {o: unique_name(f"is_{safe}", taken) for o, safe in own.objects.items()},
            taken,
        )

    @property
    def _root(self) -> str:
        """The type of everything; the ``pddl`` library refuses ``object``."""
        return self.names.root

    def _type_section(self) -> list[str]:
        lines = [f"{self._root} - object"]
        for name in self._types.tree:
            parent = self._types.parent(name)
            lines.append(f"{self.names.types[name]} - {self._type_name(parent)}")
        lines += (f"{leaf} - {self._type_name(name)}" for name, leaf in self._leaves.items())
        return block(":types", lines)

    @cached_property
    def _leaves(self) -> Mapping[str | None, str]:
        """Of every type with subtypes, and objects that are of none of these, a type for them."""
        above = {self._types.parent(name) for name in self._types.tree}
        own = dict.fromkeys(self._types.type_of(item.types) for item in self.objects)
        taken = self._helpers.taken
        return {t: unique_name(f"other_{self._type_name(t)}", taken) for t in own if t in above}

    def _constant(self, item: Object) -> str:
        own = self._types.type_of(item.types)
        leaf = self._leaves.get(own, self._type_name(own))
        return f"{self.names.objects[item.name]} - {leaf}"

    def _type_name(self, name: str | None) -> str:
        return self._root if name is None else self.names.types[name]

    def _typed(self, term: str, types: Iterable[str]) -> str:
        return f"{term} - {self._type_name(self._types.type_of(types))}"

    def _predicate_lines(self) -> Iterator[str]:
        for static in self._types.static:
            above = self.model.domain.types.ancestors[static] & set(self._types.tree)
            yield f"({self.names.types[static]} {self._typed('?any', above)})"
        for predicate in sorted(self.model.predicates):
            terms = [self._typed(f"?x{n}", [t]) for n, t in enumerate(predicate.types)]
            yield _call(self.names.predicates[predicate.name], terms) + comment(predicate.semantics)
            yield _call(self._helpers.partner[predicate.name], terms)
        yield f"({self._helpers.different} ?x0 - {self._root} ?x1 - {self._root})"
        for name in self._chosen:
            yield f"({self._helpers.being[name]} ?x0 - {self._root})"

    def _facts(self, true: frozenset[Atom]) -> Iterator[str]:
        names = self.names.objects
        yield from (f"({self._helpers.being[name]} {names[name]})" for name in self._chosen)
        for item in self.objects:
            for static in self._types.static:
                if static in item.types:
                    yield f"({self.names.types[static]} {names[item.name]})"
        for one, other in itertools.permutations(self.objects, 2):
            yield f"({self._helpers.different} {names[one.name]} {names[other.name]})"
        for predicate in sorted(self.model.predicates):
            for atom in self._groundings(predicate):
                yield self._literal(Literal(atom, atom in true), names)

    @cached_property
    def _chosen(self) -> tuple[str, ...]:
        """The objects that some action is limited to."""
        return tuple(sorted({name for a in self.actions for name in a.chosen.values()}))

    def _groundings(self, predicate: Predicate) -> Iterator[Atom]:
        """All atoms, also those that name an object twice, which are false."""
        fitting = ([o.name for o in self.objects if t in o.types] for t in predicate.types)
        return (Atom(predicate.name, terms) for terms in itertools.product(*fitting))

    def _split(self, operator: Operator) -> Iterator[PositiveAction]:
        """One action, or one for each choice of the objects that absences except."""
        parameters = {v.name: v for v in operator.parameters}
        excepted = [parameters[name] for name in sorted(self._excepted(operator))]
        fitting = [[o.name for o in self.objects if set(v.types) <= set(o.types)] for v in excepted]
        plain = self.names.operators[operator.name]
        choices = (c for c in itertools.product(*fitting) if len(set(c)) == len(c))
        for number, chosen in enumerate(choices):
            if number == _MOST_ACTIONS:
                raise SymbolError(
                    f"operator {operator.name}: for a planner without forall and disjunction it "
                    f"would become more than {_MOST_ACTIONS} actions; export it as pddl or up"
                )
            objects = [self.names.objects[name] for name in chosen]
            name = (
                unique_name("_".join([plain, *objects]), self._helpers.taken) if chosen else plain
            )
            named = dict(zip((v.name for v in excepted), chosen, strict=True))
            yield PositiveAction(name, operator, named)

    def _excepted(self, operator: Operator) -> set[str]:
        """The parameters that an absence excepts although they may stand in the relation."""
        found = set()
        for absence in operator.absences:
            for term, type_name in self._quantified(absence):
                for variable in operator.parameters:
                    if self._types.may_overlap([type_name], variable.types) and not (
                        _is_false_anyway(absence, term, variable, operator)
                    ):
                        found.add(variable.name)
        return found

    def _quantified(self, absence: Absence) -> list[tuple[str, str]]:
        """The quantified terms with their types."""
        types = self.model.predicate_by_name[absence.atom.predicate].types
        pairs = zip(absence.atom.terms, types, strict=True)
        return [(term, name) for term, name in pairs if term in absence.quantified]

    def _action(self, action: PositiveAction) -> list[str]:
        operator = action.operator
        names = variable_names(v.name for v in operator.parameters)
        parameters = [self._typed(names[v.name], v.types) for v in operator.parameters]
        lines = [f"  (:action {action.name}", f"    :parameters ({' '.join(parameters)})"]
        lines += clause(":precondition", dict.fromkeys(self._preconditions(action, names)))
        lines += clause(":effect", self._effects(operator, names))
        return [*lines, "  )"]

    def _preconditions(self, action: PositiveAction, names: Mapping[str, str]) -> Iterator[str]:
        operator = action.operator
        for parameter, chosen in action.chosen.items():
            yield f"({self._helpers.being[chosen]} {names[parameter]})"
        for variable in operator.parameters:
            for static in self._types.static_of(variable.types):
                yield f"({self.names.types[static]} {names[variable.name]})"
        for literal in sorted(operator.preconditions):
            yield self._literal(literal, names)
        for one, other in itertools.combinations(operator.parameters, 2):
            if self._types.may_overlap(one.types, other.types):
                yield f"({self._helpers.different} {names[one.name]} {names[other.name]})"
        for absence in sorted(operator.absences):
            yield from self._absence(absence, action, names)

    def _absence(
        self, absence: Absence, action: PositiveAction, names: Mapping[str, str]
    ) -> Iterator[str]:
        quantified = self._quantified(absence)
        fitting = [[o.name for o in self.objects if t in o.types] for _, t in quantified]
        for chosen in itertools.product(*fitting):
            if not set(chosen) & set(action.chosen.values()):
                objects = {
                    term: self.names.objects[name]
                    for (term, _), name in zip(quantified, chosen, strict=True)
                }
                yield self._literal(Literal(absence.atom, False), {**names, **objects})

    def _effects(self, operator: Operator, names: Mapping[str, str]) -> Iterator[str]:
        changed = [Literal(atom) for atom in sorted(operator.add_effects)]
        changed += [Literal(atom, False) for atom in sorted(operator.delete_effects)]
        for literal in changed:
            yield self._literal(literal, names)
            yield f"(not {self._literal(Literal(literal.atom, not literal.positive), names)})"

    def _literal(self, literal: Literal, names: Mapping[str, str]) -> str:
        predicate = literal.atom.predicate
        own = self.names.predicates if literal.positive else self._helpers.partner
        return _call(own[predicate], [names[term] for term in literal.atom.terms])


@dataclass(frozen=True)
class _Helpers:
    """Names of what the compilation adds.

    Attributes:
        partner: of each predicate the one that is true where it is false.
        different: that two objects are not the same.
        being: of each object the predicate that is true of it alone.
        taken: all names in use.
    """

    partner: Mapping[str, str]
    different: str
    being: Mapping[str, str]
    taken: set[str]


def _is_false_anyway(absence: Absence, term: str, variable: Variable, operator: Operator) -> bool:
    """Whether it is no exception that a parameter may stand in the relation: it never does."""
    if len(absence.quantified) > 1:
        return False
    atom = absence.atom.substitute({term: variable.name})
    twice = len(set(atom.terms)) < len(atom.terms)
    return twice or Literal(atom, False) in operator.preconditions


def _call(name: str, terms: Sequence[str]) -> str:
    return f"({' '.join([name, *terms])})"
