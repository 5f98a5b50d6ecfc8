"""Taking a model into a run that a person has edited, if all that is recorded agrees with it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from skillwrapper.errors import RefusedModelError
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.clusters import Cluster
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.learner import make_learner
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import TablePrediction, predict
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.records import CorrectionRecord, Rejection, Rewording
from skillwrapper.runs.edited_domain import EditedOperator, read_edited_domain
from skillwrapper.runs.explanation import placed_transitions
from skillwrapper.runs.recollection import Recollection
from skillwrapper.runs.relearning import relearn, write_fit
from skillwrapper.symbols import Predicate
from skillwrapper.symbols.files import read_predicates
from skillwrapper.transitions.tables import SkillData
from skillwrapper.world.skills import Skill


def import_model(archive: RunArchive, path: Path) -> Fit:
    """Take an edited ``domain.pddl`` or ``predicates.yaml`` into a run, wholly or not at all.

    Args:
        archive: of a run that nobody else works in.
        path: the file; a name that ends with ``.pddl`` says that it is a domain.

    Returns:
        What the run has learned now.

    Raises:
        RefusedModelError: if a recorded transition speaks against it that did not speak against
            the model before; with every reason.
        UserError: if the file is not what it should be, no iteration is finished, or a file of the
            run is damaged. The run is as it was then.
    """
    if path.suffix.lower() == ".pddl":
        return _import_domain(archive, path)
    return _import_predicates(archive, path)


def _import_domain(archive: RunArchive, path: Path) -> Fit:
    known = Recollection.of(archive)
    edited = read_edited_domain(path, known.latest.model)
    fit = _fit_of(known, edited)
    before = {(o.kind, o.transition) for o in _objections(known.fit())}
    places = {one.operator.name: one.where for one in edited}
    transitions = placed_transitions(known)
    reasons = []
    for objection in _objections(fit):
        if (objection.kind, objection.transition) not in before:
            names = objection.operators or [
                o.operator.name for o in fit.skill(objection.skill).operators
            ]
            where = next((places[name] for name in names), f"{path}:1")
            who = names[0] if names else objection.skill
            reasons.append(f"{where}: {who} {objection.kind} {transitions[objection.transition]}")
    if reasons:
        raise RefusedModelError(path, reasons)
    write_fit(archive, known, fit)
    return fit


def _import_predicates(archive: RunArchive, path: Path) -> Fit:
    known = Recollection.of(archive)
    wanted = read_predicates(path, archive.domain())
    corrections = tuple(_corrections(known.vocabulary, wanted, path))
    names = {p.name for p in wanted}
    kept = [p for p in known.vocabulary if p.name in names]
    before = {(o.kind, o.transition) for o in _objections(known.fit())}
    fit = Fitter(known.labeller, make_learner(known.settings.learning)).fit(kept)
    transitions = placed_transitions(known)
    reasons = [
        f"{path}: without what was left out, {o.skill} {o.kind} {transitions[o.transition]}"
        for o in _objections(fit)
        if (o.kind, o.transition) not in before
    ]
    if reasons:
        raise RefusedModelError(path, reasons)
    for correction in corrections:
        archive.correct(correction)
    return relearn(archive).fit


def _corrections(
    vocabulary: Sequence[Predicate], wanted: Sequence[Predicate], path: Path
) -> Iterator[CorrectionRecord]:
    """What makes the wanted predicates out of those that there are."""
    present = {p.name: p for p in vocabulary}
    for predicate in wanted:
        had = present.pop(predicate.name, None)
        if had is None or had.types != predicate.types:
            reason = (
                f"{path}: '{predicate.signature}' was never read off a picture; learn with it: "
                "skillwrapper learn DOMAIN --predicates FILE"
            )
            raise RefusedModelError(path, [reason])
        if had.semantics != predicate.semantics:
            yield CorrectionRecord(
                Rewording(
                    predicate=had.name, types=had.types, semantics=predicate.semantics or had.name
                )
            )
    yield from (CorrectionRecord(Rejection(predicate=name)) for name in present)


def _fit_of(known: Recollection, edited: Sequence[EditedOperator]) -> Fit:
    """The edited operators on all that is recorded, each with the successes that it explains."""
    least = known.settings.learning.least_confidence
    labelled = known.labeller.label(known.vocabulary).decided(least)

    def fit_skill(skill: Skill) -> SkillFit:
        data = labelled.of_skill(skill.name)
        own = [LearnedOperator(e.operator, Cluster((), ())) for e in edited if _is_of(e, skill)]
        learned = tuple(replace(o, cluster=_explained(o, data)) for o in own)
        return SkillFit(skill.name, learned, predict(data, learned))

    return Fit(labelled.domain, known.vocabulary, fit_skill)


def _is_of(edited: EditedOperator, skill: Skill) -> bool:
    return edited.operator.skill == skill.name


def _explained(learned: LearnedOperator, data: SkillData) -> Cluster:
    """The successes whose change an operator makes."""
    groups = [
        group
        for prediction in predict(data, [learned])
        for group in prediction.table.successes
        if np.isin(group.rows, prediction.applications[0].accounted).all()
    ]
    return Cluster(groups[0].lifting.change if groups else (), tuple(groups))


@dataclass(frozen=True)
class _Objection:
    """A transition that speaks against operators.

    Attributes:
        skill: that was run.
        kind: what is wrong, as the middle of a sentence.
        transition: its number.
        operators: the names of those that are wrong; none if it takes one that is not there.
    """

    skill: str
    kind: str
    transition: int
    operators: list[str]


def _objections(fit: Fit) -> Iterator[_Objection]:
    """All, in order of the skills and of time."""
    for of_skill in fit.each():
        for prediction in of_skill.predictions:
            found = [
                *_of_rows(prediction, of_skill.skill, "applies where it failed:", failed=True),
                *_of_rows(prediction, of_skill.skill, "says another change of:", failed=False),
                *_missed(prediction, of_skill.skill),
            ]
            yield from sorted(found, key=lambda objection: objection.transition)


def _of_rows(
    prediction: TablePrediction, skill: str, kind: str, *, failed: bool
) -> Iterator[_Objection]:
    table = prediction.table
    wrong: dict[int, list[str]] = {}
    for application in prediction.applications:
        rows = application.sure if failed else application.mispredicted
        for row in rows[~table.success[rows]] if failed else rows:
            wrong.setdefault(int(table.ids[row]), []).append(application.operator.name)
    return (_Objection(skill, kind, number, names) for number, names in wrong.items())


def _missed(prediction: TablePrediction, skill: str) -> Iterator[_Objection]:
    table = prediction.table
    for row in np.flatnonzero(table.success & ~prediction.accounted & ~prediction.undecided):
        yield _Objection(skill, "no longer explains:", int(table.ids[row]), [])
