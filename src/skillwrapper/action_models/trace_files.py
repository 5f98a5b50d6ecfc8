"""Traces in parentheses: states and actions in turn, as planners' and learners' tools write them.

``(:trajectory (:state (on a b) ...) (:action (stack a b)) (:state ...) ...)`` is AMLGym's way.
Beside it are read ``(:init ...)`` for the first state, ``(operator: ...)`` for an action,
``(trajectory ...)`` and ``(:observation ...)`` for the whole, ``(:objects ...)``, negated atoms in
states, and numbers, of which nothing is learned. States may be missing between actions, and
``(:goal ...)`` may end a trace: of its last state so much is known.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from skillwrapper.action_models.partial_traces import (
    Attempt,
    Evidence,
    PartialState,
    TraceBuilder,
)
from skillwrapper.action_models.plan_files import Problem
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import State, Step, check_atoms, check_attempt
from skillwrapper.errors import FileError

_COMMENT = re.compile(r";[^\n]*")
_START = re.compile(r"\(\s*(?::?(?:trajectory|observation))?\s*(?=[(])")
_SECTION = re.compile(r"\(\s*(:state|:init|:goal|:objects|:action|operator:)(?=[\s()])")
_NEGATED = re.compile(r"\(\s*not\s*\(([^()]*)\)\s*\)")
_NUMBER = re.compile(r"\(\s*=\s*\([^()]*\)\s*[^()\s]+\s*\)")
_ATOM = re.compile(r"\(([^()]*)\)")
_ATOMS = re.compile(r"(?:\s*\([^()]*\))*\s*")
_AND = re.compile(r"\s*\(\s*and((?:\s*\([^()]*\))*)\s*\)\s*")
_ACTIONS = (":action", "operator:")


def parse_trace(
    text: str,
    name: str,
    skeleton: DomainSkeleton,
    *,
    failures: bool = False,
    partial: bool = False,
    problem: Problem | None = None,
) -> Iterator[Evidence]:
    """The steps of a trace, one after the other; where states are missing, traces without them.

    Args:
        text: the trace.
        name: of its file, for complaints.
        skeleton: the domain.
        failures: whether an action after which the state is the same has failed.
        partial: whether of a state ``(:state ...)`` only what it says is known: atoms are true,
            negated ones false. Otherwise all others are false. ``(:init ...)`` is always complete.
        problem: what the trace starts from and leads to, if it does not say so itself.

    Raises:
        UserError: if the text is no trace or does not fit the domain; names file and line.
    """
    return _Reader(skeleton, failures, partial, problem).read(text, name)


@dataclass(frozen=True)
class _Reader:
    """Reads one trace; see ``parse_trace``."""

    skeleton: DomainSkeleton
    failures: bool
    partial: bool
    problem: Problem | None
    builder: TraceBuilder = field(default_factory=TraceBuilder)

    def read(self, text: str, name: str) -> Iterator[Evidence]:
        for kind, content, where in _sections(_COMMENT.sub("", text.lower()), name):
            if kind in _ACTIONS:
                self.builder.attempt(self._attempt(content, where))
            elif kind != ":objects":
                yield from self._judged(self.builder.state(self._state(kind, content, where)))
        if self.builder.is_empty:
            raise FileError(f"{name}:1: expected states '(:state ...)', got none")
        if self.builder.waits and self.problem is not None and self.problem.goal.atoms:
            self.builder.state(self.problem.goal)
        if self.builder.waits:
            raise FileError(
                f"{name}: expected a state after the last action, '(:state ...)' or '(:goal ...)'"
            )
        yield from self.builder.end()

    def _attempt(self, content: str, where: str) -> Attempt:
        if self.builder.is_empty and self.problem is not None:
            self.builder.state(self.problem.start)
        if self.builder.is_empty:
            raise FileError(f"{where}: expected a state before the first action")
        if self.failures and (self.builder.waits or self.partial):
            raise FileError(
                f"{where}: expected a complete state before and after every action, as --failures "
                "compares them"
            )
        action, *arguments = _action(content, where)
        check_attempt(self.skeleton, action, tuple(arguments), where)
        return Attempt(action, tuple(arguments), where=where)

    def _state(self, kind: str, content: str, where: str) -> PartialState:
        if not self.builder.is_empty and not self.builder.waits:
            raise FileError(f"{where}: expected an action between two states")
        if kind == ":goal" and self.builder.is_empty:
            raise FileError(f"{where}: expected '(:init' or '(:state' first, got a goal")
        is_complete = kind == ":init" or (kind == ":state" and not self.partial)
        state = _state(content, where, is_complete=is_complete)
        check_atoms(self.skeleton, state.atoms, where)
        return state

    def _judged(self, evidence: Iterable[Evidence]) -> Iterator[Evidence]:
        """Evidence, with what failed marked."""
        for item in evidence:
            if self.failures and isinstance(item, Step) and item.before == item.after:
                yield replace(item, success=False)
            else:
                yield item


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
            f"{name}:1: expected a trace '(:trajectory (:state ...) (:action ...) (:state ...))'"
        )
    head = _SECTION.search(text, start.end())
    if head is None:
        raise FileError(f"{name}:1: expected states '(:state ...)', got none")
    if text[start.end() : head.start()].strip():
        raise FileError(f"{name}:1: expected '(:init' or '(:state' first")
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


def _state(content: str, where: str, *, is_complete: bool) -> PartialState:
    false: set[str] = set()
    if "=" in content:
        content = _NUMBER.sub("", content)
    if "not" in content:
        false = {" ".join(atom.split()) for atom in _NEGATED.findall(content)}
        content = _NEGATED.sub("", content)
    conjunction = _AND.fullmatch(content)
    if conjunction:
        content = conjunction[1]
    if not _ATOMS.fullmatch(content):
        raise FileError(f"{where}: expected atoms such as '(on a b)' in a state")
    true = frozenset(" ".join(atom.split()) for atom in _ATOM.findall(content))
    return PartialState(true, None if is_complete else frozenset(false))


def _action(content: str, where: str) -> tuple[str, ...]:
    inner = content.strip()
    if inner.startswith("(") and inner.endswith(")"):
        inner = inner[1:-1]
    words = inner.split()
    if not words or "(" in inner or ")" in inner:
        raise FileError(f"{where}: expected an action such as '(stack a b)'")
    return tuple(words)
