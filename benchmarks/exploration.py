"""Executions until the model is exact, with a known vocabulary and right labels: the chooser alone.

The burger kitchen with the expert's predicates, read off the true state; episodes of 15. Exact is
a model with precision, effect accuracy and every skill's recall 1. Run:
``python -m benchmarks.exploration [planned | random] [SEEDS] [EXECUTIONS] [FIRST SEED]``; with one
seed every choice is printed with its reason.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Iterable, Sequence

import numpy as np

from skillwrapper.domains.burger import rules
from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.expert import expert_atoms, expert_model
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.evaluation.exact.predictions import predict_all
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.exploration.explorer import Explorer, Situation
from skillwrapper.exploration.explorers import make_explorer
from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import AbstractModel
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world import Episode, Observation, Picture, Transition

LENGTH = 15
ENVIRONMENT = BurgerEnvironment()
DOMAIN = ENVIRONMENT.domain
PREDICATES = expert_model().predicates


class Eye:
    """Reads states off pictures that write them down."""

    def __init__(self) -> None:
        self._true: dict[str, frozenset[object]] = {}

    def observe(self, state: BurgerState) -> Observation:
        seen = Observation((Picture(repr(state).encode()),))
        self._true.setdefault(seen.key, frozenset(expert_atoms(state)))
        return seen

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        rows = [[a in self._true[o.key] for a in space.atoms] for o in observations]
        return np.array(rows, dtype=np.int8).reshape(len(observations), len(space.atoms))

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing is asked for."""


class Judge:
    """Holds models against the whole state space."""

    def __init__(self) -> None:
        self.space = StateSpace.of(ENVIRONMENT)
        self.atoms = AtomSpace(PREDICATES, DOMAIN.objects)
        true = (frozenset(expert_atoms(state)) for state in self.space.states)
        self.labels = np.array([[a in t for a in self.atoms.atoms] for t in true], dtype=np.int8)

    def is_exact(self, model: AbstractModel) -> bool:
        ground = GroundModel.from_operators(model.operators, self.atoms)
        found = predict_all(ground, self.space, self.labels)
        return bool(
            (found.applicable == self.space.success).all()
            and found.effects_made.sum() == found.effects_right.sum()
        )


class Nobody:
    """Proposes nothing."""

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        return ProposalAnswer(())


def explore(
    explorer: Explorer, most: int, is_exact: Callable[[AbstractModel], bool], told: bool = False
) -> tuple[int | None, list[float]]:
    """Executions until the model is exact, or None, and the seconds that each choice took."""
    eye, recorded = Eye(), RecordedTransitions(DOMAIN)
    labeller, learner = Labeller(recorded, eye), FaithfulLearner()
    scene, seconds, judged = DOMAIN.scene(), [], None

    def learn() -> Fit:
        return learner.learn(labeller.label(PREDICATES))

    while len(recorded) < most:
        state, done = BurgerState(), []
        while len(done) < LENGTH and len(recorded) < most:
            seen = eye.observe(state)
            situation = Situation(
                scene,
                seen,
                tuple(done),
                LENGTH - len(done),
                learn,
                lambda space, seen=seen: eye.labels(space, [seen])[0],
            )
            started = time.process_time()
            chosen = explorer.next_skill(situation)
            seconds.append(time.process_time() - started)
            if chosen.instance is None:
                break
            success = rules.obstacle(state, chosen.instance) is None
            state = rules.effect(state, chosen.instance) if success else state
            done.append(Transition(seen, chosen.instance, success, eye.observe(state)))
            recorded.add(Episode(scene, 0, (done[-1],)))
            if told:
                print(f"{len(recorded):3d} {chosen.instance!s:32} {success!s:5} {chosen.reason}")
            model = learn().model
            if model.operators != judged:
                judged = model.operators
                if is_exact(model):
                    return len(recorded), seconds
        explorer.record(Episode(scene, 0, tuple(done)))
    return None, seconds


def main(name: str = "planned", seeds: int = 6, most: int = 150, first: int = 20) -> None:
    """Print the executions of every seed, and how long choices take."""
    judge, taken, seconds = Judge(), [], []
    for seed in range(first, first + seeds):
        settings = ExplorationSettings(explorer=name, budget=LENGTH)
        explorer = make_explorer(DOMAIN, Nobody(), settings, seed)
        executions, own = explore(explorer, most, judge.is_exact, told=seeds == 1)
        taken.append(most + 1 if executions is None else executions)
        seconds += own
        print(f"{name}, seed {seed}: {executions or f'not exact after {most}'}", flush=True)
    soon = sum(n <= 75 for n in taken)
    print(
        f"{name}: median {statistics.median(taken):g}, worst {max(taken)}, within 75: {soon} of "
        f"{seeds}; a choice takes {statistics.median(seconds):.3f} s in the median, "
        f"{max(seconds):.3f} s at most"
    )


if __name__ == "__main__":
    main(*sys.argv[1:2], *map(int, sys.argv[2:]))
