"""Algorithm 1 of the paper: explore, invent, learn, and again.

A run is resumed by running it again from the start: recorded skills are read instead of executed,
recorded replies are served instead of asked for, and everything else is computed afresh. So a
resumed run takes the same decisions as one that was never stopped (DESIGN.md D14).
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from skillwrapper.exploration.explorer import Choice, Explorer, Situation
from skillwrapper.files.writing import append_line, write_json
from skillwrapper.grounding import AtomSpace
from skillwrapper.invention.batch import BatchInventor
from skillwrapper.invention.convergence import Convergence
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.inventor import CandidateDecision, Inventor, Verdict
from skillwrapper.invention.proposer import ModelProposer
from skillwrapper.invention.pruning import Pruned, prune
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.certification import Certificate, certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.learner import make_learner
from skillwrapper.learning.untested import find_untested
from skillwrapper.perception.labelling import Labeller
from skillwrapper.perception.reading_calls import ReadingCalls
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.artifacts import (
    describe_inconsistency,
    write_iteration,
    write_truth_table,
)
from skillwrapper.runs.events import EventKind, RunEvent, Watcher
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.recorder import EpisodeRecorder
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import Predicate
from skillwrapper.symbols.model_folder import write_model
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class LearningResult:
    """What a run has learned so far.

    Attributes:
        fit: vocabulary, operators and what is inconsistent.
        certificate: Lemma 1 and Theorem 1 on the recorded data.
        unresolved: one inconsistency for each cause that is left.
        executions: how many skills were executed.
        iterations: how many iterations were run.
        converged: whether the last iteration brought nothing new; only told if asked for.
        readings: calls that reading the pictures took.
        readings_reasking: calls that it would take to ask every predicate on every picture after
            each invention.
    """

    fit: Fit
    certificate: Certificate
    unresolved: tuple[Inconsistency, ...]
    executions: int
    iterations: int
    converged: bool = False
    readings: int = 0
    readings_reasking: int = 0

    def to_json(self) -> dict[str, Any]:
        """Figures as plain data."""
        kinds = Counter(str(i.kind) for i in self.fit.inconsistencies)
        return {
            "iterations": self.iterations,
            "converged": self.converged,
            "executions": self.executions,
            "predicates": len(self.fit.predicates),
            "operators": len(self.fit.operators),
            "lemma1_violations": self.certificate.count("lemma1"),
            "theorem1_violations": self.certificate.count("theorem1"),
            "undecided": self.certificate.undecided,
            "inconsistencies": len(self.fit.inconsistencies),
            "inconsistencies_by_kind": {str(k): kinds[str(k)] for k in InconsistencyKind},
            "unresolved": len(self.unresolved),
            "evaluation_calls": self.readings,
            "evaluation_calls_reasking": self.readings_reasking,
        }


class LearningRun:
    """A run of Algorithm 1 in a folder.

    Args:
        folder: where everything is written.
        config: what to do.
        environment: the robot or simulator.
        assistant: the models.
        watcher: told of every event.
    """

    def __init__(
        self,
        folder: RunFolder,
        config: RunSettings,
        environment: Environment,
        assistant: Assistant,
        watcher: Watcher = lambda event: None,
    ) -> None:
        domain = environment.domain
        self._folder = folder
        self._config = config
        self._watcher = watcher
        self._recorder = EpisodeRecorder(folder, environment)
        self._scenes = tuple(domain.scene(name).name for name in config.scenes or domain.scenes)
        self.recorded = RecordedTransitions(domain)
        self.truth = TruthTable(domain, assistant)
        asking = config.model.asking
        self._readings = ReadingCalls(self.truth, asking.batch_size, asking.votes)
        self._explorer = Explorer(domain, assistant, config.exploration, config.seed)
        self._fitter = Fitter(Labeller(self.recorded, self.truth), make_learner(config.learning))
        self._vocabulary = Vocabulary(domain.types)
        self._inventor = self._make_inventor(assistant)
        self._convergence = Convergence(self._fitter)
        self._converged = False
        self._iteration = 0
        self._finished = folder.finished_iterations()
        self._decisions: list[dict[str, Any]] = []

    def run(self) -> LearningResult:
        """Run all iterations, or what is left of them.

        Raises:
            ProviderError: if a model does not answer.
            RobotError: if the environment fails.
            LimitReachedError: if a limit of the user's is reached; the run can be resumed.
        """
        result = None
        while self._iteration < self._config.iterations and not self._is_over():
            result = self._iterate()
        if result is None:
            result = self._result()
        write_model(self._folder.model, result.fit.model)
        write_json(self._folder.path / "result.json", result.to_json())
        return result

    def _is_over(self) -> bool:
        """Whether the run has converged; iterations that are there already stay part of it."""
        return self._converged and self._iteration >= self._finished

    def _make_inventor(self, assistant: Assistant) -> Inventor | BatchInventor:
        settings = self._config.learning
        if settings.invention == "batch":
            return BatchInventor(
                self._fitter, self._vocabulary, assistant, settings.batch_size, self._decided
            )
        proposer = ModelProposer(self.recorded, assistant, settings.candidates)
        return Inventor(self._fitter, self._vocabulary, proposer, settings, self._decided)

    def _iterate(self) -> LearningResult:
        self._iteration += 1
        self._decisions = []
        self._tell(EventKind.ITERATION_STARTED, total=self._config.iterations)
        episode = self._explore()
        self.recorded.add(episode)
        self._explorer.record(episode)
        self._readings.count_arrival(self._everything(self._vocabulary.active))
        self._converged = self._config.until_converged and self._convergence.is_reached()
        self._inventor.invent()
        if self._config.learning.prune:
            for pruned in prune(self._fitter, self._vocabulary):
                self._set_dormant(pruned)
        result = self._result()
        self._convergence.remember(result.fit)
        self._write(result)
        self._tell(EventKind.ITERATION_FINISHED, **result.to_json())
        return result

    def _explore(self) -> Episode:
        seed = self._config.layout_seed(self._iteration)
        scene = self._scenes[(self._iteration - 1) % len(self._scenes)]
        return self._recorder.run(self._iteration, seed, scene, self._choose, self._executed)

    def _choose(self, scene: Scene, observation: Observation) -> tuple[SkillInstance, ...]:
        fit = self._fitter.fit(self._vocabulary.active)
        state = self.truth.labels(AtomSpace(fit.predicates, scene.objects), [observation])[0]
        situation = Situation(scene.objects, observation, state, fit.model, find_untested(fit))
        choice = self._explorer.choose(situation)
        self._tell(EventKind.SEQUENCE_CHOSEN, **_describe_choice(choice))
        return choice.sequence

    def _result(self) -> LearningResult:
        fit = self._fitter.fit(self._vocabulary.active)
        return LearningResult(
            fit,
            certify(fit),
            distinct_causes(fit.inconsistencies),
            len(self.recorded),
            self._iteration,
            self._converged,
            self._readings.needed,
            self._readings.reasking,
        )

    def _write(self, result: LearningResult) -> None:
        if self._iteration <= self._finished:
            return
        unresolved = [describe_inconsistency(i, self.recorded) for i in result.unresolved]
        target = self._folder.iteration(self._iteration)
        write_iteration(self._folder, self._iteration, result.fit, result.certificate, unresolved)
        write_truth_table(target / "truth_table.csv", result.fit, self.recorded, self.truth)
        write_json(target / "decisions.json", self._decisions)
        agreement = {p.name: self.truth.agreement(p) for p in result.fit.predicates}
        summary = {
            **result.to_json(),
            "pairs_covered": self._explorer.pairs.share_covered(),
            "untested": {n: sorted(map(str, c)) for n, c in find_untested(result.fit).items()},
            "agreement": {name: round(a, 4) for name, a in agreement.items() if a is not None},
        }
        write_json(target / "summary.json", summary)

    def _decided(self, decision: CandidateDecision) -> None:
        if self._is_invention(decision):
            vocabulary = self._vocabulary.with_candidate(decision.predicate)
            self._readings.count_invention(self._everything(vocabulary))
        entry: dict[str, Any] = {
            "verdict": str(decision.verdict),
            "predicate": decision.predicate.signature,
            "semantics": decision.predicate.semantics,
            "score": decision.score,
            "reason": decision.reason,
        }
        if decision.inconsistency is not None:
            entry["inconsistency"] = describe_inconsistency(decision.inconsistency, self.recorded)
        self._decisions.append(entry)
        self._tell(EventKind.PREDICATE_DECIDED, **entry)

    def _is_invention(self, decision: CandidateDecision) -> bool:
        """Whether a candidate is new; one that is taken in the end after all was counted before."""
        if decision.inconsistency is None:
            return False
        if decision.verdict is Verdict.ACCEPTED:
            return decision.predicate not in self._vocabulary.rejected
        return decision.verdict is Verdict.REJECTED

    def _everything(
        self, predicates: Sequence[Predicate]
    ) -> Iterator[tuple[AtomSpace, Sequence[Observation]]]:
        """All groundings and all pictures of every scene."""
        for scene in self.recorded.scenes:
            space = AtomSpace(tuple(predicates), scene.objects)
            yield space, self.recorded.observations(scene)

    def _set_dormant(self, pruned: Pruned) -> None:
        entry = {"predicate": pruned.predicate.signature, "reason": pruned.reason}
        self._decisions.append({"verdict": "dormant", **entry})
        self._tell(EventKind.PREDICATE_DORMANT, **entry)

    def _executed(self, transition: Transition) -> None:
        self._tell(
            EventKind.SKILL_EXECUTED,
            instance=str(transition.instance),
            success=transition.success,
        )

    def _tell(self, kind: EventKind, **data: Any) -> None:
        event = RunEvent(kind, self._iteration, data)
        if self._iteration > self._finished:
            entry = {
                "time": round(time.time(), 3),
                "event": str(kind),
                "iteration": self._iteration,
            }
            append_line(self._folder.events, {**entry, **data})
        self._watcher(event)


def _describe_choice(choice: Choice) -> dict[str, Any]:
    return {
        "sequence": [str(i) for i in choice.sequence],
        "scores": [{"balance": c.balance, "coverage": c.coverage} for c in choice.candidates],
        "pareto": list(choice.pareto),
        "notes": list(choice.notes),
    }
