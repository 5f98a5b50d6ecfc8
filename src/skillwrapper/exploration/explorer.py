"""Choosing the next skill sequence (paper, Section 3.1 and Algorithm 2)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Protocol

import numpy as np

from skillwrapper.exploration.balance import balance
from skillwrapper.exploration.coverage import PairCounts
from skillwrapper.exploration.pareto import pareto_set
from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.exploration.repair import random_sequence, repair_sequence
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.symbols import AbstractModel
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance, ground_skills
from skillwrapper.world.types import Object


class SequenceProposer(Protocol):
    """Who proposes sequences; ``vlm.assistant.Assistant`` is one."""

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        """Sequences, and what of the reply could not be used."""
        ...


@dataclass(frozen=True)
class Situation:
    """Where a sequence will start.

    Attributes:
        objects: the objects of the scene.
        observation: what is seen.
        state: abstract state (atoms,) of the model's vocabulary.
        model: what was learned so far.
        untested: for every operator, by name, the conditions of which nothing shows that they
            matter.
    """

    objects: tuple[Object, ...]
    observation: Observation
    state: Labels
    model: AbstractModel
    untested: Mapping[str, Collection[Condition]] = field(default_factory=dict)


@dataclass(frozen=True)
class Candidate:
    """A sequence with its two scores."""

    sequence: tuple[SkillInstance, ...]
    balance: float
    coverage: float


@dataclass(frozen=True)
class Choice:
    """The chosen sequence and how it was chosen.

    Attributes:
        sequence: what to execute, as long as the budget.
        candidates: all candidates with their scores.
        pareto: indices of the candidates in the Pareto set.
        notes: what was repaired or dropped.
    """

    sequence: tuple[SkillInstance, ...]
    candidates: tuple[Candidate, ...]
    pareto: tuple[int, ...]
    notes: tuple[str, ...]


class Explorer:
    """Proposes what to try next, from what was tried so far."""

    def __init__(
        self, domain: Domain, proposer: SequenceProposer, settings: ExplorationSettings, seed: int
    ) -> None:
        self._domain = domain
        self._proposer = proposer
        self._settings = settings
        self._chance = np.random.default_rng(seed)
        self._successes: Counter[str] = Counter()
        self._followed: Counter[tuple[SkillInstance, SkillInstance]] = Counter()
        self.pairs = PairCounts(domain.skill_instances, lifted=settings.pairs == "skills")

    def record(self, episode: Episode) -> None:
        """Take note of what was executed."""
        self.pairs.add(t.instance for t in episode.transitions)
        self._followed.update(
            (a.instance, b.instance) for a, b in pairwise(episode.transitions) if a.success
        )
        self._successes.update(t.instance.skill for t in episode.transitions if t.success)

    def choose(self, situation: Situation) -> Choice:
        """The next sequence."""
        allowed = ground_skills(self._domain.skills, situation.objects)
        if self._settings.choice == "random":
            drawn = random_sequence(allowed, self._settings.budget, self._chance)
            return Choice(tuple(drawn), (), (), ())
        sequences, notes = self._candidates(situation, allowed)
        candidates = self._score(situation, sequences)
        pool = tuple(range(len(candidates)))
        if self._settings.choice == "pareto":
            pool = pareto_set([(c.balance, c.coverage) for c in candidates])
        chosen = pool[int(self._chance.integers(len(pool)))]
        return Choice(candidates[chosen].sequence, candidates, pool, notes)

    def _candidates(
        self, situation: Situation, allowed: Sequence[SkillInstance]
    ) -> tuple[list[tuple[SkillInstance, ...]], tuple[str, ...]]:
        answer = self._proposer.propose_sequences(self._question(situation, allowed))
        notes = list(answer.unusable)
        sequences = []
        for number, proposed in enumerate(answer.sequences[: self._settings.candidates], start=1):
            repaired, changes = repair_sequence(
                proposed, allowed, self._settings.length, self._chance
            )
            sequences.append(repaired[: self._settings.budget])
            notes += [f"sequence {number}: {change}" for change in changes]
        if not sequences:
            notes.append("no usable sequence was proposed; one is drawn by chance")
            drawn = random_sequence(allowed, self._settings.budget, self._chance)
            sequences.append(tuple(drawn))
        return sequences, tuple(notes)

    def _question(self, situation: Situation, allowed: Sequence[SkillInstance]) -> ProposalQuestion:
        least = self._settings.scarce_successes
        scarce = tuple(s.name for s in self._domain.skills if self._successes[s.name] < least)
        return ProposalQuestion(
            domain=self._domain,
            objects=situation.objects,
            observation=situation.observation,
            predicates=situation.model.predicates,
            operators=tuple(
                describe_operator(o, situation.untested.get(o.name, ()))
                for o in situation.model.operators
            ),
            least_explored=self._least_explored(allowed, scarce),
            scarce_skills=scarce,
            count=self._settings.candidates,
            length=self._settings.length,
        )

    def _least_explored(
        self, allowed: Sequence[SkillInstance], scarce: Sequence[str]
    ) -> tuple[tuple[SkillInstance, SkillInstance], ...]:
        """Pairs of which the second was run least often right after a success of the first.

        Of equals, pairs that end in a scarce skill come first, then pairs about the same thing:
        what a skill needs is mostly brought about by another one on the same object. The rest is
        left to chance.
        """
        everywhere = set.intersection(*(set(i.arguments) for i in allowed)) if allowed else set()
        pairs = [(a, b) for a in allowed for b in allowed if a != b]
        chance = self._chance.permutation(len(pairs))

        def order(number: int) -> tuple[int, bool, bool, int]:
            first, second = pairs[number]
            shared = set(first.arguments) & set(second.arguments) - everywhere
            return (
                self._followed[first, second],
                second.skill not in scarce,
                not shared,
                int(chance[number]),
            )

        ranked = sorted(range(len(pairs)), key=order)
        return tuple(pairs[n] for n in ranked[: self._settings.named_pairs])

    def _score(
        self, situation: Situation, sequences: Sequence[tuple[SkillInstance, ...]]
    ) -> tuple[Candidate, ...]:
        model = GroundModel.of(situation.model, situation.objects)
        target = self._settings.target_ratio
        return tuple(
            Candidate(s, balance(model, situation.state, s, target), self.pairs.gain(s))
            for s in sequences
        )
