"""Traces as JSON lines: one transition a line, as ``learn-operators`` reads them elsewhere too."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import State, Step, check_atoms, check_names, check_step
from skillwrapper.errors import ConfigurationError, SymbolError
from skillwrapper.files.json_documents import read_entries
from skillwrapper.symbols.predicates import parse_atom
from skillwrapper.transitions.entries import TransitionEntry

_SURE = 0.5


def read_json_trace(path: Path, skeleton: DomainSkeleton) -> Iterator[Step]:
    """The steps of a file; empty lines do not count.

    Args:
        path: the file (docs/operators.md); of an atom with a probability the likelier counts.
        skeleton: the domain; PDDL does not tell capital letters from small ones.

    Raises:
        UserError: if the file or a line cannot be used; names file and line.
    """
    for where, entry in read_entries(path, TransitionEntry):
        step = _step(entry, where)
        check_step(skeleton, step)
        for state in (step.before, step.after):
            check_atoms(skeleton, state, where)
        yield step


def _step(entry: TransitionEntry, where: str) -> Step:
    before = _state(entry.before, where)
    unchanged = not entry.success or entry.changed is False
    if entry.after is None and not unchanged:
        raise ConfigurationError(
            f"{where}: expected a value for 'after', got none; it can be left out only of "
            "failures, and if 'changed' is false"
        )
    after = before if entry.after is None else _state(entry.after, where)
    arguments = tuple(name.lower() for name in entry.arguments)
    return Step(entry.skill.lower(), arguments, entry.success, before, after, where)


def _state(atoms: list[str] | Mapping[str, float | None], where: str) -> State:
    if isinstance(atoms, Mapping):
        atoms = [atom for atom, sure in atoms.items() if sure is not None and sure > _SURE]
    try:
        parsed = [parse_atom(atom.lower()) for atom in atoms]
    except SymbolError as error:
        raise ConfigurationError(f"{where}: {error}") from error
    for atom in parsed:
        check_names(atom.terms, where)
    return frozenset(" ".join((atom.predicate, *atom.terms)) for atom in parsed)
