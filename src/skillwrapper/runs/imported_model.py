"""An imported model: it stays in its place for as long as nothing recorded speaks against it.

What is learned from more episodes, or from corrected labels, does not take its place silently: the
imported operators are put to all that is recorded again, and it is said what came of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from skillwrapper.files.writing import write_atomically
from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import predict
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.explanation import placed_transitions
from skillwrapper.runs.objections import new_objections
from skillwrapper.runs.recollection import Recollection
from skillwrapper.symbols import AbstractModel, Operator
from skillwrapper.symbols.files import model_to_json, read_model
from skillwrapper.transitions.tables import SkillData
from skillwrapper.world.skills import Skill


@dataclass(frozen=True)
class Retaken:
    """What a run goes by where a model was imported.

    Attributes:
        fit: the imported operators on all that is recorded, or what is learned from it.
        against: why it is not the imported ones; empty if it is.
    """

    fit: Fit
    against: tuple[str, ...] = ()

    def __str__(self) -> str:
        if not self.against:
            return "operators are those that were imported; nothing recorded speaks against them"
        more = f" (and {len(self.against) - 1} more reasons)" if len(self.against) > 1 else ""
        return (
            f"operators are learned ones, not those that were imported: {self.against[0]}{more}; "
            "edit model/domain.pddl again and import it, or remove imported.json"
        )


def keep_imported(archive: RunArchive, fit: Fit) -> None:
    """Remember operators that were accepted, with the predicates that there were."""
    write_atomically(archive.layout.imported, model_to_json(fit.model))


def read_imported(archive: RunArchive) -> AbstractModel | None:
    """The model that was imported last; None if none was.

    Raises:
        UserError: if its file is damaged; names file and line.
    """
    path = archive.layout.imported
    return read_model(path, archive.domain()) if path.exists() else None


def retake(archive: RunArchive, known: Recollection) -> Retaken | None:
    """Put the imported operators to what is recorded by now; None if there are none.

    Predicates that have been renamed since are followed.

    Raises:
        UserError: if a file is damaged.
    """
    imported = read_imported(archive)
    if imported is None:
        return None
    learned = known.fit()
    now = {p.name: known.corrections.applied(p) for p in imported.predicates}
    names = {old: p.name for old, p in now.items() if p is not None and p in known.vocabulary}
    lost = sorted({n for o in imported.operators for n in o.predicates} - names.keys())
    if lost:
        return Retaken(learned, (f"the predicate '{lost[0]}' that they speak of is gone",))
    fit = fit_of(known, [operator.reworded(names) for operator in imported.operators])
    transitions = placed_transitions(known)
    against = [
        f"{objection.subject} {objection.kind} {transitions[objection.transition]}"
        for objection in new_objections(fit, learned)
    ]
    return Retaken(learned, tuple(against)) if against else Retaken(fit)


def imported_note(archive: RunArchive) -> str:
    """What became of the imported operators, for people; empty if there are none."""
    if not archive.layout.imported.exists():
        return ""
    return str(retake(archive, Recollection.of(archive)) or "")


def fit_of(known: Recollection, operators: Sequence[Operator]) -> Fit:
    """Given operators on all that is recorded, each with the successes that it explains."""
    least = known.settings.learning.least_confidence
    labelled = known.labeller.label(known.vocabulary).decided(least)

    def fit_skill(skill: Skill) -> SkillFit:
        data = labelled.of_skill(skill.name)
        own = [LearnedOperator(o, Cluster((), ())) for o in operators if o.skill == skill.name]
        learned = tuple(replace(o, cluster=_explained(o, data)) for o in own)
        return SkillFit(skill.name, learned, predict(data, learned))

    return Fit(labelled.domain, known.vocabulary, fit_skill)


def _explained(learned: LearnedOperator, data: SkillData) -> Cluster:
    """The successes whose change an operator makes."""
    groups = [
        group
        for prediction in predict(data, [learned])
        for group in prediction.table.successes
        if np.isin(group.rows, prediction.applications[0].accounted).all()
    ]
    return Cluster(groups[0].lifting.change if groups else (), tuple(groups))
