"""Plans: actions alone, as planners write them, and the problems that they solve.

``(sail b1 p home)``, with or without times (``0.00: (sail b1 p home) [1.00]``). A plan names no
state: what it starts from and leads to is in its problem.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.action_models.lisp import Form, read_form
from skillwrapper.action_models.partial_traces import UNKNOWN, Attempt, PartialState, PartialTrace
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import check_atoms, check_attempt
from skillwrapper.errors import FileError
from skillwrapper.files.json_documents import read_text

_COMMENT = re.compile(r";[^\n]*")
_ACTION = re.compile(
    r"\s*(?:\d+(?:\.\d+)?\s*:\s*)?"  # when it begins
    r"\(\s*([^\s():][^()]*)\)"
    r"(?:\s*\[[^\[\]()]*\])?\s*"  # how long it takes
)


@dataclass(frozen=True)
class Problem:
    """What plans start from and lead to.

    Attributes:
        start: the state before the first action.
        goal: what is known of the state after the last.
    """

    start: PartialState
    goal: PartialState


def read_problem(path: Path, skeleton: DomainSkeleton) -> Problem:
    """The first state of a PDDL problem, and the literals that its goal asks for.

    Args:
        path: the problem; what its goal asks for beside a conjunction of literals is not used.
        skeleton: the domain.

    Raises:
        UserError: if it cannot be read or does not fit the domain; names file and line.
    """
    form = read_form(read_text(path), str(path))
    parts = {part.head: part for part in form.forms}
    if form.head != "define" or ":init" not in parts:
        raise FileError(
            f"{form.where}: expected a PDDL problem, '(define (problem NAME) ... (:init ...) ...)'"
        )
    atoms = [f for f in parts[":init"].forms if f.head != "=" and not f.forms]
    start = frozenset(_atom(form, skeleton) for form in atoms)
    goal = _goal(parts[":goal"], skeleton) if ":goal" in parts else UNKNOWN
    return Problem(PartialState(start, None), goal)


def is_plan(text: str) -> bool:
    """Whether a text begins like a plan, not like a trace with states."""
    return _ACTION.match(_COMMENT.sub("", text)) is not None


def parse_plan(
    text: str, name: str, skeleton: DomainSkeleton, problem: Problem | None
) -> PartialTrace:
    """A plan with what its problem says of its first state and its last.

    Args:
        text: the plan; all its actions are taken to have worked.
        name: of its file, for complaints.
        skeleton: the domain.
        problem: the problem that it solves.

    Raises:
        UserError: if the text is no plan, does not fit the domain, or if nothing is known of any
            state after an action; names file and line.
    """
    if problem is None:
        raise FileError(
            f"{name}:1: of a plan without states nothing can be learned; expected the problem "
            "that it solves (--problem), or a trace that has some states, "
            "'(:trajectory (:init ...) (:action ...) (:action ...) (:state ...))'"
        )
    if not problem.goal.atoms:
        raise FileError(
            f"{name}:1: where only the first state is known, nothing shows what actions do; "
            "expected a problem whose goal is a conjunction of literals, or a trace with states"
        )
    attempts = tuple(_attempts(_COMMENT.sub("", text.lower()), name, skeleton))
    between = (UNKNOWN,) * (len(attempts) - 1)
    return PartialTrace(attempts, (problem.start, *between, problem.goal))


def _attempts(text: str, name: str, skeleton: DomainSkeleton) -> Iterator[Attempt]:
    end = 0
    while end < len(text):
        match = _ACTION.match(text, end)
        line = 1 + text.count("\n", 0, len(text) - len(text[end:].lstrip()))
        if match is None:
            raise FileError(f"{name}:{line}: expected an action such as '(stack a b)'")
        action, *arguments = match[1].split()
        check_attempt(skeleton, action, tuple(arguments), f"{name}:{line}")
        yield Attempt(action, tuple(arguments), where=f"{name}:{line}")
        end = match.end()


def _goal(form: Form, skeleton: DomainSkeleton) -> PartialState:
    found: dict[bool, set[str]] = {True: set(), False: set()}
    parts = [p for f in form.forms for p in (f.forms if f.head == "and" else [f])]
    for part in parts:
        negated = part.head == "not" and len(part.forms) == 1
        literal = part.forms[0] if negated else part
        if literal.head in skeleton.predicates and not literal.forms:
            found[not negated].add(_atom(literal, skeleton))
    return PartialState(frozenset(found[True]), frozenset(found[False]))


def _atom(form: Form, skeleton: DomainSkeleton) -> str:
    atom = " ".join(form.words)
    check_atoms(skeleton, frozenset({atom}), form.where)
    return atom
