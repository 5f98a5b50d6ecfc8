"""The four kinds of inconsistency between data and model, each with its witnesses.

Conditions 1 and 2 of the paper (Section 3.2), determinism (DESIGN.md D5) and unexplained changes
(D1). An inconsistency names two transitions; many pairs of one cause count once (D8).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.lifted_states import LiftedState, lifted_state
from skillwrapper.learning.lifting import LiftedChange
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction
from skillwrapper.symbols import TRUE, Atom
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
    skill: str, predictions: Sequence[TablePrediction], clusters: Sequence[Cluster]
) -> tuple[Inconsistency, ...]:
    """All inconsistencies of a skill, one for every transition that is wrong, in order of time."""
    partners = _Partners(predictions)
    found = [
        *_preconditions(skill, predictions, partners),
        *_effects(skill, predictions, clusters, partners),
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
        self._unchanged: set[int] = set()
        for prediction in predictions:
            table = prediction.table
            for number, which in zip(table.ids, table.which, strict=True):
                self._instance[int(number)] = table.instances[which]
            self._unchanged.update(int(i) for i in table.ids[table.unchanged])

    def nearest(self, cluster: Cluster, to: int, *, changed: bool = False) -> int | None:
        own = self._instance[to]
        members = [i for i in cluster.ids if not (changed and i in self._unchanged)]
        if not members:
            return None
        return min(members, key=lambda i: (self._instance[i] != own, abs(i - to), i))


def _preconditions(
    skill: str, predictions: Sequence[TablePrediction], partners: _Partners
) -> Iterator[Inconsistency]:
    """Condition 1: a failure that some operator calls applicable."""
    for prediction in predictions:
        table = prediction.table
        blamed: dict[int, LearnedOperator] = {}
        for found in prediction.applications:
            for row in found.rows[found.applicability == TRUE]:
                if not table.success[row]:
                    blamed.setdefault(int(row), found.learned)
        for row in sorted(blamed):
            culprit = int(table.ids[row])
            success = partners.nearest(blamed[row].cluster, culprit)
            identity = _identity(
                skill, InconsistencyKind.PRECONDITION, prediction, row, blamed[row].cluster.change
            )
            yield Inconsistency(
                InconsistencyKind.PRECONDITION, skill, success or 0, culprit, culprit, identity
            )


def _effects(
    skill: str,
    predictions: Sequence[TablePrediction],
    clusters: Sequence[Cluster],
    partners: _Partners,
) -> Iterator[Inconsistency]:
    """Condition 2: a failure with the same lifted change as a success that changed something."""
    by_change: dict[LiftedChange, Cluster] = {}
    for cluster in clusters:
        by_change.setdefault(cluster.change, cluster)
    kind = InconsistencyKind.EFFECT
    for prediction in predictions:
        table = prediction.table
        for group in prediction.groups:
            same = by_change.get(group.lifting.change)
            if table.success[group.rows[0]] or same is None:
                continue
            for row in group.rows:
                culprit = int(table.ids[row])
                success = partners.nearest(same, culprit, changed=True)
                if success is not None:
                    identity = _identity(skill, kind, prediction, int(row), same.change)
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
            other = partners.nearest(cluster, culprit)
            identity = _identity(skill, kind, prediction, row, cluster.change)
            yield Inconsistency(kind, skill, culprit, other, culprit, identity)


def _unexplained(skill: str, predictions: Sequence[TablePrediction]) -> Iterator[Inconsistency]:
    """D1: a success that changed an atom connected to no argument."""
    kind = InconsistencyKind.UNEXPLAINED
    for prediction in predictions:
        for group in prediction.groups:
            if not prediction.table.success[group.rows[0]] or not group.lifting.unexplained:
                continue
            names = tuple(sorted({(False, a.predicate, ()) for a in group.lifting.unexplained}))
            for row in group.rows:
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
        known = executable != -1
        decided += int(known.sum())
        valid += int(((executable == TRUE) == prediction.table.success)[known].sum())
    return valid, decided


def count_valid_effects(
    predictions: Sequence[TablePrediction], clusters: Sequence[Cluster]
) -> tuple[int, int]:
    """(valid, decided) transitions by their changes (DESIGN.md D6).

    Valid is a success with the lifted change of a success cluster and nothing left unexplained,
    and a failure with the lifted change of none.
    """
    changes = {cluster.change for cluster in clusters}
    valid = decided = 0
    for prediction in predictions:
        for group in prediction.groups:
            size = len(group.rows)
            decided += size
            explained = group.lifting.change in changes and not group.lifting.unexplained
            if bool(np.all(prediction.table.success[group.rows])):
                valid += size if explained else 0
            else:
                valid += size if group.lifting.change not in changes else 0
    return valid, decided
