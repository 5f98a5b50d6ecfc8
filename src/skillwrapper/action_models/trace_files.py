"""Traces in parentheses: states and actions in turn, as planners' and learners' tools write them.

``(:trajectory (:state (on a b) ...) (:action (stack a b)) (:state ...) ...)`` is AMLGym's way.
Beside it are read ``(:init ...)`` for the first state, ``(operator: ...)`` for an action,
``(trajectory ...)`` and ``(:observation ...)`` for the whole, ``(:objects ...)``, negated atoms in
states, which say nothing new, and numbers, of which nothing is learned.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import State, Step, check_atoms, check_step
from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import read_text

_COMMENT = re.compile(r";[^\n]*")
_START = re.compile(r"\(\s*(?::?(?:trajectory|observation))?\s*(?=[(])")
_SECTION = re.compile(r"\(\s*(:state|:init|:objects|:action|operator:)(?=[\s()])")
_NEGATED = re.compile(r"\(\s*not\s*\([^()]*\)\s*\)")
_NUMBER = re.compile(r"\(\s*=\s*\([^()]*\)\s*[^()\s]+\s*\)")
_ATOM = re.compile(r"\(([^()]*)\)")
_ATOMS = re.compile(r"(?:\s*\([^()]*\))*\s*")
_AND = re.compile(r"\s*\(\s*and((?:\s*\([^()]*\))*)\s*\)\s*")


def read_trace(path: Path, skeleton: DomainSkeleton, *, failures: bool = False) -> Iterator[Step]:
    """The steps of a trace, one after the other.

    Args:
        path: the file.
        skeleton: the domain.
        failures: whether an action after which the state is the same has failed.

    Raises:
        UserError: if the file cannot be read or does not fit the domain; names file and line.
    """
    return parse_trace(read_text(path), str(path), skeleton, failures=failures)


def parse_trace(
    text: str, name: str, skeleton: DomainSkeleton, *, failures: bool = False
) -> Iterator[Step]:
    """As ``read_trace``, from the text of a file of some name."""
    before: State | None = None
    action: tuple[str, ...] | None = None
    for kind, content, where in _sections(_COMMENT.sub("", text.lower()), name):
        if kind == ":objects":
            continue
        if kind in (":action", "operator:"):
            if before is None or action is not None:
                raise FileError(f"{where}: expected a state before every action")
            action = _action(content, where)
            continue
        state = _state(content, where)
        check_atoms(skeleton, state, where)
        if before is not None and action is None:
            raise FileError(f"{where}: expected an action between two states")
        if before is not None and action is not None:
            done = not failures or state != before
            step = Step(action[0], action[1:], done, before, state, where)
            check_step(skeleton, step)
            yield step
        before, action = state, None
    if before is None:
        raise FileError(f"{name}:1: expected states '(:state ...)', got none")
    if action is not None:
        raise FileError(f"{name}: expected a state after the last action")


def print_trace(steps: Sequence[Step]) -> str:
    """Steps as AMLGym writes a trace, each from where the one before ended; at least one."""
    parts = [_print_state(steps[0].before)]
    for step in steps:
        action = f"(:action ({' '.join((step.action, *step.arguments))}))"
        parts += [action, _print_state(step.after)]
    return "(:trajectory\n\n" + "\n\n".join(parts) + "\n\n)"


def _print_state(state: State) -> str:
    return f"(:state {' '.join(f'({atom})' for atom in sorted(state))})"


def _sections(text: str, name: str) -> Iterator[tuple[str, str, str]]:
    """Kind, content and place of all sections, in order."""
    start = _START.match(text, len(text) - len(text.lstrip()))
    if start is None:
        raise FileError(
            f"{name}:1: expected a trace '(:trajectory (:state ...) (:action ...) (:state ...))'; "
            "of a plan without states nothing can be learned"
        )
    head = _SECTION.search(text, start.end())
    if head is None:
        raise FileError(f"{name}:1: expected states '(:state ...)', got none")
    if text[start.end() : head.start()].strip():
        raise FileError(f"{name}:1: expected '(:state' or '(:init' first")
    line, counted = 1, 0
    while head is not None:
        following = _SECTION.search(text, head.end())
        end = len(text) if following is None else following.start()
        line, counted = line + text.count("\n", counted, head.start()), head.start()
        where = f"{name}:{line}"
        content = text[head.end() : end].rstrip()
        closing = 2 if following is None else 1
        for _ in range(closing):
            if not content.endswith(")"):
                raise FileError(f"{where}: expected {closing} ')' at the end of '{head[1]}'")
            content = content[:-1].rstrip()
        yield head[1], content, where
        head = following


def _state(content: str, where: str) -> State:
    conjunction = _AND.fullmatch(content)
    if conjunction:
        content = conjunction[1]
    if "=" in content:
        content = _NUMBER.sub("", content)
    if "not" in content:
        content = _NEGATED.sub("", content)
    if not _ATOMS.fullmatch(content):
        raise FileError(f"{where}: expected atoms such as '(on a b)' in a state")
    return frozenset(" ".join(atom.split()) for atom in _ATOM.findall(content))


def _action(content: str, where: str) -> tuple[str, ...]:
    inner = content.strip()
    if inner.startswith("(") and inner.endswith(")"):
        inner = inner[1:-1]
    words = inner.split()
    if not words or "(" in inner or ")" in inner:
        raise FileError(f"{where}: expected an action such as '(stack a b)'")
    return tuple(words)
