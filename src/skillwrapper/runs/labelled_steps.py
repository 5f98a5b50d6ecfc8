"""Labels that datasets carry for every step: which skill was going on, and whether it succeeded."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from skillwrapper.errors import FileError, SymbolError
from skillwrapper.symbols.predicates import Atom, parse_atom


def segments(marks: Sequence[object]) -> Iterator[tuple[int, int]]:
    """Where equal marks in a row begin, and where the next ones do."""
    begin = 0
    for end in range(1, len(marks) + 1):
        if end == len(marks) or marks[end] != marks[begin]:
            yield begin, end
            begin = end


def label_text(label: Any) -> str:
    """A label as text."""
    return (label.decode("utf-8", "replace") if isinstance(label, bytes) else str(label)).strip()


def label_truth(value: Any, where: str) -> bool:
    """Whether a skill succeeded.

    Raises:
        FileError: if the label says neither.
    """
    known = {"true": True, "1": True, "false": False, "0": False}.get(label_text(value).lower())
    if known is None:
        got = label_text(value)[:60]
        raise FileError(f"{where}: expected success to be true or false, got '{got}'")
    return known


def called_skill(label: str, where: str) -> Atom:
    """The skill that a label names, with its arguments.

    Raises:
        FileError: if it names none.
    """
    try:
        return parse_atom(label)
    except SymbolError as error:
        message = f"{where}: expected a skill such as Pick(arm, cube), got '{label[:60]}'"
        raise FileError(message) from error
