"""Labelled transitions from a file of JSON lines, one transition a line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import read_entries
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.entries import PlacedEntry, TransitionEntry, label_placed_entries
from skillwrapper.transitions.labelled import LabelledTransitions
from skillwrapper.world.domain import Domain


def read_transitions(
    path: Path, domain: Domain, predicates: Sequence[Predicate] | None = None
) -> LabelledTransitions:
    """Read transitions in order of time; empty lines do not count (docs/operators.md).

    Args:
        path: the file.
        domain: types, skills, and objects where the lines bring none of their own.
        predicates: the vocabulary; None to infer names and types from the atoms.

    Raises:
        UserError: if the file cannot be read or a line cannot be used; names file and line.
    """
    entries = [PlacedEntry(where, entry) for where, entry in read_entries(path, TransitionEntry)]
    if not entries:
        raise FileError(f"{path}: expected a transition a line, got none")
    return label_placed_entries(domain, entries, predicates)
