"""What comes of a run, as values."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.learning.certification import Certificate
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import INCONSISTENT
from skillwrapper.perception.overruling import DecodingCertificate
from skillwrapper.runs.decisions import PredicateDecision
from skillwrapper.runs.figures import RunFigures
from skillwrapper.symbols import AbstractModel
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation


@dataclass(frozen=True)
class SceneLabels:
    """The labels of all observations of one scene.

    Attributes:
        space: the ground atoms.
        observations: what was seen, each once, in order of time.
        labels: (observations, atoms).
    """

    space: AtomSpace
    observations: Sequence[Observation]
    labels: Labels


@dataclass(frozen=True)
class ReadingCosts:
    """Calls that reading pictures takes.

    Attributes:
        needed: how many it took.
        reasking: how many it would take to ask every predicate on every picture after each
            invention.
    """

    needed: int = 0
    reasking: int = 0


@dataclass(frozen=True)
class LearningResult:
    """What a run has learned so far.

    Attributes:
        fit: vocabulary, operators and what is inconsistent.
        certificate: Lemma 1 and Theorem 1 on the recorded data.
        unresolved: one inconsistency for each cause that is left.
        iterations: how many were run.
        episodes: what was executed, one episode or more in every iteration.
        decisions: on predicates, for each iteration in order.
        converged: whether the last iteration brought nothing new; only told if asked for.
        readings: calls that reading the pictures took.
        pairs_covered: share of the pairs of skill instances that were tried, 0 to 1.
        agreement: for every predicate that was voted on the share of votes for the label.
        decoding: which readings were overruled; None if labels were taken as they were read.
    """

    fit: Fit
    certificate: Certificate
    unresolved: tuple[Inconsistency, ...]
    iterations: int
    episodes: tuple[Episode, ...]
    decisions: tuple[tuple[PredicateDecision, ...], ...]
    converged: bool
    readings: ReadingCosts
    pairs_covered: float
    agreement: Mapping[str, float]
    decoding: DecodingCertificate | None = None

    @property
    def model(self) -> AbstractModel:
        """Predicates and operators."""
        return self.fit.model

    @cached_property
    def transitions(self) -> tuple[Transition, ...]:
        """All transitions; certificate and inconsistencies count them from 0."""
        return tuple(t for episode in self.episodes for t in episode.transitions)

    @property
    def executions(self) -> int:
        """How many skills were executed."""
        return len(self.transitions)

    @property
    def figures(self) -> RunFigures:
        """The result in numbers."""
        kinds = Counter(i.kind for i in self.fit.inconsistencies)
        return RunFigures(
            iterations=self.iterations,
            episodes=len(self.episodes),
            converged=self.converged,
            executions=self.executions,
            predicates=len(self.fit.predicates),
            operators=len(self.fit.operators),
            lemma1_violations=self.certificate.count("lemma1"),
            theorem1_violations=self.certificate.count("theorem1"),
            undecided=self.certificate.undecided,
            inconsistencies=len(self.fit.inconsistencies),
            inconsistencies_by_kind={str(kind): kinds[kind] for kind in INCONSISTENT},
            unresolved=len(self.unresolved),
            evaluation_calls=self.readings.needed,
            evaluation_calls_reasking=self.readings.reasking,
        )
