"""Writing the folder of a run, as one that watches it.

What cannot be computed again is on the disk before the run goes on. All else is compared with
what is there and written where it differs, so that a resumed run mends what was lost.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from skillwrapper.exploration.explorer import SequenceChoice
from skillwrapper.files.writing import json_text, write_atomically
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.untested import find_untested
from skillwrapper.learning.version_space import VersionSpace, version_spaces
from skillwrapper.perception.overruling import DecodingCertificate
from skillwrapper.runs.archive.archive import RunArchive
from skillwrapper.runs.archive.episode_files import EpisodeFile
from skillwrapper.runs.archive.event_log import EventLog
from skillwrapper.runs.archive.labels import truth_table
from skillwrapper.runs.archive.pictures import PictureStore
from skillwrapper.runs.archive.records import (
    DecisionRecord,
    DecodingRecord,
    ErrorRatesRecord,
    InconsistencyRecord,
    OverruledRecord,
    SummaryRecord,
    WitnessRecord,
    to_plain,
)
from skillwrapper.runs.decisions import NumberedTransition, PredicateDecision, witnesses_of
from skillwrapper.runs.events import (
    EpisodeStarted,
    IterationFinished,
    IterationStarted,
    PredicateDecided,
    RunEvent,
    RunFinished,
    SequenceChosen,
    SkillExecuted,
    SkillRecalled,
    StartSeen,
)
from skillwrapper.runs.results import LearningResult, SceneLabels
from skillwrapper.symbols.describe import describe_model
from skillwrapper.symbols.files import model_to_json, predicates_to_yaml
from skillwrapper.symbols.pddl import print_domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation


class ArchiveWriter:
    """Writes down what happens in a run (an ``Observer``).

    Args:
        archive: where.
    """

    def __init__(self, archive: RunArchive) -> None:
        self._layout = archive.layout
        self._event_log = EventLog(archive.layout.events)

    def __call__(self, event: RunEvent) -> None:
        """Write an event down."""
        match event:
            case StartSeen():
                PictureStore(self._layout.images).save(event.start)
            case EpisodeStarted():
                self._start_episode(event)
            case SkillExecuted():
                self._record(event)
            case IterationFinished():
                self._write_iteration(event)
            case RunFinished():
                self._write_result(event.result)
        self._log(event)

    def _start_episode(self, event: EpisodeStarted) -> None:
        EpisodeFile(self._layout, event.episode).start(event.scene, event.seed, event.start)

    def _record(self, event: SkillExecuted) -> None:
        done = event.transition
        EpisodeFile(self._layout, event.episode).add(done, done.before, event.message)

    def _write_iteration(self, event: IterationFinished) -> None:
        """Describe an iteration; the summary comes last, and marks it finished."""
        folder, result = self._layout.iteration(event.iteration), event.result
        decisions = map(_decision_record, result.decisions[-1])
        _keep(folder / "decisions.json", json_text([to_plain(d) for d in decisions]))
        self._write_learned(folder, result, event.labels)

    def write_relearned(
        self, iteration: int, result: LearningResult, labels: Sequence[SceneLabels]
    ) -> None:
        """What was learned anew from the episodes up to an iteration; its decisions stay."""
        self._write_learned(self._layout.iteration(iteration), result, labels)
        self._write_result(result)

    def _write_learned(
        self, folder: Path, result: LearningResult, labels: Sequence[SceneLabels]
    ) -> None:
        _keep(folder / "predicates.yaml", predicates_to_yaml(result.model.predicates))
        _keep(folder / "model.json", model_to_json(result.model))
        _keep(folder / "operators.txt", describe_model(result.model))
        _keep(folder / "truth_table.csv", truth_table(labels))
        _keep(folder / "certificate.json", json_text(result.certificate.to_json()))
        _keep(folder / "unresolved.json", json_text(_unresolved(result)))
        if result.decoding is not None:
            _keep(folder / "decoding.json", json_text(to_plain(_decoding(result.decoding))))
        _keep(folder / "summary.json", json_text(to_plain(_summary(result))))

    def _write_result(self, result: LearningResult) -> None:
        """The learned model, and the figures of the run."""
        model = result.model
        _keep(self._layout.model / "predicates.yaml", predicates_to_yaml(model.predicates))
        _keep(self._layout.model / "model.json", model_to_json(model))
        _keep(self._layout.model / "domain.pddl", print_domain(model))
        _keep(self._layout.result, json_text(to_plain(result.figures)))

    def _log(self, event: RunEvent) -> None:
        described = _describe(event)
        if described is not None:
            name, told = described
            self._event_log.note(name, event.iteration, told)


def _keep(path: Path, content: str) -> None:
    """Write a file, unless it holds the same already."""
    try:
        if path.read_text(encoding="utf-8") == content:
            return
    except (OSError, UnicodeDecodeError):
        """It is missing or damaged, so it is written anew."""
    write_atomically(path, content)


def _describe(event: RunEvent) -> tuple[str, dict[str, Any]] | None:
    """The name of an event in the log, and what describes it; None for what is not logged."""
    match event:
        case IterationStarted():
            return "iteration_started", {"total": event.iterations, "budget": event.budget}
        case SequenceChosen():
            return "sequence_chosen", _describe_choice(event.choice)
        case SkillExecuted() | SkillRecalled():
            done = event.transition
            told = {"instance": str(done.instance), "success": done.success}
            return "skill_executed", {**told, "reason": event.reason}
        case PredicateDecided():
            return "predicate_decided", to_plain(_decision_record(event.decision))
        case IterationFinished():
            return "iteration_finished", to_plain(event.result.figures)
    return None


def _describe_choice(choice: SequenceChoice) -> dict[str, Any]:
    return {
        "sequence": [str(i) for i in choice.sequence],
        "scores": [{"balance": c.balance, "coverage": c.coverage} for c in choice.candidates],
        "pareto": list(choice.pareto),
        "notes": list(choice.notes),
    }


def _summary(result: LearningResult) -> SummaryRecord:
    untested = find_untested(result.fit)
    return SummaryRecord(
        **result.figures.model_dump(),
        pairs_covered=result.pairs_covered,
        untested={name: tuple(sorted(map(str, found))) for name, found in untested.items()},
        needed=_needed(result.fit),
        agreement={name: round(share, 4) for name, share in result.agreement.items()},
    )


def _needed(fit: Fit) -> dict[str, dict[str, float]]:
    """How likely each condition of every operator is needed, by the data alone."""
    spaces = [space for skill in fit.skills for space in version_spaces(fit, skill)]
    return {
        space.operator.name: {name: round(chance, 4) for name, chance in sorted(_by_name(space))}
        for space in spaces
    }


def _by_name(space: VersionSpace) -> Iterator[tuple[str, float]]:
    return ((str(condition), chance) for condition, chance in space.probability.items())


def _decoding(found: DecodingCertificate) -> DecodingRecord:
    return DecodingRecord(
        readings=found.readings,
        in_doubt=found.in_doubt,
        dirty=round(found.dirty, 4),
        rates=tuple(
            ErrorRatesRecord(
                predicate=predicate.name,
                false_positive=round(rates.false_positive, 4),
                false_negative=round(rates.false_negative, 4),
                negatives=round(rates.negatives, 1),
                positives=round(rates.positives, 1),
            )
            for predicate, rates in found.rates.items()
        ),
        overruled=tuple(
            OverruledRecord(
                scene=one.scene.name,
                pictures=_shas(one.observation),
                atom=str(one.atom),
                read=one.read,
                posterior=round(one.posterior, 4),
            )
            for one in found.overruled
        ),
    )


def _unresolved(result: LearningResult) -> list[Any]:
    transitions = result.transitions
    return [to_plain(_inconsistency(i, witnesses_of(i, transitions))) for i in result.unresolved]


def _decision_record(decision: PredicateDecision) -> DecisionRecord:
    asked_for = decision.inconsistency
    return DecisionRecord(
        verdict=decision.verdict,
        predicate=decision.predicate.signature,
        semantics=decision.predicate.semantics,
        score=decision.score,
        reason=decision.reason,
        inconsistency=_inconsistency(asked_for, decision.witnesses) if asked_for else None,
    )


def _inconsistency(
    inconsistency: Inconsistency, witnesses: Iterable[NumberedTransition]
) -> InconsistencyRecord:
    return InconsistencyRecord(
        kind=str(inconsistency.kind),
        skill=inconsistency.skill,
        witnesses=tuple(_witness(w.number, w.transition) for w in witnesses),
        unexplained=tuple(map(str, inconsistency.unexplained)),
    )


def _witness(number: int, transition: Transition) -> WitnessRecord:
    return WitnessRecord(
        transition=number,
        instance=str(transition.instance),
        success=transition.success,
        before=_shas(transition.before),
        after=_shas(transition.after),
    )


def _shas(observation: Observation) -> tuple[str, ...]:
    return tuple(picture.sha256 for picture in observation.pictures)
