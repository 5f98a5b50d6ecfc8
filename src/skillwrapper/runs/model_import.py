"""Taking a model into a run that a person has edited, if all that is recorded agrees with it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from skillwrapper.errors import RefusedModelError
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import make_learner
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.records import CorrectionRecord, Rejection, Rewording
from skillwrapper.runs.edited_domain import read_edited_domain
from skillwrapper.runs.explanation import placed_transitions
from skillwrapper.runs.imported_model import fit_of, keep_imported
from skillwrapper.runs.objections import new_objections
from skillwrapper.runs.recollection import Recollection
from skillwrapper.runs.relearning import relearn, write_fit
from skillwrapper.symbols import Predicate
from skillwrapper.symbols.files import read_placed_predicates


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
    fit = fit_of(known, [one.operator for one in edited])
    places = {one.operator.name: one.where for one in edited}
    transitions = placed_transitions(known)
    reasons = []
    for objection in new_objections(fit, known.fit()):
        where = places.get(objection.subject, f"{path}:1")
        what = f"{objection.subject} {objection.kind} {transitions[objection.transition]}"
        reasons.append(f"{where}: {what}")
    if reasons:
        raise RefusedModelError(path, reasons)
    keep_imported(archive, fit)
    write_fit(archive, known, fit)
    return fit


def _import_predicates(archive: RunArchive, path: Path) -> Fit:
    known = Recollection.of(archive)
    wanted = read_placed_predicates(path, archive.domain())
    corrections = tuple(_corrections(known.vocabulary, wanted, path))
    names = {predicate.name for predicate, _ in wanted}
    kept = [p for p in known.vocabulary if p.name in names]
    fit = Fitter(known.labeller, make_learner(known.settings.learning)).fit(kept)
    transitions = placed_transitions(known)
    reasons = [
        f"{path}: without what was left out, {o.skill} {o.kind} {transitions[o.transition]}"
        for o in new_objections(fit, known.fit())
    ]
    if reasons:
        raise RefusedModelError(path, reasons)
    for correction in corrections:
        archive.correct(correction)
    return relearn(archive).fit


def _corrections(
    vocabulary: Sequence[Predicate], wanted: Sequence[tuple[Predicate, str]], path: Path
) -> Iterator[CorrectionRecord]:
    """What makes the wanted predicates out of those that there are."""
    present = {p.name: p for p in vocabulary}
    for predicate, where in wanted:
        had = present.pop(predicate.name, None)
        if had is None or had.types != predicate.types:
            reason = (
                f"{where}: '{predicate.signature}' was never read off a picture; learn with it: "
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
