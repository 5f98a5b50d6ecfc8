"""Steps: what traces consist of."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.errors import FileError, UnknownNameError

_NAME = re.compile(r"[^\s()?;]+")

State = frozenset[str]
"""The true ground atoms as words with one blank between them; all others are false."""


@dataclass(frozen=True)
class Step:
    """An action that was tried.

    Attributes:
        action: its name.
        arguments: names of the objects; one may occur twice.
        success: whether it was applicable.
        before: the state before.
        after: the state after.
        where: where it stands, for complaints.
    """

    action: str
    arguments: tuple[str, ...]
    success: bool
    before: State
    after: State
    where: str = ""


def check_attempt(
    skeleton: DomainSkeleton, name: str, arguments: tuple[str, ...], where: str
) -> None:
    """Raise ``UserError`` if a domain has no such action with so many names as arguments."""
    action = skeleton.actions.get(name)
    if action is None:
        raise UnknownNameError("action", name, skeleton.actions, where)
    if len(arguments) != len(action.parameters):
        raise FileError(
            f"{where}: expected {len(action.parameters)} arguments of '{name}', "
            f"got {len(arguments)}"
        )
    check_names(arguments, where)


def check_names(names: Iterable[str], where: str) -> None:
    """Raise ``UserError`` if something is no name of an object: empty, a variable, or several."""
    for name in names:
        if not _NAME.fullmatch(name):
            raise FileError(f"{where}: expected the name of an object, got '{name}'")


def check_atoms(skeleton: DomainSkeleton, state: State, where: str) -> None:
    """Raise ``UserError`` if a domain has not the predicate of an atom, or not with its arity."""
    for words in {(atom.split(" ", 1)[0], atom.count(" ")) for atom in state}:
        predicate = skeleton.predicates.get(words[0])
        if predicate is None:
            raise UnknownNameError("predicate", words[0], skeleton.predicates, where)
        if len(predicate.parameters) != words[1]:
            raise FileError(
                f"{where}: expected {len(predicate.parameters)} terms of '{words[0]}', "
                f"got {words[1]}"
            )
    variable = next((atom for atom in state if "?" in atom), None)
    if variable is not None:
        raise FileError(f"{where}: expected names of objects, got '{variable}'")
