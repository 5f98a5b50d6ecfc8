"""The kinds of inconsistency between data and model, each with its witnesses.

Conditions 1 and 2 of the paper (Section 3.2), determinism (D5) and unexplained changes
(D1). An inconsistency names two transitions; many pairs of one cause count once (D8).
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from skillwrapper.grounding import TRUE, UNKNOWN
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.lifted_states import LiftedState, lifted_state
from skillwrapper.learning.no_ops import find_no_ops, rows_that_tell
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.symbols import Atom
from skillwrapper.transitions.lifting import LiftedChange
from skillwrapper.world.skills import SkillInstance

Witness = tuple[InconsistencyKind, str, int]
"""Kind, skill and the number of the transition that is wrong; comparable across vocabularies."""

_MOST_PARTNERS = 3

Identity = tuple[str, InconsistencyKind, LiftedState, LiftedChange]


@dataclass(frozen=True)
class Inconsistency:
    """Two transitions that the vocabulary cannot tell apart though it should.

    Attributes:
        kind: which of the four.
        skill: name of the skill.
        first: number of a transition; see ``InventionQuestion.first``.
        second: number of the other one; None for UNEXPLAINED and UNNOTICED.
        culprit: number of the transition that is wrong.
        identity: skill, kind and lifted states: equal for pairs of one cause.
        unexplained: for UNEXPLAINED the changed atoms connected to nothing.
        partners: numbers of the transitions that the culprit can be shown beside, the one that
            differs least first; for UNNOTICED those that can be shown in its place.
        wide: for UNNOTICED whether the change may be one of other objects than the arguments.
        since: for UNNOTICED the number of an earlier transition, if what was seen before that one
            is compared with what was seen after the culprit.
    """

    kind: InconsistencyKind
    skill: str
    first: int
    second: int | None
    culprit: int
    identity: Identity = field(repr=False)
    unexplained: tuple[Atom, ...] = ()
    partners: tuple[int, ...] = ()
    wide: bool = False
    since: int | None = None

    @property
    def witness(self) -> Witness:
        """What is compared when the vocabulary changes."""
        return (self.kind, self.skill, self.culprit)

    @property
    def pairs(self) -> tuple[Inconsistency, ...]:
        """The same with each of the partners, itself first."""
        others = (n for n in self.partners if n not in (self.first, self.second))
        return (self, *(self._beside(number) for number in others))

    def _beside(self, partner: int) -> Inconsistency:
        if self.second is None:
            return replace(self, first=partner, culprit=partner)
        if self.second == self.culprit:
            return replace(self, first=partner)
        return replace(self, second=partner)


@dataclass(frozen=True, eq=False)
class Misprediction:
    """A transition that is wrong, before it is said of which cause.

    Attributes:
        kind: which of the four.
        prediction: of the transition's table.
        row: its row there.
        change: the lifted change that the model takes for right.
        members: numbers of the transitions that made this change; empty for UNEXPLAINED.
        unexplained: for UNEXPLAINED the changed atoms connected to nothing.
    """

    kind: InconsistencyKind
    prediction: TablePrediction
    row: int
    change: LiftedChange
    members: Sequence[int]
    unexplained: tuple[Atom, ...] = ()

    @property
    def culprit(self) -> int:
        """The number of the transition."""
        return int(self.prediction.table.ids[self.row])


def find_mispredictions(predictions: Sequence[TablePrediction]) -> tuple[Misprediction, ...]:
    """All transitions of a skill that are wrong, once for every kind, by kind and table."""
    found = [
        *_preconditions(predictions),
        *_effects(predictions),
        *_determinism(predictions),
        *_unexplained(predictions),
    ]
    return tuple(found)


def describe_mispredictions(
    skill: str, predictions: Sequence[TablePrediction], found: Iterable[Misprediction]
) -> tuple[Inconsistency, ...]:
    """An inconsistency for each transition that is wrong."""
    partners = _Partners(predictions)
    return tuple(_describe(skill, one, partners) for one in found)


def find_unnoticed(skill: str, predictions: Sequence[TablePrediction]) -> Inconsistency | None:
    """That a skill works and no success of it changes any label (D26); None if one does."""
    tables = [prediction.table for prediction in predictions]
    if any((t.success & t.change.any(axis=1)).any() for t in tables):
        return None
    still = [t.ids[t.success & ~t.hanging & ~t.unchanged] for t in tables]
    numbers = tuple(sorted(int(number) for ids in still for number in ids))[:_MOST_PARTNERS]
    if not numbers:
        return None
    kind = InconsistencyKind.UNNOTICED
    return Inconsistency(
        kind,
        skill,
        first=numbers[0],
        second=None,
        culprit=numbers[0],
        identity=(skill, kind, (), ()),
        partners=numbers,
    )


def distinct_causes(found: Iterable[Inconsistency]) -> tuple[Inconsistency, ...]:
    """One inconsistency for each identity: the pair that differs least (first of its kind)."""
    chosen: dict[Identity, Inconsistency] = {}
    for one in found:
        chosen.setdefault(one.identity, one)
    return tuple(chosen.values())


class _Partners:
    """Finds the members of a cluster that differ least from a transition (D8)."""

    def __init__(self, predictions: Sequence[TablePrediction]) -> None:
        self._instance: dict[int, SkillInstance] = {}
        for prediction in predictions:
            table = prediction.table
            for number, which in zip(table.ids, table.which, strict=True):
                self._instance[int(number)] = table.instances[which]

    def nearest(self, members: Iterable[int], to: int) -> tuple[int, ...]:
        own = self._instance[to]

        def distance(number: int) -> tuple[bool, int, int]:
            return self._instance[number] != own, abs(number - to), number

        return tuple(heapq.nsmallest(_MOST_PARTNERS, members, key=distance))


def _describe(skill: str, found: Misprediction, partners: _Partners) -> Inconsistency:
    table, culprit = found.prediction.table, found.culprit
    instance = table.instances[table.which[found.row]]
    state = lifted_state(table.space, table.before[found.row], instance)
    nearest = partners.nearest(found.members, culprit)
    partner = nearest[0] if nearest else None
    failed = found.kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT)
    return Inconsistency(
        found.kind,
        skill,
        first=partner if failed and partner is not None else culprit,
        second=culprit if failed else partner,
        culprit=culprit,
        identity=(skill, found.kind, state, found.change),
        unexplained=found.unexplained,
        partners=nearest,
    )


def _preconditions(predictions: Sequence[TablePrediction]) -> Iterator[Misprediction]:
    """Condition 1: a failure that some operator calls applicable."""
    for prediction in predictions:
        blamed: dict[int, LearnedOperator] = {}
        for learned, found in zip(prediction.operators, prediction.applications, strict=True):
            for row in found.sure[~prediction.table.success[found.sure]]:
                blamed.setdefault(int(row), learned)
        yield from _blame(InconsistencyKind.PRECONDITION, prediction, blamed)


def _effects(predictions: Sequence[TablePrediction]) -> Iterator[Misprediction]:
    """Condition 2: a failure with the same lifted change as a success that changed something."""
    by_change = _changes_of_successes(predictions)
    for prediction in predictions:
        for group in prediction.table.failures:
            change = group.lifting.change
            for row in group.rows if change in by_change else ():
                kind = InconsistencyKind.EFFECT
                yield Misprediction(kind, prediction, int(row), change, by_change[change])


def _determinism(predictions: Sequence[TablePrediction]) -> Iterator[Misprediction]:
    """D5: a success for which an applicable operator predicts another change."""
    for prediction in predictions:
        blamed: dict[int, LearnedOperator] = {}
        for learned, found in zip(prediction.operators, prediction.applications, strict=True):
            for row in found.mispredicted:
                blamed.setdefault(int(row), learned)
        yield from _blame(InconsistencyKind.DETERMINISM, prediction, blamed)


def _blame(
    kind: InconsistencyKind, prediction: TablePrediction, blamed: Mapping[int, LearnedOperator]
) -> Iterator[Misprediction]:
    for row in sorted(blamed):
        cluster = blamed[row].cluster
        yield Misprediction(kind, prediction, row, cluster.change, cluster.ids)


def _unexplained(predictions: Sequence[TablePrediction]) -> Iterator[Misprediction]:
    """D1: a success that changed an atom connected to no argument, and no operator says so."""
    kind = InconsistencyKind.UNEXPLAINED
    for prediction in predictions:
        for group in prediction.table.successes:
            atoms = group.lifting.unexplained
            names = tuple(sorted({(False, a.predicate, ()) for a in atoms}))
            for row in group.rows[~prediction.accounted[group.rows]] if atoms else ():
                yield Misprediction(kind, prediction, int(row), names, (), atoms)


def _changes_of_successes(
    predictions: Sequence[TablePrediction],
) -> dict[LiftedChange, list[int]]:
    """The lifted changes that successes made, with the numbers of the transitions.

    Not those of the clusters: from these, conditional effects are left out (D5).
    """
    found: dict[LiftedChange, list[int]] = {}
    no_ops = find_no_ops(p.table for p in predictions)
    for prediction in predictions:
        for group in prediction.table.successes:
            visible = prediction.table.ids[rows_that_tell(prediction, group, no_ops)]
            if len(visible):
                found.setdefault(group.lifting.change, []).extend(map(int, visible))
    return found


def count_valid_executability(predictions: Sequence[TablePrediction]) -> tuple[int, int]:
    """(valid, decided) transitions: the prediction equals the outcome (D6)."""
    valid = decided = 0
    for prediction in predictions:
        executable = prediction.executable
        known = executable != UNKNOWN
        decided += int(known.sum())
        valid += int(((executable == TRUE) == prediction.table.success)[known].sum())
    return valid, decided


def count_valid_effects(predictions: Sequence[TablePrediction]) -> tuple[int, int]:
    """(valid, decided) transitions by their changes (D6).

    Valid is a success of which nothing is left unexplained, and a failure with the lifted change
    of no success.
    """
    changes = _changes_of_successes(predictions)
    valid = decided = 0
    for prediction in predictions:
        for group in prediction.table.successes:
            decided += len(group.rows)
            unexplained = bool(group.lifting.unexplained)
            valid += int(prediction.accounted[group.rows].sum()) if unexplained else len(group.rows)
        for group in prediction.table.failures:
            decided += len(group.rows)
            valid += 0 if group.lifting.change in changes else len(group.rows)
    return valid, decided
