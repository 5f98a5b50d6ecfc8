"""The certificate: Lemma 1 and Theorem 1, checked on the recorded data (D15)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.lifted_states import LiftedState, is_lifted_state_known, lifted_state
from skillwrapper.learning.no_ops import NoOps, find_no_ops, is_no_op, rows_that_tell
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.transitions.lifting import LiftedChange


@dataclass(frozen=True)
class Violation:
    """A transition that breaks a statement.

    Attributes:
        statement: ``"lemma1"`` or ``"theorem1"``.
        skill: name of the skill.
        transition: number of the transition in the data.
        partner: for Lemma 1, number of the other transition; else None.
        reason: which part of the statement, for people.
    """

    statement: str
    skill: str
    transition: int
    partner: int | None
    reason: str


@dataclass(frozen=True)
class LeftOut:
    """A success of which no operator was learned: it is taken for chance, or for a misreading.

    Attributes:
        skill: name of the skill.
        transition: number of the transition in the data.
        reason: why, for people.
    """

    skill: str
    transition: int
    reason: str


@dataclass(frozen=True)
class Certificate:
    """What was checked, and what was found.

    Attributes:
        transitions: number of transitions in the data.
        decided: transitions whose labels decide the statements.
        undecided: transitions that hang on an unknown label (D10).
        no_ops: successes that changed nothing (D7), exempt from comparing changes.
        violations: every violation.
        left_out: successes that the model overrules.
    """

    transitions: int
    decided: int
    undecided: int
    no_ops: int
    violations: tuple[Violation, ...]
    left_out: tuple[LeftOut, ...] = ()

    @property
    def explained(self) -> float | None:
        """The share of the decided transitions that break no statement; None if none is decided."""
        broken = {violation.transition for violation in self.violations}
        return 1 - len(broken) / self.decided if self.decided else None

    def count(self, statement: str) -> int:
        """Number of violations of ``"lemma1"`` or ``"theorem1"``."""
        return sum(v.statement == statement for v in self.violations)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            **asdict(self),
            "lemma1_violations": self.count("lemma1"),
            "theorem1_violations": self.count("theorem1"),
            "explained": self.explained,
        }


def certify(fit: Fit) -> Certificate:
    """Check Lemma 1 and Theorem 1 over all recorded transitions, skill by skill."""
    violations: list[Violation] = []
    total = undecided = no_ops = 0
    for name, skill_fit in fit.skills.items():
        still = find_no_ops(p.table for p in skill_fit.predictions)
        no_ops += sum(int(rows.sum()) for rows in still.values())
        violations += _check_lemma(name, skill_fit.predictions, still)
        for prediction in skill_fit.predictions:
            violations += _check_theorem(name, prediction, still)
            total += len(prediction.table)
            undecided += int(prediction.undecided.sum())
    left_out = tuple(_left_out(fit))
    return Certificate(total, total - undecided, undecided, no_ops, tuple(violations), left_out)


def _left_out(fit: Fit) -> Iterator[LeftOut]:
    """The successes of which no operator was learned, in order of skill and time."""
    for name, skill_fit in fit.skills.items():
        for cluster in skill_fit.left_out:
            changed = ", ".join(map(str, cluster.groups[0].changed)) or "nothing"
            reason = f"changed {changed}; nothing like it was seen otherwise, and wrong labels or "
            for number in sorted(cluster.ids):
                yield LeftOut(name, int(number), reason + "chance explain it better")


def _check_lemma(
    skill: str, predictions: Sequence[TablePrediction], no_ops: NoOps
) -> Iterator[Violation]:
    """No success and failure share a lifted start, or a lifted change."""
    starts: dict[LiftedState, int] = {}
    changes: dict[LiftedChange, int] = {}
    for prediction in predictions:
        for number, start in _lifted_starts(prediction, success=True):
            starts.setdefault(start, number)
        for number, change in _lifted_changes(prediction, no_ops, success=True):
            changes.setdefault(change, number)
    for prediction in predictions:
        for number, start in _lifted_starts(prediction, success=False):
            if start in starts:
                yield Violation("lemma1", skill, number, starts[start], "same lifted start")
        for number, change in _lifted_changes(prediction, no_ops, success=False):
            if change in changes:
                yield Violation("lemma1", skill, number, changes[change], "same lifted change")


def _lifted_starts(
    prediction: TablePrediction, *, success: bool
) -> Iterator[tuple[int, LiftedState]]:
    table = prediction.table
    remembered: dict[tuple[int, bytes], LiftedState | None] = {}
    for row in np.flatnonzero((table.success == success) & ~prediction.undecided):
        before = table.before[row]
        key = (int(table.which[row]), before.tobytes())
        if key not in remembered:
            instance = table.instances[table.which[row]]
            known = is_lifted_state_known(table.space, before, instance)
            remembered[key] = lifted_state(table.space, before, instance) if known else None
        start = remembered[key]
        if start is not None:
            yield int(table.ids[row]), start


def _lifted_changes(
    prediction: TablePrediction, no_ops: NoOps, *, success: bool
) -> Iterator[tuple[int, LiftedChange]]:
    table = prediction.table
    for group in table.successes if success else table.failures:
        for row in rows_that_tell(prediction, group, no_ops):
            yield int(table.ids[row]), group.lifting.change


def _check_theorem(skill: str, prediction: TablePrediction, no_ops: NoOps) -> Iterator[Violation]:
    """Each success has an applicable operator with its change; no failure has either."""
    table = prediction.table
    similar = _similar(prediction, no_ops)
    for row in np.flatnonzero(~prediction.undecided):
        number = int(table.ids[row])
        if table.success[row] and not prediction.accounted[row]:
            reason = "no applicable operator makes the change"
            yield Violation("theorem1", skill, number, None, reason)
        if not table.success[row] and prediction.executable[row] != FALSE:
            yield Violation("theorem1", skill, number, None, "an operator applies to a failure")
        elif not table.success[row] and similar[row]:
            reason = "an operator makes the change of a failure"
            yield Violation("theorem1", skill, number, None, reason)


def _similar(prediction: TablePrediction, no_ops: NoOps) -> NDArray[np.bool_]:
    """Whether some operator, applicable or not, would make the change of a transition (n,).

    Not counted are operators learned from no-ops (D7), and conditional effects that come to
    nothing because no object meets their condition.
    """
    similar = np.zeros(len(prediction.table), dtype=bool)
    for learned, found in zip(prediction.operators, prediction.applications, strict=True):
        if not is_no_op(learned.cluster, no_ops):
            rows = found.similar
            if learned.operator.conditional_effects:
                rows = rows[prediction.table.change[rows].any(axis=1)]
            similar[rows] = True
    return similar
