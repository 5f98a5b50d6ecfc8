"""The four kinds of inconsistency between data and model, each with its witnesses.

Conditions 1 and 2 of the paper (Section 3.2), determinism (DESIGN.md D5) and unexplained changes
(D1). An inconsistency names two transitions; many pairs of one cause count once (D8).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.lifted_states import LiftedState, lifted_state
from skillwrapper.learning.lifting import LiftedChange
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.symbols import TRUE, UNKNOWN, Atom
from skillwrapper.world.skills import SkillInstance

Witness = tuple[InconsistencyKind, str, int]
"""Kind, skill and the number of the transition that is wrong; comparable across vocabularies."""

Identity = tuple[str, InconsistencyKind, LiftedState, LiftedChange]


@dataclass(frozen=True)
class Inconsistency:
    """Two transitions that the vocabulary cannot tell apart though it should.

    Attributes:
        kind: which of the four.
        skill: name of the skill.
        first: number of a transition; see ``InventionQuestion.first``.
        second: number of the other one; None for UNEXPLAINED.
        culprit: number of the transition that is wrong.
        identity: skill, kind and lifted states: equal for pairs of one cause.
        unexplained: for UNEXPLAINED the changed atoms connected to nothing.
    """

    kind: InconsistencyKind
    skill: str
    first: int
    second: int | None
    culprit: int
    identity: Identity = field(repr=False)
    unexplained: tuple[Atom, ...] = ()

    @property
    def witness(self) -> Witness:
        """What is compared when the vocabulary changes."""
        return (self.kind, self.skill, self.culprit)


def find_inconsistencies(
    skill: str, predictions: Sequence[TablePrediction]
) -> tuple[Inconsistency, ...]:
    """All inconsistencies of a skill, one for every transition that is wrong, by kind and table."""
    partners = _Partners(predictions)
    found = [
        *_preconditions(skill, predictions, partners),
        *_effects(skill, predictions, partners),
        *_determinism(skill, predictions, partners),
        *_unexplained(skill, predictions),
    ]
    return tuple(found)


def distinct_causes(found: Iterable[Inconsistency]) -> tuple[Inconsistency, ...]:
    """One inconsistency for each identity: the pair that differs least (first of its kind)."""
    chosen: dict[Identity, Inconsistency] = {}
    for one in found:
        chosen.setdefault(one.identity, one)
    return tuple(chosen.values())


class _Partners:
    """Finds the member of a cluster that differs least from a transition (DESIGN.md D8)."""

    def __init__(self, predictions: Sequence[TablePrediction]) -> None:
        self._instance: dict[int, SkillInstance] = {}
        for prediction in predictions:
            table = prediction.table
            for number, which in zip(table.ids, table.which, strict=True):
                self._instance[int(number)] = table.instances[which]

    def nearest(self, members: Iterable[int], to: int) -> int:
        own = self._instance[to]
        return min(members, key=lambda i: (self._instance[i] != own, abs(i - to), i))


def _preconditions(
    skill: str, predictions: Sequence[TablePrediction], partners: _Partners
) -> Iterator[Inconsistency]:
    """Condition 1: a failure that some operator calls applicable."""
    kind = InconsistencyKind.PRECONDITION
    for prediction in predictions:
        table = prediction.table
        blamed: dict[int, LearnedOperator] = {}
        for found in prediction.applications:
            for row in found.rows[found.applicability == TRUE]:
                if not table.success[row]:
                    blamed.setdefault(int(row), found.learned)
        for row in sorted(blamed):
            culprit = int(table.ids[row])
            cluster = blamed[row].cluster
            success = partners.nearest(cluster.ids, culprit)
            identity = _identity(skill, kind, prediction, row, cluster.change)
            yield Inconsistency(kind, skill, success, culprit, culprit, identity)


def _effects(
    skill: str, predictions: Sequence[TablePrediction], partners: _Partners
) -> Iterator[Inconsistency]:
    """Condition 2: a failure with the same lifted change as a success that changed something."""
    kind = InconsistencyKind.EFFECT
    by_change = _changes_of_successes(predictions)
    for prediction in predictions:
        for group in prediction.failures:
            change = group.lifting.change
            for row in group.rows if change in by_change else ():
                culprit = int(prediction.table.ids[row])
                identity = _identity(skill, kind, prediction, int(row), change)
                success = partners.nearest(by_change[change], culprit)
                yield Inconsistency(kind, skill, success, culprit, culprit, identity)


def _determinism(
    skill: str, predictions: Sequence[TablePrediction], partners: _Partners
) -> Iterator[Inconsistency]:
    """D5: a success for which an applicable operator predicts another change."""
    kind = InconsistencyKind.DETERMINISM
    for prediction in predictions:
        blamed: dict[int, LearnedOperator] = {}
        for found in prediction.applications:
            for row in prediction.mispredicted(found):
                blamed.setdefault(int(row), found.learned)
        for row in sorted(blamed):
            culprit = int(prediction.table.ids[row])
            cluster = blamed[row].cluster
            other = partners.nearest(cluster.ids, culprit)
            identity = _identity(skill, kind, prediction, row, cluster.change)
            yield Inconsistency(kind, skill, culprit, other, culprit, identity)


def _unexplained(skill: str, predictions: Sequence[TablePrediction]) -> Iterator[Inconsistency]:
    """D1: a success that changed an atom connected to no argument, and no operator says so."""
    kind = InconsistencyKind.UNEXPLAINED
    for prediction in predictions:
        for group in prediction.successes:
            if not group.lifting.unexplained:
                continue
            names = tuple(sorted({(False, a.predicate, ()) for a in group.lifting.unexplained}))
            for row in group.rows[~prediction.accounted[group.rows]]:
                culprit = int(prediction.table.ids[row])
                yield Inconsistency(
                    kind,
                    skill,
                    culprit,
                    None,
                    culprit,
                    _identity(skill, kind, prediction, int(row), names),
                    group.lifting.unexplained,
                )


def _changes_of_successes(
    predictions: Sequence[TablePrediction],
) -> dict[LiftedChange, list[int]]:
    """The lifted changes that successes made, with the numbers of the transitions.

    Not those of the clusters: from these, conditional effects are left out (D5). A success that
    changed nothing visible does not count (D7).
    """
    found: dict[LiftedChange, list[int]] = {}
    for prediction in predictions:
        table = prediction.table
        for group in prediction.successes:
            visible = table.ids[group.rows[~table.unchanged[group.rows]]]
            if len(visible):
                found.setdefault(group.lifting.change, []).extend(map(int, visible))
    return found


def _identity(
    skill: str,
    kind: InconsistencyKind,
    prediction: TablePrediction,
    row: int,
    change: LiftedChange,
) -> Identity:
    table = prediction.table
    instance = table.instances[table.which[row]]
    return (skill, kind, lifted_state(table.space, table.before[row], instance), change)


def count_valid_executability(predictions: Sequence[TablePrediction]) -> tuple[int, int]:
    """(valid, decided) transitions: the prediction equals the outcome (DESIGN.md D6)."""
    valid = decided = 0
    for prediction in predictions:
        executable = prediction.executable
        known = executable != UNKNOWN
        decided += int(known.sum())
        valid += int(((executable == TRUE) == prediction.table.success)[known].sum())
    return valid, decided


def count_valid_effects(predictions: Sequence[TablePrediction]) -> tuple[int, int]:
    """(valid, decided) transitions by their changes (DESIGN.md D6).

    Valid is a success of which nothing is left unexplained, and a failure with the lifted change
    of no success.
    """
    changes = _changes_of_successes(predictions)
    valid = decided = 0
    for prediction in predictions:
        for group in prediction.successes:
            decided += len(group.rows)
            unexplained = bool(group.lifting.unexplained)
            valid += int(prediction.accounted[group.rows].sum()) if unexplained else len(group.rows)
        for group in prediction.failures:
            decided += len(group.rows)
            valid += 0 if group.lifting.change in changes else len(group.rows)
    return valid, decided
