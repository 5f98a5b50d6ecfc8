"""System Predicates: operators learned from the simulator's own, true description of states.

Nothing is invented, and start and goal are known exactly, as in the paper. Without universal
absences the predicates cannot say that nothing lies on an item; with them they can
(docs/semantics.md, D2).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Final

from skillwrapper.errors import InternalError
from skillwrapper.evaluation.exact.learning_curves import Stage
from skillwrapper.evaluation.exact.state_readers import AtomReader, Situation, system_reader
from skillwrapper.evaluation.methods.method import CellContext, Prepared, Shares
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.certification import certify
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.perception.labelling import Labeller
from skillwrapper.runs.archive import RunArchive
from skillwrapper.symbols import Atom
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.capabilities import Settable, Simulable, Truthful, require
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode
from skillwrapper.world.observation import Observation


@dataclass(frozen=True)
class RecordedFacts:
    """True labels of recorded pictures (``perception.labelling.TruthSource``).

    Attributes:
        facts: what is true in every recorded picture, by the key of its observation.
    """

    facts: dict[str, frozenset[Atom]] = field(default_factory=dict)

    def add(self, environment: Environment, episode: Episode) -> None:
        """Find out what was true in an episode by running it again, without pictures.

        Raises:
            ConfigurationError: if the environment does not tell its states.
        """
        purpose = "learning from true states"
        simulable = require(environment, Simulable, purpose)
        truthful = require(environment, Truthful, purpose)
        environment.reset(seed=episode.seed, scene=episode.scene.name)
        state = require(environment, Settable, purpose).get_state()
        for transition in episode.transitions:
            self._note(transition.before, truthful, state)
            _, state = simulable.successor(state, transition.instance)
            self._note(transition.after, truthful, state)

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing to do: all labels are there."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """True labels (observations, atoms)."""
        reader = AtomReader(lambda facts: facts)
        seen = [Situation.seen(o, self.facts[o.key]) for o in observations]
        return reader.read(space, seen)

    def _note(self, seen: Observation, truthful: Truthful, state: Any) -> None:
        self.facts[seen.key] = frozenset(Atom(*pair) for pair in truthful.true_atoms(state))


@dataclass(frozen=True)
class SystemMethod:
    """Learns operators over the simulator's predicates from what the whole method executed.

    Attributes:
        name: short, as in experiment files.
        title: as in tables.
        absences: whether preconditions may be universal absences.
        source: the method whose executions are used.
    """

    name: str
    title: str
    absences: bool
    source: str | None = "ours"

    @property
    def shares(self) -> Shares:
        """The model explored for the method that this one learns from."""
        return Shares(
            "proposes the skill sequences of the source", "learns operators over true facts, plans"
        )

    @contextmanager
    def prepare(self, context: CellContext) -> Iterator[Prepared]:
        """Learn from the recorded episodes, one after the other.

        Raises:
            ConfigurationError: if the domain has no system predicates, or its states are not told.
        """
        if context.source is None:
            raise InternalError(f"{self.name}: expected a source cell, got none; please report it")
        predicates = context.package.system_predicates
        reader = system_reader(require(context.environment, Truthful, f"the method {self.name}"))
        episodes = RunArchive.open(context.source / "run").episodes()
        recorded = RecordedFacts()
        done = RecordedTransitions(context.environment.domain)
        learner = FaithfulLearner(LearnerSettings(absences=self.absences))
        fitter = Fitter(Labeller(done, recorded), learner)
        stages = []
        for episode in episodes:
            recorded.add(context.environment, episode)
            done.add(episode)
            fit = fitter.fit(predicates)
            stages.append(Stage(len(done), fit.model))
        exact = context.exact.told()
        solver = context.solver(fit.model, reader, exact)
        yield Prepared(
            solver,
            tuple(stages),
            exact,
            episodes,
            recorded,
            self.absences,
            _figures(fit, len(done)),
        )


def _figures(fit: Fit, executions: int) -> dict[str, Any]:
    certificate = certify(fit)
    return {
        "executions": executions,
        "predicates": len(fit.predicates),
        "operators": len(fit.operators),
        "lemma1_violations": certificate.count("lemma1"),
        "theorem1_violations": certificate.count("theorem1"),
        "inconsistencies": len(fit.inconsistencies),
    }


SYSTEM: Final = SystemMethod("system", "System Predicates", absences=False)
SYSTEM_ABSENCE: Final = SystemMethod(
    "system-absence", "System Predicates with absences", absences=True
)
