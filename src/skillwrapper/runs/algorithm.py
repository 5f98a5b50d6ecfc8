"""Algorithm 1 of the paper: explore, invent, learn, and again; takes and gives values.

A run is resumed by running it again from the start: recorded skills are read instead of executed,
recorded replies are served instead of asked for, and everything else is computed afresh. So a
resumed run takes the same decisions as one that was never stopped (docs/semantics.md D14).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.exploration.explorers import make_explorer
from skillwrapper.exploration.questions import SequenceProposer
from skillwrapper.exploration.scores import PairCounts
from skillwrapper.grounding import AtomSpace
from skillwrapper.invention.batch import BatchAdviser, BatchInventor
from skillwrapper.invention.convergence import Convergence
from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.inventor import Inventor
from skillwrapper.invention.proposer import Adviser, ModelProposer
from skillwrapper.invention.pruning import prune
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.certification import certify
from skillwrapper.learning.inconsistencies import distinct_causes
from skillwrapper.learning.learner import make_learner
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.perception.overruling import DecodingCertificate, certify_decoding
from skillwrapper.perception.reading_calls import ReadingCalls
from skillwrapper.perception.truth_table import LabelProvider, TruthTable
from skillwrapper.runs.decisions import PredicateDecision
from skillwrapper.runs.episodes import EpisodeRunner, EpisodeSoFar
from skillwrapper.runs.events import (
    IterationFinished,
    IterationStarted,
    Observer,
    PredicateDecided,
    RunEvent,
    RunFinished,
    SequenceChosen,
    StartSeen,
)
from skillwrapper.runs.results import LearningResult, ReadingCosts, SceneLabels
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.capabilities import Replayable, supports
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation

_BEFOREHAND = 900
"""No run has so many iterations; the starts that are looked at beforehand have later numbers."""


class Respondent(SequenceProposer, Adviser, BatchAdviser, LabelProvider, Protocol):
    """Who answers the questions of a run; ``vlm.assistant.Assistant`` is one."""


def _nothing(number: int) -> EpisodeSoFar | None:
    return None


@dataclass(frozen=True)
class EarlierRun:
    """What an earlier run with the same settings has left.

    Attributes:
        episode: the record of an episode, by its number from 1; None where there is none.
        finished: how many iterations it has finished; they stay part of the run.
        is_all: whether it is learned from this alone: every episode is taken as it is, and nothing
            is executed.
        words: predicates that a person has named; they are tried before a model is asked.
    """

    episode: Callable[[int], EpisodeSoFar | None] = _nothing
    finished: int = 0
    is_all: bool = False
    words: tuple[Predicate, ...] = ()

    def recorded(self, number: int) -> EpisodeSoFar | None:
        """The record of an episode as the run has to take it; None where there is none."""
        found = self.episode(number)
        return replace(found, given=True) if found and self.is_all else found


class LearningAlgorithm:
    """A run of Algorithm 1.

    Args:
        settings: what to do.
        environment: the robot or simulator.
        assistant: the models.
        observers: told of every event.
        earlier: what is there already; nothing for a new run.

    Raises:
        UnknownNameError: if the settings name a scene that the domain does not have.
    """

    def __init__(
        self,
        settings: RunSettings,
        environment: Environment,
        assistant: Respondent,
        observers: Sequence[Observer] = (),
        earlier: EarlierRun | None = None,
    ) -> None:
        domain = environment.domain
        self._settings, self._observers = settings, tuple(observers)
        self._environment = environment
        self._earlier = earlier or EarlierRun()
        names = settings.scenes or domain.scenes
        self._scenes = tuple(domain.scene(name).name for name in names)
        self._runner = EpisodeRunner(environment, self._tell)
        self._recorded = RecordedTransitions(domain)
        self._truth = TruthTable(domain, assistant)
        asking = settings.model.asking
        self._readings = ReadingCalls(self._truth, asking.batch_size, asking.votes)
        exploration = settings.exploration
        self._explorer = make_explorer(domain, assistant, exploration, settings.seed)
        lifted = exploration.pairs == "skills"
        self._pairs = PairCounts(domain.skill_instances, lifted=lifted)
        self._vocabulary = Vocabulary(domain.types, dormant=self._earlier.words)
        self._labeller = self._make_labeller()
        self._fitter = Fitter(self._labeller, make_learner(settings.learning))
        self._inventor = self._make_inventor(assistant)
        self._invented: set[Predicate] = set()
        self._convergence = Convergence(self._fitter)
        self._converged = False
        self._iteration = 0
        self._left, self._resumes = 0, False
        self._transitions: list[Transition] = []
        self._episodes: list[Episode] = []
        self._decisions: list[list[PredicateDecision]] = []

    def run(self) -> LearningResult:
        """Run all iterations, or what is left of them.

        Raises:
            ProviderError: if a model does not answer.
            RobotError: if the environment fails.
            LimitReachedError: if a limit of the user's is reached; the run can be resumed.
        """
        self._look_around()
        while self._iteration < self._settings.iterations and not self._is_over():
            self._iterate()
        result = self._result()
        self._tell(RunFinished(self._iteration, result))
        return result

    def _look_around(self) -> None:
        """See some starts beforehand, where only they tell what is misread from what varies (D24).

        They are not recorded; so they are only looked at where a resumed run sees the same.
        """
        environment, domain = self._environment, self._environment.domain
        tells = self._settings.decodes_labels and domain.resets_restore_state
        if not tells or self._earlier.is_all or not supports(environment, Replayable):
            return
        for number in range(self._settings.learning.starts):
            seed = self._settings.layout_seed(_BEFOREHAND + number)
            start = environment.reset(seed=seed, scene=self._scenes[0])
            self._inventor.note_start(environment.scene, start)
            self._tell(StartSeen(0, environment.scene, seed, start))

    def _is_over(self) -> bool:
        """Whether the run has converged; iterations that are there already stay part of it."""
        return self._converged and self._iteration >= self._earlier.finished

    def _make_labeller(self) -> Labeller:
        if not self._settings.decodes_labels:
            return Labeller(self._recorded, self._truth)
        priors = self._settings.perception.decoding
        return DecodedLabeller(self._recorded, self._truth, lambda: self._vocabulary.active, priors)

    def _make_inventor(self, assistant: Respondent) -> Inventor | BatchInventor:
        learning = self._settings.learning
        if learning.invention == "batch":
            return BatchInventor(
                self._fitter, self._vocabulary, assistant, learning.batch_size, self._decided
            )
        proposer = ModelProposer(self._recorded, assistant, learning)
        return Inventor(self._fitter, self._vocabulary, proposer, learning, self._decided)

    def _iterate(self) -> None:
        self._iteration += 1
        self._decisions.append([])
        self._left = self._settings.exploration.budget
        self._tell(IterationStarted(self._iteration, self._settings.iterations, self._left))
        self._explore()
        self._converged = self._settings.until_converged and self._convergence.is_reached()
        self._inventor.invent()
        if self._settings.learning.prune:
            for pruned in prune(self._fitter, self._vocabulary):
                for decision in PredicateDecision.of_pruned(pruned):
                    self._note(decision)
        result = self._result()
        self._convergence.remember(result.fit)
        self._tell(IterationFinished(self._iteration, result, self._labels(result)))

    def _explore(self) -> None:
        """Run an episode, and others where the explorer ends one with some of the budget left.

        Every further one costs the price of a reset.
        """
        self._resumes = True
        while self._resumes and self._left > 0:
            self._resumes = False
            number = len(self._episodes) + 1
            recorded = self._earlier.recorded(number)
            episode = self._run_episode(number, recorded)
            self._finish(episode)
            self._left -= len(episode.transitions) + self._settings.exploration.reset_price
            self._resumes &= recorded is None or not recorded.given

    def _run_episode(self, number: int, recorded: EpisodeSoFar | None) -> Episode:
        scene = self._scenes[(self._iteration - 1) % len(self._scenes)]
        if recorded is not None:
            return self._runner.follow(self._iteration, number, recorded, scene, self._next_skill)
        seed = self._settings.layout_seed(number)
        return self._runner.run(self._iteration, number, seed, scene, self._next_skill)

    def _next_skill(self, done: EpisodeSoFar) -> NextSkill:
        """What the explorer chooses to run next, as long as the budget lasts."""
        self._take(done.to_episode())
        if not done.transitions:
            self._inventor.note_start(done.scene, done.start)
        left = self._left - len(done.transitions)
        if left <= 0:
            return NextSkill(None, "the budget is spent")
        situation = Situation(
            done.scene,
            done.observation,
            tuple(done.transitions),
            left,
            learn=self._inventor.keep_up,
            read=lambda space: self._labeller.read(done.scene, done.observation, space),
        )
        chosen = self._explorer.next_skill(situation)
        self._resumes = chosen.resumes
        if chosen.sequence is not None:
            self._tell(SequenceChosen(self._iteration, chosen.sequence))
        return chosen

    def _take(self, episode: Episode) -> None:
        """Take into the data what was executed since the last time."""
        finished = sum(len(e.transitions) for e in self._episodes)
        new = episode.transitions[len(self._transitions) - finished :]
        self._transitions += new
        self._recorded.add(replace(episode, transitions=new))

    def _finish(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        self._take(episode)
        self._episodes.append(episode)
        self._pairs.add(t.instance for t in episode.transitions)
        self._explorer.record(episode)
        self._readings.count_arrival(self._everything(self._vocabulary.active))

    def _result(self) -> LearningResult:
        fit = self._fitter.fit(self._vocabulary.active)
        agreement = {p.name: self._truth.agreement(p) for p in fit.predicates}
        return LearningResult(
            fit=fit,
            certificate=certify(fit),
            unresolved=distinct_causes(fit.inconsistencies),
            iterations=self._iteration,
            episodes=tuple(self._episodes),
            decisions=tuple(map(tuple, self._decisions)),
            converged=self._converged,
            readings=ReadingCosts(self._readings.needed, self._readings.reasking),
            pairs_covered=self._pairs.share_covered(),
            agreement={name: share for name, share in agreement.items() if share is not None},
            decoding=self._certify_decoding(),
        )

    def _certify_decoding(self) -> DecodingCertificate | None:
        if not isinstance(self._labeller, DecodedLabeller):
            return None
        return certify_decoding(self._labeller, self._settings.learning.least_confidence)

    def _labels(self, result: LearningResult) -> tuple[SceneLabels, ...]:
        return tuple(
            SceneLabels(space, observations, self._truth.labels(space, observations))
            for space, observations in self._everything(result.fit.predicates)
        )

    def _decided(self, decision: CandidateDecision) -> None:
        if self._is_invention(decision):
            self._invented.add(decision.predicate)
            vocabulary = self._vocabulary.with_candidate(decision.predicate)
            self._readings.count_invention(self._everything(vocabulary))
        self._note(PredicateDecision.of_candidate(decision, self._transitions))

    def _is_invention(self, decision: CandidateDecision) -> bool:
        """Whether a candidate is judged for the first time."""
        judged = decision.verdict in (Verdict.ACCEPTED, Verdict.REJECTED)
        asked_for = decision.inconsistency is not None
        return judged and asked_for and decision.predicate not in self._invented

    def _note(self, decision: PredicateDecision) -> None:
        self._decisions[-1].append(decision)
        self._tell(PredicateDecided(self._iteration, decision))

    def _everything(
        self, predicates: Sequence[Predicate]
    ) -> Iterator[tuple[AtomSpace, Sequence[Observation]]]:
        """All groundings and all pictures of every scene."""
        for scene in self._recorded.scenes:
            space = AtomSpace(tuple(predicates), scene.objects)
            yield space, self._recorded.observations(scene)

    def _tell(self, event: RunEvent) -> None:
        for observer in self._observers:
            observer(event)
