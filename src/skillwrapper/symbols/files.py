"""Models on disk: ``predicates.yaml`` for people, ``model.json`` complete and exact."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

import yaml
from pydantic import BaseModel, ConfigDict

from skillwrapper.errors import ConfigurationError, SymbolError, UnknownNameError, UserError
from skillwrapper.files.bounded import read_bounded
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, ConditionalEffect, Operator, Variable
from skillwrapper.symbols.predicates import Atom, Literal, Predicate
from skillwrapper.world.domain import Domain


class _Entry(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _PredicateEntry(_Entry):
    name: str
    types: list[str]
    semantics: str = ""


class _VariableEntry(_Entry):
    name: str
    types: list[str]


class _LiteralEntry(_Entry):
    atom: list[str]
    holds: bool


class _AbsenceEntry(_Entry):
    atom: list[str]
    quantified: list[str]


class _ConditionalEntry(_Entry):
    quantified: _VariableEntry
    condition: list[_LiteralEntry]
    effect: _LiteralEntry


class _OperatorEntry(_Entry):
    name: str
    skill: str
    parameters: list[_VariableEntry]
    arity: int
    preconditions: list[_LiteralEntry]
    absences: list[_AbsenceEntry]
    add_effects: list[list[str]]
    delete_effects: list[list[str]]
    conditional_effects: list[_ConditionalEntry]


class _PredicatesFile(_Entry):
    """The layout of ``predicates.yaml``."""

    predicates: list[_PredicateEntry]


class _ModelFile(_Entry):
    """The layout of ``model.json``."""

    domain: str
    predicates: list[_PredicateEntry]
    operators: list[_OperatorEntry]


def predicates_to_yaml(predicates: Iterable[Predicate]) -> str:
    """Predicates as YAML, in their order, their semantics on one line; equal ones, equal text."""
    entries = {"predicates": [_predicate_entry(p).model_dump() for p in predicates]}
    return yaml.safe_dump(entries, sort_keys=False, allow_unicode=True, width=88)


def read_predicates(path: Path, domain: Domain) -> tuple[Predicate, ...]:
    """Read predicates as ``predicates_to_yaml`` writes them, or a person.

    Raises:
        ConfigurationError: with file, line and what was expected.
        UnknownNameError: if a type is not one of the domain.
    """
    return tuple(predicate for predicate, _ in read_placed_predicates(path, domain))


def read_placed_predicates(path: Path, domain: Domain) -> tuple[tuple[Predicate, str], ...]:
    """The same, each with the file and line where it stands.

    Raises:
        ConfigurationError: as ``read_predicates``.
        UnknownNameError: if a type is not one of the domain.
    """
    document = YamlDocument.read(path)
    found = _predicates(document, document.validate(_PredicatesFile).predicates, domain)
    return tuple(
        (predicate, document.place(("predicates", number)))
        for number, predicate in enumerate(found)
    )


def model_to_json(model: AbstractModel) -> str:
    """The complete model but its domain, of which it holds the name; equal models, equal text."""
    entries = _ModelFile(
        domain=model.domain.name,
        predicates=[_predicate_entry(p) for p in model.predicates],
        operators=[_operator_entry(o) for o in model.operators],
    )
    return json.dumps(entries.model_dump(), indent=1, ensure_ascii=False) + "\n"


def read_model(path: Path, domain: Domain) -> AbstractModel:
    """Read a model as ``model_to_json`` writes it; the exact inverse.

    Raises:
        ConfigurationError: with file, line and what was expected; also for another domain.
        UnknownNameError: if a type, skill or predicate does not exist.
    """
    try:
        data = json.loads(read_bounded(path))
        return _model(YamlDocument(path, data, None), domain)
    except (OSError, ValueError, UserError):
        # JSON is YAML too, slow to read as such, but then a mistake has its line.
        return _model(YamlDocument.read(path), domain)


def _model(document: YamlDocument, domain: Domain) -> AbstractModel:
    entries = document.validate(_ModelFile)
    if entries.domain != domain.name:
        raise ConfigurationError(
            f"{document.place(('domain',))}: expected a model of the domain '{domain.name}', got "
            f"one of '{entries.domain}'; give the domain that it was learned in"
        )
    predicates = _predicates(document, entries.predicates, domain)
    arities = {p.name: p.arity for p in predicates}
    operators = []
    for number, entry in enumerate(entries.operators):
        where = f"{document.place(('operators', number))}: operator {entry.name}"
        _check_operator(entry, domain, arities, where)
        operators.append(_operator(entry, where))
    return AbstractModel(domain, predicates, tuple(operators))


def _predicates(
    document: YamlDocument, entries: list[_PredicateEntry], domain: Domain
) -> tuple[Predicate, ...]:
    found: dict[str, Predicate] = {}
    for number, entry in enumerate(entries):
        where = document.place(("predicates", number))
        for name in entry.types:
            if name not in domain.types.parents:
                raise UnknownNameError("type", name, domain.types.names, where)
        if entry.name in found:
            raise ConfigurationError(f"{where}: the predicate '{entry.name}' is defined twice")
        try:
            found[entry.name] = Predicate(entry.name, tuple(entry.types), entry.semantics)
        except SymbolError as error:
            raise ConfigurationError(f"{where}: {error}") from error
    return tuple(found.values())


def _check_operator(
    entry: _OperatorEntry, domain: Domain, arities: dict[str, int], where: str
) -> None:
    skill = domain.skill_by_name.get(entry.skill)
    if skill is None:
        raise UnknownNameError("skill", entry.skill, domain.skill_by_name, where)
    if not entry.arity == len(skill.parameters) <= len(entry.parameters):
        raise ConfigurationError(
            f"{where}: expected the {len(skill.parameters)} parameters of {skill.name} first, "
            f"got an arity of {entry.arity} and {len(entry.parameters)} parameters"
        )
    variables = [*entry.parameters, *(c.quantified for c in entry.conditional_effects)]
    for name in (name for variable in variables for name in variable.types):
        if name not in domain.types.parents:
            raise UnknownNameError("type", name, domain.types.names, where)
    for predicate, *terms in _all_atoms(entry, where):
        if predicate not in arities:
            raise UnknownNameError("predicate", predicate, arities, where)
        if len(terms) != arities[predicate]:
            raise ConfigurationError(
                f"{where}: expected {arities[predicate]} terms of {predicate}, got {len(terms)}"
            )


def _all_atoms(entry: _OperatorEntry, where: str) -> list[list[str]]:
    atoms = [literal.atom for literal in entry.preconditions]
    atoms += [absence.atom for absence in entry.absences]
    atoms += entry.add_effects + entry.delete_effects
    for effect in entry.conditional_effects:
        atoms += [literal.atom for literal in (*effect.condition, effect.effect)]
    if [] in atoms:
        raise ConfigurationError(f"{where}: expected a predicate's name and its terms, got []")
    return atoms


def _operator(entry: _OperatorEntry, where: str) -> Operator:
    try:
        return Operator(
            name=entry.name,
            skill=entry.skill,
            parameters=tuple(_variable(v) for v in entry.parameters),
            arity=entry.arity,
            preconditions=frozenset(_literal(e) for e in entry.preconditions),
            absences=frozenset(Absence(_atom(e.atom), tuple(e.quantified)) for e in entry.absences),
            add_effects=frozenset(_atom(e) for e in entry.add_effects),
            delete_effects=frozenset(_atom(e) for e in entry.delete_effects),
            conditional_effects=frozenset(_conditional(e) for e in entry.conditional_effects),
        )
    except SymbolError as error:
        raise ConfigurationError(f"{where}: {error}") from error


def _variable(entry: _VariableEntry) -> Variable:
    return Variable(entry.name, tuple(entry.types))


def _atom(entry: list[str]) -> Atom:
    return Atom(entry[0], tuple(entry[1:]))


def _literal(entry: _LiteralEntry) -> Literal:
    return Literal(_atom(entry.atom), entry.holds)


def _conditional(entry: _ConditionalEntry) -> ConditionalEffect:
    return ConditionalEffect(
        _variable(entry.quantified),
        tuple(_literal(e) for e in entry.condition),
        _literal(entry.effect),
    )


def _predicate_entry(predicate: Predicate) -> _PredicateEntry:
    return _PredicateEntry(
        name=predicate.name, types=list(predicate.types), semantics=predicate.semantics
    )


def _operator_entry(operator: Operator) -> _OperatorEntry:
    return _OperatorEntry(
        name=operator.name,
        skill=operator.skill,
        parameters=[_variable_entry(v) for v in operator.parameters],
        arity=operator.arity,
        preconditions=[_literal_entry(e) for e in sorted(operator.preconditions)],
        absences=[
            _AbsenceEntry(atom=_atom_entry(a.atom), quantified=list(a.quantified))
            for a in sorted(operator.absences)
        ],
        add_effects=[_atom_entry(a) for a in sorted(operator.add_effects)],
        delete_effects=[_atom_entry(a) for a in sorted(operator.delete_effects)],
        conditional_effects=[_conditional_entry(e) for e in sorted(operator.conditional_effects)],
    )


def _variable_entry(variable: Variable) -> _VariableEntry:
    return _VariableEntry(name=variable.name, types=list(variable.types))


def _atom_entry(atom: Atom) -> list[str]:
    return [atom.predicate, *atom.terms]


def _literal_entry(literal: Literal) -> _LiteralEntry:
    return _LiteralEntry(atom=_atom_entry(literal.atom), holds=literal.positive)


def _conditional_entry(effect: ConditionalEffect) -> _ConditionalEntry:
    return _ConditionalEntry(
        quantified=_variable_entry(effect.quantified),
        condition=[_literal_entry(e) for e in effect.condition],
        effect=_literal_entry(effect.effect),
    )
