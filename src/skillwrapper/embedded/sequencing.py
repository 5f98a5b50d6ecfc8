"""Answering the proposal prompt: random walks that follow what the prompt asks and tells."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.imagination import Belief, Imagination, Reached
from skillwrapper.embedded.noise import Judgement
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.embedded.sight import Sight
from skillwrapper.embedded.told_rules import Doubt, Facts, seen_facts, told_rules
from skillwrapper.vlm.parsing.calls import find_calls

_SAME_OBJECT = 4.0
_REPEATED = 0.05
_MEANT_TO_WORK = 0.6
"""Share of steps that ought to work, by what the prompt tells of the skills."""
_DOUBTED = 0.6
"""Share of the other steps against which only a little of what is told speaks: it may be wrong."""
_SCARCE = 0.4
"""How likely a step begins to bring about a pair that ends in a skill that seldom worked."""
_NEW_AIM = 0.8
"""How likely one that is no test begins to bring about one of the least explored pairs."""
_TEST = 0.5
"""How likely another step begins to test a need that only may matter."""
_COUNT = r"[Pp]lan (\d+) different"
_LENGTH = r"at least (\d+) skills"
_SELDOM = "Skills that seldom worked so far"

Pair = tuple[WrittenCall, WrittenCall]
"""Two calls, one right after the other."""


def all_instances(prompt: PromptText) -> tuple[WrittenCall, ...]:
    """All skills on all objects of the right types, in the order of the prompt."""
    return tuple(
        WrittenCall(skill.name, names)
        for skill in prompt.skills
        for names in itertools.permutations(prompt.objects, len(skill.types))
        if all(t in prompt.objects[n] for t, n in zip(skill.types, names, strict=True))
    )


def propose_sequences(
    prompt: PromptText, sight: Sight | None, judgement: Judgement, chance: Chance
) -> str:
    """As many sequences as wanted, as long as wanted."""
    walker = _Walker(prompt, seen_facts(prompt, sight, judgement))
    count, length = prompt.number(_COUNT, 5), prompt.number(_LENGTH, 15)
    blocks = []
    for number in range(1, count + 1):
        steps = walker.walk(length, chance)
        blocks.append("\n".join([f"Sequence {number}:", *map(str, steps)]))
    return "\n\n".join(blocks)


@dataclass
class _Walk:
    """A sequence in the making.

    Attributes:
        belief: what may be true by now.
        steps: the skills so far.
        intended: the next skills, if something is being brought about.
        tested: the needs that were tested on the way.
        paired: the pairs that were brought about on the way.
    """

    belief: Belief
    tested: set[Doubt] = field(default_factory=set)
    paired: set[Pair] = field(default_factory=set)
    steps: list[WrittenCall] = field(default_factory=list)
    intended: list[WrittenCall] = field(default_factory=list)


class _Walker:
    """Knows what the prompt asks to prefer, and draws the rest."""

    def __init__(self, prompt: PromptText, facts: Facts) -> None:
        self._facts = facts
        self._instances = all_instances(prompt)
        rules = told_rules(prompt.lines("What is known of the skills"))
        self._mind = Imagination(rules, self._instances, prompt.objects)
        self._pairs = tuple(_pairs(prompt.lines("Least explored pairs")))
        scarce = {line.removeprefix("- ") for line in prompt.lines(_SELDOM)}
        self._scarce_pairs = tuple(pair for pair in self._pairs if pair[1].name in scarce)
        self._instances_of = Counter(call.name for call in self._instances)
        everywhere = [set(call.arguments) for call in self._instances]
        self._common = set.intersection(*everywhere) if everywhere else set()

    def walk(self, length: int, chance: Chance) -> list[WrittenCall]:
        walk = _Walk((self._facts,))
        while self._instances and len(walk.steps) < length:
            step = self._step(walk, chance)
            walk.steps.append(step)
            walk.belief = self._mind.after(walk.belief, step)
        return walk.steps

    def _step(self, walk: _Walk, chance: Chance) -> WrittenCall:
        """The next skill: on the way to a test or a pair, or one that ought to work, or another."""
        if not walk.intended and chance.happens(_SCARCE):
            walk.intended = self._way_to_pair(walk, self._scarce_pairs, chance)
        if not walk.intended and chance.happens(_TEST):
            walk.intended = self._way_to_test(walk, chance)
        if not walk.intended and chance.happens(_NEW_AIM):
            walk.intended = self._way_to_pair(walk, self._pairs, chance)
        if walk.intended:
            return walk.intended.pop(0)
        working = self._mind.surely_working(walk.belief)
        chosen: Sequence[WrittenCall]
        if chance.happens(_MEANT_TO_WORK):
            chosen = working
        elif chance.happens(_DOUBTED):
            chosen = self._mind.outlook(walk.belief[0]).doubtful
        else:
            chosen = [call for call in self._instances if call not in working]
        return self._draw(chosen or self._instances, walk, chance)

    def _way_to_pair(self, walk: _Walk, pairs: Sequence[Pair], chance: Chance) -> list[WrittenCall]:
        """A pair that was not brought about yet, after a way to it; empty if none is in reach.

        The earlier the prompt names a pair, the likelier it is chosen. A skill of which nothing
        is told is run right away.
        """
        left = [pair for pair in pairs if pair not in walk.paired]
        while left:
            weights = [1 / rank for rank in range(1, len(left) + 1)]
            first, second = pair = chance.pick_weighted(left, weights)
            left.remove(pair)
            way = self._way_to(walk.belief, first) if self._mind.knows(first) else []
            if way is not None:
                walk.paired.add(pair)
                return [*way, first, second]
        return []

    def _way_to(self, belief: Belief, aim: WrittenCall) -> list[WrittenCall] | None:
        """A shortest way to where a call ought to work; None if there is none."""
        for reached in self._foreseen(belief):
            for now, way in reached:
                if aim in self._mind.surely_working(now):
                    return way
        return None

    def _way_to_test(self, walk: _Walk, chance: Chance) -> list[WrittenCall]:
        """A shortest way to a test that was not made yet, and the test; empty if none is found."""
        for reached in self._foreseen(walk.belief):
            found = [
                ([*way, call], doubt)
                for now, way in reached
                for call, doubt in self._mind.sure_tests(now)
                if doubt not in walk.tested
            ]
            if found:
                way, doubt = chance.pick(found)
                walk.tested.add(doubt)
                return way
        return []

    def _foreseen(self, belief: Belief) -> Iterator[list[Reached]]:
        """What is sure to be reached; then what is reached if the likeliest is true."""
        yield from self._mind.reachable(belief)
        if len(belief) > 1:
            yield from self._mind.reachable(belief[:1])

    def _draw(self, calls: Sequence[WrittenCall], walk: _Walk, chance: Chance) -> WrittenCall:
        last = walk.steps[-1] if walk.steps else None
        return chance.pick_weighted(calls, [self._weight(last, call) for call in calls])

    def _weight(self, last: WrittenCall | None, call: WrittenCall) -> float:
        weight: float = self._instances_of[call.name] ** -0.5  # between every skill and every call
        if last is None:
            return weight
        if last == call:
            weight *= _REPEATED
        shared = set(last.arguments) & set(call.arguments) - self._common
        return weight * (_SAME_OBJECT if shared else 1.0)


def _pairs(lines: Sequence[str]) -> list[Pair]:
    found = [find_calls(line) for line in lines if line.startswith("- ")]
    return [
        (WrittenCall(c[0].name, c[0].arguments), WrittenCall(c[1].name, c[1].arguments))
        for c in found
        if len(c) == 2
    ]
