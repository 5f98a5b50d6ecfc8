"""Traces as JSON lines: one transition a line, as ``learn-operators`` reads them elsewhere too."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from skillwrapper.action_models.partial_traces import (
    Attempt,
    Evidence,
    PartialState,
    TraceBuilder,
)
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import State, check_atoms, check_attempt, check_names
from skillwrapper.errors import ConfigurationError, SymbolError
from skillwrapper.files.json_documents import read_entries
from skillwrapper.symbols.predicates import parse_atom
from skillwrapper.transitions.entries import TransitionEntry

_EVEN = 0.5


def read_json_trace(path: Path, skeleton: DomainSkeleton) -> Iterator[Evidence]:
    """The steps of a file; empty lines do not count.

    Args:
        path: the file (docs/operators.md). Of an atom with a probability the likelier counts; of
            what a map does not name, or says null of, nothing is known.
        skeleton: the domain; PDDL does not tell capital letters from small ones.

    Raises:
        UserError: if the file or a line cannot be used; names file and line.
    """
    for where, entry in read_entries(path, TransitionEntry):
        arguments = tuple(name.lower() for name in entry.arguments)
        attempt = Attempt(entry.skill.lower(), arguments, entry.success, where)
        check_attempt(skeleton, attempt.action, attempt.arguments, where)
        before, after = _states(entry, where)
        for state in (before, after):
            check_atoms(skeleton, state.atoms, where)
        builder = TraceBuilder()
        builder.state(before)
        builder.attempt(attempt)
        yield from builder.state(after) or builder.end()


def _states(entry: TransitionEntry, where: str) -> tuple[PartialState, PartialState]:
    before = _state(entry.before, where)
    unchanged = not entry.success or entry.changed is False
    if entry.after is None and not unchanged:
        raise ConfigurationError(
            f"{where}: expected a value for 'after', got none; it can be left out only of "
            "failures, and if 'changed' is false"
        )
    return before, before if entry.after is None else _state(entry.after, where)


def _state(atoms: list[str] | Mapping[str, float | None], where: str) -> PartialState:
    if not isinstance(atoms, Mapping):
        return PartialState(_atoms(atoms, where), None)
    known = {atom: sure for atom, sure in atoms.items() if sure is not None}
    return PartialState(
        _atoms([atom for atom, sure in known.items() if sure > _EVEN], where),
        _atoms([atom for atom, sure in known.items() if sure < _EVEN], where),
    )


def _atoms(atoms: list[str], where: str) -> State:
    try:
        parsed = [parse_atom(atom.lower()) for atom in atoms]
    except SymbolError as error:
        raise ConfigurationError(f"{where}: {error}") from error
    for atom in parsed:
        check_names(atom.terms, where)
    return frozenset(" ".join((atom.predicate, *atom.terms)) for atom in parsed)
