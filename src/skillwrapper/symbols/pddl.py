"""Printing a model as a lifted PDDL domain, for people and for planners that take one.

Only forms that Fast Downward, K*, the ``pddl`` library and unified-planning all accept are used.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, ConditionalEffect, Operator, Variable
from skillwrapper.symbols.pddl_layout import block, clause, comment, conjunction
from skillwrapper.symbols.pddl_names import PlannerNames, unique_name, variable_names
from skillwrapper.symbols.pddl_types import PddlTypes
from skillwrapper.symbols.predicates import Atom, Literal, Predicate
from skillwrapper.world.types import Object


def print_domain(model: AbstractModel) -> str:
    """The model as a PDDL domain; equal models give equal text."""
    return _Printer(model, PlannerNames.of(model), PddlTypes.of(model)).domain()


def print_problem(
    model: AbstractModel,
    objects: Iterable[Object],
    true_atoms: Iterable[Atom],
    goal: Iterable[Literal],
    *alternatives: Iterable[Literal],
) -> str:
    """A PDDL problem for the domain that ``print_domain`` prints.

    Args:
        model: the model.
        objects: the objects of the scene.
        true_atoms: the ground atoms that are true at the start; all others are false.
        goal: the ground literals to reach.
        alternatives: other sets of literals, each of which would do as well.

    Raises:
        SymbolError: if an object has types that no object of the domain has together.
    """
    scene = tuple(objects)
    printer = _Printer(model, PlannerNames.of(model, scene), PddlTypes.of(model))
    return printer.problem(scene, true_atoms, (goal, *alternatives))


@dataclass(frozen=True)
class _Printer:
    model: AbstractModel
    names: PlannerNames
    types: PddlTypes

    def domain(self) -> str:
        actions = [self._action(o) for o in sorted(self.model.operators, key=lambda o: o.name)]
        parts = [
            *(
                f" {comment(f'{kind} {learned} is written {safe}')}"
                for kind, learned, safe in self.names.altered
            ),
            f"  (:requirements {' '.join(self._requirements())})",
            *self._types(),
            *self._predicates(),
            *actions,
        ]
        return f"(define (domain {self.names.domain})\n" + "\n".join(parts) + "\n)\n"

    def problem(
        self,
        objects: tuple[Object, ...],
        true_atoms: Iterable[Atom],
        goals: Iterable[Iterable[Literal]],
    ) -> str:
        for item in objects:
            self.types.check_object(item)
        names = self.names.objects
        domain = self.names.domain
        facts = [self._atom(atom, names) for atom in sorted(true_atoms)]
        facts += [
            f"({self.names.types[static]} {names[o.name]})"
            for o in objects
            for static in self.types.static
            if static in o.types
        ]
        wanted = [conjunction(self._literal(x, names) for x in sorted(goal)) for goal in goals]
        lines = [f"(define (problem {domain}-problem)", f"  (:domain {domain})"]
        lines += block(":objects", [self._typed(names[o.name], o.types) for o in objects])
        lines += block(":init", facts)
        lines += block(":goal", wanted if len(wanted) == 1 else [f"(or {' '.join(wanted)})"])
        return "\n".join(lines) + "\n)\n"

    def _requirements(self) -> Iterator[str]:
        operators = self.model.operators
        quantified = any(o.absences for o in operators)
        conditional = any(o.conditional_effects for o in operators)
        yield ":strips"
        if self._is_typed:
            yield ":typing"
        yield ":negative-preconditions"
        yield ":equality"
        if quantified:
            yield ":disjunctive-preconditions"
            yield ":universal-preconditions"
        if conditional:
            yield ":conditional-effects"

    @property
    def _is_typed(self) -> bool:
        return bool(self.types.tree) or self.types.rooted

    def _types(self) -> Iterator[str]:
        if not self._is_typed:
            return
        yield "  (:types"
        top = self.names.root if self.types.rooted else "object"
        if self.types.rooted:
            yield f"    {top} - object"
        for name in self.types.tree:
            parent = self._type_name(self.types.parent(name), root=top)
            yield f"    {self.names.types[name]} - {parent}"
        yield "  )"

    def _typed(self, term: str, types: Iterable[str]) -> str:
        if not self._is_typed:
            return term
        return f"{term} - {self._type_name(self.types.type_of(types), root=self.names.root)}"

    def _type_name(self, name: str | None, root: str) -> str:
        return root if name is None else self.names.types[name]

    def _predicates(self) -> Iterator[str]:
        if not self.types.static and not self.model.predicates:
            return  # unified-planning takes no empty list
        yield "  (:predicates"
        for static in self.types.static:
            meaning = self.model.domain.types.descriptions.get(static, "")
            variable = self._typed("?any", self._above(static))
            yield f"    ({self.names.types[static]} {variable}){comment(meaning)}"
        for predicate in sorted(self.model.predicates):
            yield f"    {self._signature(predicate)}{comment(predicate.semantics)}"
        yield "  )"

    def _above(self, static: str) -> tuple[str, ...]:
        return tuple(self.model.domain.types.ancestors[static] & set(self.types.tree))

    def _signature(self, predicate: Predicate) -> str:
        taken: set[str] = set()
        parts = [self.names.predicates[predicate.name]]
        for type_name in predicate.types:
            parts.append(self._typed(f"?{unique_name(type_name, taken)}", [type_name]))
        return f"({' '.join(parts)})"

    def _action(self, operator: Operator) -> str:
        names = variable_names(v.name for v in operator.parameters)
        parameters = [self._typed(names[v.name], v.types) for v in operator.parameters]
        lines = [f"  (:action {self.names.operators[operator.name]}"]
        lines += [f"    :parameters ({' '.join(parameters)})"]
        lines += clause(":precondition", self._preconditions(operator, names))
        lines += clause(":effect", self._effects(operator, names))
        return "\n".join([*lines, "  )"])

    def _preconditions(self, operator: Operator, names: dict[str, str]) -> Iterator[str]:
        for variable in operator.parameters:
            for static in self.types.static_of(variable.types):
                yield f"({self.names.types[static]} {names[variable.name]})"
        for literal in sorted(operator.preconditions):
            yield self._literal(literal, names)
        for number, first in enumerate(operator.parameters):
            for second in operator.parameters[number + 1 :]:
                if self.types.may_overlap(first.types, second.types):
                    yield f"(not (= {names[first.name]} {names[second.name]}))"
        for absence in sorted(operator.absences):
            yield self._absence(absence, operator, names)

    def _effects(self, operator: Operator, names: dict[str, str]) -> Iterator[str]:
        for atom in sorted(operator.add_effects):
            yield self._atom(atom, names)
        for atom in sorted(operator.delete_effects):
            yield f"(not {self._atom(atom, names)})"
        for effect in sorted(operator.conditional_effects):
            yield self._conditional(effect, operator, names)

    def _absence(self, absence: Absence, operator: Operator, names: dict[str, str]) -> str:
        """``(forall (?o - t) (or (= ?o ?p) ... (not (on ?o ?item))))``."""
        types = dict(
            zip(
                absence.atom.terms,
                self.model.predicate_by_name[absence.atom.predicate].types,
                strict=True,
            )
        )
        extended = variable_names([*names, *absence.quantified])
        exceptions = []
        for term in absence.quantified:
            exceptions += self._same_as_one(
                extended[term], [types[term]], operator.parameters, names
            )
            for static in self.types.static_of([types[term]]):
                exceptions.append(f"(not ({self.names.types[static]} {extended[term]}))")
        atom = f"(not {self._atom(absence.atom, extended)})"
        body = f"(or {' '.join([*exceptions, atom])})" if exceptions else atom
        quantified = [self._typed(extended[t], [types[t]]) for t in absence.quantified]
        return f"(forall ({' '.join(quantified)}) {body})"

    def _conditional(
        self, effect: ConditionalEffect, operator: Operator, names: dict[str, str]
    ) -> str:
        """``(forall (?o - t) (when (and (not (= ?o ?p)) ...) (on ?o ?item)))``."""
        quantified = effect.quantified
        extended = variable_names([*names, quantified.name])
        term = extended[quantified.name]
        arguments = operator.parameters[: operator.arity]
        same = self._same_as_one(term, quantified.types, arguments, names)
        condition = [
            f"({self.names.types[s]} {term})" for s in self.types.static_of(quantified.types)
        ]
        condition += [f"(not {equal})" for equal in same]
        condition += [self._literal(literal, extended) for literal in effect.condition]
        changed = self._literal(effect.effect, extended)
        body = f"(when {conjunction(condition)} {changed})" if condition else changed
        return f"(forall ({self._typed(term, quantified.types)}) {body})"

    def _same_as_one(
        self, term: str, types: Iterable[str], parameters: Iterable[Variable], names: dict[str, str]
    ) -> list[str]:
        """Equalities with those of the parameters that can be the same object at all."""
        wanted = tuple(types)
        return [
            f"(= {term} {names[v.name]})"
            for v in parameters
            if self.types.may_overlap(wanted, v.types)
        ]

    def _literal(self, literal: Literal, names: dict[str, str]) -> str:
        atom = self._atom(literal.atom, names)
        return atom if literal.positive else f"(not {atom})"

    def _atom(self, atom: Atom, names: dict[str, str]) -> str:
        terms = (names[term] for term in atom.terms)
        return f"({' '.join([self.names.predicates[atom.predicate], *terms])})"
