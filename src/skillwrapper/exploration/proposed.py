"""Exploring by proposed sequences, as published (paper, Section 3.1, Algorithm 2; D16)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from skillwrapper.exploration.explorer import Candidate, NextSkill, SequenceChoice, Situation
from skillwrapper.exploration.questions import ProposalQuestion, SequenceProposer
from skillwrapper.exploration.scores import PairCounts, balance, pareto_set
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.symbols.describe import describe_operator
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.skills import SkillInstance, ground_skills


class SequenceExplorer:
    """Chooses among proposed sequences by balance and coverage, and runs one to its end.

    Args:
        domain: types and skills.
        proposer: proposes sequences.
        settings: how many, how long, and how one is chosen.
        seed: decides between what is equally good.
    """

    def __init__(
        self, domain: Domain, proposer: SequenceProposer, settings: ExplorationSettings, seed: int
    ) -> None:
        self._domain = domain
        self._proposer = proposer
        self._settings = settings
        self._chance = np.random.default_rng(seed)
        self._successes: Counter[str] = Counter()
        self._followed: Counter[tuple[SkillInstance, SkillInstance]] = Counter()
        self._pairs = PairCounts(domain.skill_instances, lifted=settings.pairs == "skills")
        self._sequence: tuple[SkillInstance, ...] = ()

    def next_skill(self, situation: Situation) -> NextSkill:
        """The next one of the sequence; at the start of an episode a sequence is chosen."""
        position, choice = len(situation.done), None
        if position == 0:
            choice = self.choose(situation)
            self._sequence = choice.sequence
        if position >= len(self._sequence):
            return NextSkill(None, "the sequence has ended")
        reason = f"step {position + 1} of {len(self._sequence)} of the chosen sequence"
        return NextSkill(self._sequence[position], reason, choice)

    def record(self, episode: Episode) -> None:
        """Take note of what was executed."""
        self._pairs.add(t.instance for t in episode.transitions)
        self._followed.update(
            (a.instance, b.instance) for a, b in pairwise(episode.transitions) if a.success
        )
        self._successes.update(t.instance.skill for t in episode.transitions if t.success)

    def choose(self, situation: Situation) -> SequenceChoice:
        """The next sequence."""
        state = situation.state  # what is seen is read before anything is asked for
        sequences, notes = self.propose(situation)
        candidates = self._score(situation, state, sequences)
        pool = tuple(range(len(candidates)))
        if self._settings.choice == "pareto":
            pool = pareto_set([(c.balance, c.coverage) for c in candidates])
        chosen = pool[int(self._chance.integers(len(pool)))]
        return SequenceChoice(candidates[chosen].sequence, candidates, pool, notes)

    def propose(
        self, situation: Situation
    ) -> tuple[list[tuple[SkillInstance, ...]], tuple[str, ...]]:
        """Sequences that can be run, and what was repaired or dropped."""
        allowed = ground_skills(self._domain.skills, situation.scene.objects)
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
        model = situation.fit.model
        return ProposalQuestion(
            domain=self._domain,
            objects=situation.scene.objects,
            observation=situation.observation,
            predicates=model.predicates,
            operators=tuple(
                describe_operator(o, situation.untested.get(o.name, ())) for o in model.operators
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
        self,
        situation: Situation,
        state: Labels,
        sequences: Sequence[tuple[SkillInstance, ...]],
    ) -> tuple[Candidate, ...]:
        model = GroundModel.of(situation.fit.model, situation.scene.objects)
        target = self._settings.target_ratio
        return tuple(
            Candidate(s, balance(model, state, s, target), self._pairs.gain(s)) for s in sequences
        )


def repair_sequence(
    sequence: Sequence[SkillInstance],
    allowed: Sequence[SkillInstance],
    length: int,
    chance: np.random.Generator,
) -> tuple[tuple[SkillInstance, ...], tuple[str, ...]]:
    """A sequence of exactly ``length`` allowed instances, none twice in a row, and the repairs.

    Instances that are not in the scene and immediate repetitions go; what is missing at the end
    is drawn by chance; what is too long is cut.
    """
    notes = []
    kept: list[SkillInstance] = []
    for instance in sequence:
        if instance not in allowed:
            notes.append(f"dropped {instance}: not in this scene")
        elif kept and kept[-1] == instance:
            notes.append(f"dropped a repetition of {instance}")
        else:
            kept.append(instance)
    if len(kept) > length:
        notes.append(f"cut {len(kept) - length} skills at the end")
    if len(kept) < length:
        notes.append(f"added {length - len(kept)} skills by chance at the end")
        kept += random_sequence(allowed, length - len(kept), chance, after=kept[-1:])
    return tuple(kept[:length]), tuple(notes)


def random_sequence(
    allowed: Sequence[SkillInstance],
    length: int,
    chance: np.random.Generator,
    after: Sequence[SkillInstance] = (),
) -> list[SkillInstance]:
    """Instances drawn uniformly, none twice in a row unless there is only one."""
    drawn = list(after)
    while len(drawn) < length + len(after):
        choices = [i for i in allowed if not drawn or i != drawn[-1]] or list(allowed)
        drawn.append(choices[int(chance.integers(len(choices)))])
    return drawn[len(after) :]
