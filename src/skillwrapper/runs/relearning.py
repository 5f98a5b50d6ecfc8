"""Learning operators anew from corrected labels, without asking or executing anything."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skillwrapper.learning.certification import certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import distinct_causes
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.overruling import certify_decoding
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.archive import ArchivedIteration
from skillwrapper.runs.archive.writer import ArchiveWriter
from skillwrapper.runs.imported_model import retake
from skillwrapper.runs.recollection import Recollection
from skillwrapper.runs.results import LearningResult, ReadingCosts


def relearn(archive: RunArchive) -> LearningResult:
    """Learn from what is recorded with the present corrections, and write down what comes of it.

    The vocabulary is that of the last finished iteration, as it was corrected; its files and the
    model of the run are replaced. Imported operators stay if nothing recorded speaks against them.

    Args:
        archive: of a run that nobody else works in.

    Raises:
        UserError: if no iteration is finished, or a file is damaged.
    """
    known = Recollection.of(archive)
    retaken = retake(archive, known)
    return write_fit(archive, known, retaken.fit if retaken else known.fit())


def write_fit(archive: RunArchive, known: Recollection, fit: Fit) -> LearningResult:
    """Put what was learned anew in the place of what the last finished iteration has learned.

    Args:
        archive: of a run that nobody else works in.
        known: what is recorded in it.
        fit: what was learned from that.
    """
    labeller, decoding = known.labeller, None
    if isinstance(labeller, DecodedLabeller):
        decoding = certify_decoding(labeller, known.settings.learning.least_confidence)
    kept = _Kept.of(known.latest, known.truth.names)
    result = LearningResult(
        fit=fit,
        certificate=certify(fit),
        unresolved=distinct_causes(fit.inconsistencies),
        iterations=known.latest.number,
        episodes=known.episodes,
        decisions=(),
        converged=kept.converged,
        readings=kept.readings,
        pairs_covered=kept.pairs_covered,
        agreement=kept.agreement,
        decoding=decoding,
    )
    ArchiveWriter(archive).write_relearned(known.latest.number, result, known.labels())
    return result


@dataclass(frozen=True)
class _Kept:
    """Figures that corrections do not change."""

    converged: bool
    readings: ReadingCosts
    pairs_covered: float
    agreement: Mapping[str, float]

    @classmethod
    def of(cls, latest: ArchivedIteration, names: Mapping[str, str]) -> _Kept:
        found = latest.summary
        agreement = {
            now: found.agreement[had] for now, had in names.items() if had in found.agreement
        }
        readings = ReadingCosts(found.evaluation_calls, found.evaluation_calls_reasking)
        return cls(found.converged, readings, found.pairs_covered, agreement)
