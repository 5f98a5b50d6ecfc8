"""Reading a domain of ours back that a person has edited: the inverse of ``print_domain``.

Types and predicates are those of the model; actions may be changed, left out, and added under names
that begin with that of a skill.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from skillwrapper.action_models.lisp import Form, read_form
from skillwrapper.action_models.skeleton_files import read_pairs
from skillwrapper.errors import FileError, SymbolError, UnknownNameError
from skillwrapper.files.json_documents import read_text
from skillwrapper.symbols import (
    Absence,
    AbstractModel,
    Atom,
    ConditionalEffect,
    Literal,
    Operator,
    Variable,
)
from skillwrapper.symbols.pddl import print_domain
from skillwrapper.symbols.pddl_names import PlannerNames, variable_names
from skillwrapper.world.skills import Skill

_KEPT = (":types", ":predicates")
_KEYS = (":parameters", ":precondition", ":effect")


@dataclass(frozen=True)
class EditedOperator:
    """An operator, and where it stands in the file."""

    operator: Operator
    where: str


def read_edited_domain(path: Path, model: AbstractModel) -> tuple[EditedOperator, ...]:
    """The operators of an edited ``domain.pddl``.

    Args:
        path: the file.
        model: the one that it was printed of.

    Raises:
        UserError: if it is not such a file; names file and line.
    """
    written = read_form(read_text(path), str(path))
    if written.head != "define":
        raise FileError(f"{written.where}: expected '(define (domain ...', got '{written.head}'")
    _check_kept(written, read_form(print_domain(model), "domain.pddl"))
    reader, found = _Reader.of(model), dict[str, EditedOperator]()
    for form in (form for form in written.forms if form.head == ":action"):
        edited = reader.action(form)
        if edited.operator.name in found:
            raise FileError(f"{form.where}: the action '{form.items[1]}' is defined twice")
        found[edited.operator.name] = edited
    return tuple(sorted(found.values(), key=lambda e: (e.operator.skill, e.operator.name)))


def _check_kept(written: Form, printed: Form) -> None:
    for head in _KEPT:
        now, before = (_section(form, head) for form in (written, printed))
        if str(now) != str(before):
            where = now.where if now else written.where
            raise FileError(
                f"{where}: expected {head} as they were; types are those of the domain, and "
                "predicates are edited in predicates.yaml"
            )


def _section(form: Form, head: str) -> Form | None:
    return next((part for part in form.forms if part.head == head), None)


@dataclass(frozen=True)
class _Reader:
    """Knows the names that a model has in PDDL."""

    model: AbstractModel
    root: str
    types: Mapping[str, str]
    predicates: Mapping[str, str]
    operators: Mapping[str, Operator]

    @classmethod
    def of(cls, model: AbstractModel) -> _Reader:
        names = PlannerNames.of(model)
        return cls(
            model,
            names.root,
            {safe: name for name, safe in names.types.items()},
            {safe: name for name, safe in names.predicates.items()},
            {names.operators[o.name]: o for o in model.operators},
        )

    def action(self, form: Form) -> EditedOperator:
        name, parts = _parts(form)
        known = self.operators.get(name)
        skill = self._skill(name, known, form)
        body = _Body(self, self._parameters(parts[":parameters"], skill, known))
        for part in _conjuncts(parts.get(":precondition")):
            body.condition(part)
        for part in _conjuncts(parts.get(":effect")):
            body.change(part)
        return EditedOperator(body.operator(name, skill, known, form), form.where)

    def _skill(self, name: str, known: Operator | None, form: Form) -> Skill:
        skills = self.model.domain.skill_by_name
        if known is not None:
            return skills[known.skill]
        fitting = [s for s in skills.values() if name.startswith(f"{s.name.lower()}_")]
        if not fitting:
            raise UnknownNameError("action", name, self.operators, form.where)
        return max(fitting, key=lambda skill: len(skill.name))

    def _parameters(self, form: Form, skill: Skill, known: Operator | None) -> dict[str, _Slot]:
        """By their names in the file; the learned names are kept where they are known."""
        own = variable_names(v.name for v in known.parameters) if known else {}
        learned = {safe: name for name, safe in own.items()}
        slots: dict[str, _Slot] = {}
        for name, types in read_pairs(form, form.items):
            if not name.startswith("?") or name in slots:
                raise FileError(f"{form.where}: expected different variables, got '{name}'")
            slots[name] = _Slot(learned.get(name, name), self.types_of(types, form))
        if len(slots) < len(skill.parameters):
            raise FileError(
                f"{form.where}: expected the {len(skill.parameters)} parameters of {skill.name} "
                f"first, got {len(slots)}"
            )
        return slots

    def types_of(self, types: Sequence[str], form: Form) -> list[str]:
        """The learned names of a type in the file; none for that of everything."""
        if len(types) != 1:
            raise FileError(f"{form.where}: expected one type after '-', got {' or '.join(types)}")
        if types[0] in (self.root, "object") and types[0] not in self.types:
            return []
        if types[0] not in self.types:
            raise UnknownNameError("type", types[0], self.types, form.where)
        return [self.types[types[0]]]

    def atom(self, form: Form, terms: Mapping[str, str]) -> Atom:
        """An atom over known terms."""
        name, *given = form.words or [""]
        if name not in self.predicates:
            raise UnknownNameError("predicate", name, self.predicates, form.where)
        predicate = self.model.predicate_by_name[self.predicates[name]]
        if len(given) != predicate.arity:
            raise FileError(
                f"{form.where}: expected {predicate.arity} terms as in {predicate.signature}, "
                f"got {len(given)} in {form}"
            )
        for term in given:
            if term not in terms:
                raise UnknownNameError("variable", term, terms, form.where)
        return Atom(predicate.name, tuple(terms[term] for term in given))


@dataclass
class _Slot:
    """A parameter: its learned name, and its types so far."""

    name: str
    types: list[str]


@dataclass
class _Body:
    """What an action needs and changes, as far as it is read."""

    reader: _Reader
    slots: dict[str, _Slot]
    preconditions: set[Literal] = field(default_factory=set)
    absences: set[Absence] = field(default_factory=set)
    effects: set[Literal] = field(default_factory=set)
    conditional: set[ConditionalEffect] = field(default_factory=set)

    @property
    def terms(self) -> dict[str, str]:
        return {name: slot.name for name, slot in self.slots.items()}

    def operator(self, name: str, skill: Skill, known: Operator | None, form: Form) -> Operator:
        hierarchy = self.reader.model.domain.types
        variables = []
        for slot in self.slots.values():
            closure = hierarchy.closure(slot.types)
            variables.append(Variable(slot.name, hierarchy.most_specific(closure)))
        for variable, parameter in zip(variables, skill.parameters, strict=False):
            if parameter.type not in hierarchy.closure(variable.types):
                raise FileError(
                    f"{form.where}: expected {variable.name} to be of the type {parameter.type} of "
                    f"{skill.name}, got {' and '.join(variable.types) or 'none'}"
                )
        try:
            return Operator(
                known.name if known else f"{skill.name}{name[len(skill.name) :]}",
                skill.name,
                tuple(variables),
                len(skill.parameters),
                frozenset(self.preconditions),
                frozenset(self.absences),
                frozenset(x.atom for x in self.effects if x.positive),
                frozenset(x.atom for x in self.effects if not x.positive),
                frozenset(self.conditional),
            )
        except SymbolError as error:
            raise FileError(f"{form.where}: {error}") from error

    def condition(self, form: Form) -> None:
        """Take a part of the precondition."""
        if form.head == "forall":
            self.absences.add(self._absence(form))
        elif not self._is_type(form, self.slots) and not _is_difference(form):
            self.preconditions.add(self._literal(form, self.terms))

    def change(self, form: Form) -> None:
        """Take a part of the effect."""
        if form.head == "forall":
            self.conditional.add(self._conditional(form))
        else:
            self.effects.add(self._literal(form, self.terms))

    def _literal(self, form: Form, terms: Mapping[str, str]) -> Literal:
        if form.head == "not" and len(form.items) == 2 and form.forms:
            return Literal(self.reader.atom(form.forms[0], terms), False)
        return Literal(self.reader.atom(form, terms))

    def _is_type(self, form: Form, slots: Mapping[str, _Slot]) -> bool:
        """Whether it asks for a type that is written as a predicate; it is noted."""
        if form.head not in self.reader.types:
            return False
        if len(form.items) != 2 or form.items[1] not in slots:
            raise FileError(f"{form.where}: expected a type of one variable, got {form}")
        slots[str(form.items[1])].types.append(self.reader.types[form.head])
        return True

    def _quantified(self, form: Form) -> tuple[dict[str, _Slot], Form]:
        """The variables of a ``forall``, and what it says of them."""
        if len(form.items) != 3 or len(form.forms) != 2:
            raise FileError(f"{form.where}: expected (forall (?x - type) ...), got {form}")
        variables, body = form.forms
        slots = {
            name: _Slot(name, self.reader.types_of(types, variables))
            for name, types in read_pairs(variables, variables.items)
        }
        if set(slots) & set(self.slots):
            raise FileError(f"{variables.where}: expected variables that are no parameters")
        return slots, body

    def _absence(self, form: Form) -> Absence:
        slots, body = self._quantified(form)
        parts = body.forms if body.head == "or" else [body]
        told = [p for p in parts if p.head != "=" and not self._excepts_type(p, slots)]
        terms = self.terms | {name: name for name in slots}
        if len(told) == 1 and told[0].head == "not":
            literal = self._literal(told[0], terms)
            if set(slots) <= set(literal.atom.terms):
                return Absence(literal.atom, tuple(slots))
        raise FileError(
            f"{form.where}: expected that no other object is in a relation, as in (forall (?x - "
            f"type) (or (= ?x ?parameter) (not (on ?x ?parameter)))), got {form}"
        )

    def _excepts_type(self, form: Form, slots: Mapping[str, _Slot]) -> bool:
        inner = form.forms[0] if form.head == "not" and form.forms else form
        return form.head == "not" and self._is_type(inner, slots)

    def _conditional(self, form: Form) -> ConditionalEffect:
        slots, body = self._quantified(form)
        if len(slots) != 1:
            raise FileError(f"{form.where}: expected one variable, got {len(slots)}")
        conditions: list[Form] = []
        if body.head == "when":
            if len(body.forms) != 2:
                raise FileError(f"{body.where}: expected (when CONDITION EFFECT), got {body}")
            conditions, body = _conjuncts(body.forms[0]), body.forms[1]
        terms = self.terms | {name: name for name in slots}
        literals = tuple(
            self._literal(part, terms)
            for part in conditions
            if not _is_difference(part) and not self._is_type(part, slots)
        )
        (slot,) = slots.values()
        hierarchy = self.reader.model.domain.types
        types = hierarchy.most_specific(hierarchy.closure(slot.types))
        return ConditionalEffect(Variable(slot.name, types), literals, self._literal(body, terms))


def _parts(form: Form) -> tuple[str, dict[str, Form]]:
    """The name of an action, and its parts by their keys."""
    items = form.items[1:]
    if len(items) % 2 == 0 or not isinstance(items[0], str):
        raise FileError(f"{form.where}: expected (:action NAME :parameters (...) ...)")
    parts: dict[str, Form] = {}
    for key, value in _pairs(items[1:]):
        if key not in _KEYS or key in parts or not isinstance(value, Form):
            raise FileError(f"{form.where}: expected each of {', '.join(_KEYS)} once, got '{key}'")
        parts[str(key)] = value
    if ":parameters" not in parts:
        raise FileError(f"{form.where}: expected :parameters, got none")
    return items[0], parts


def _pairs(items: Sequence[str | Form]) -> Iterator[tuple[str | Form, str | Form]]:
    return zip(items[::2], items[1::2], strict=True)


def _conjuncts(form: Form | None) -> list[Form]:
    """The parts of a conjunction; none for nothing."""
    if form is None or not form.items:
        return []
    if form.head != "and":
        return [form]
    if len(form.forms) != len(form.items) - 1:
        raise FileError(f"{form.where}: expected conditions after 'and', got a word")
    return form.forms


def _is_difference(form: Form) -> bool:
    """``(not (= ?a ?b))``: different parameters are different objects anyway (D4)."""
    return form.head == "not" and len(form.forms) == 1 and form.forms[0].head == "="
