"""Answering the proposal prompt: random walks that follow what the prompt asks and tells."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from skillwrapper.vlm.embedded.chance import Chance
from skillwrapper.vlm.embedded.noise import Judgement
from skillwrapper.vlm.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.vlm.embedded.sight import Sight
from skillwrapper.vlm.embedded.told_rules import MANY, Facts, seen_facts, told_rules
from skillwrapper.vlm.parsing.calls import find_calls

_SAME_OBJECT = 4.0
_REPEATED = 0.05
_MEANT_TO_WORK = 0.6
"""Share of steps that ought to work, by what the prompt tells of the skills."""
_DOUBTED = 0.6
"""Share of the other steps against which only a little of what is told speaks: it may be wrong."""
_NEW_AIM = 0.65
"""How likely a step begins to bring about one of the least explored pairs."""
_FARTHEST = 3
"""How many steps ahead a way to a skill that works is looked for."""
_COUNT = r"[Pp]lan (\d+) different"
_LENGTH = r"at least (\d+) skills"


@dataclass(frozen=True)
class _Outlook:
    """What can be expected where certain facts are true.

    Attributes:
        working: calls that ought to work, with the facts afterwards.
        doubtful: calls against which something speaks, but not everything.
    """

    working: dict[WrittenCall, Facts]
    doubtful: tuple[WrittenCall, ...]


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
        facts: what ought to be true by now.
        steps: the skills so far.
        intended: the next skills, if a pair is being brought about.
    """

    facts: Facts
    steps: list[WrittenCall] = field(default_factory=list)
    intended: list[WrittenCall] = field(default_factory=list)


class _Walker:
    """Knows what the prompt asks to prefer and tells of the skills, and no rule of its own."""

    def __init__(self, prompt: PromptText, facts: Facts) -> None:
        self._objects, self._facts = prompt.objects, facts
        self._instances = all_instances(prompt)
        self._rules = told_rules(prompt.lines("What is known of the skills"))
        self._pairs = tuple(_pairs(prompt.lines("Least explored pairs")))
        self._instances_of = Counter(call.name for call in self._instances)
        everywhere = [set(call.arguments) for call in self._instances]
        self._common = set.intersection(*everywhere) if everywhere else set()
        self._outlooks: dict[Facts, _Outlook] = {}

    def walk(self, length: int, chance: Chance) -> list[WrittenCall]:
        walk = _Walk(self._facts)
        while self._instances and len(walk.steps) < length:
            step = self._step(walk, chance)
            walk.steps.append(step)
            walk.facts = self._outlook(walk.facts).working.get(step, walk.facts)
        return walk.steps

    def _step(self, walk: _Walk, chance: Chance) -> WrittenCall:
        """The next skill: on the way to a pair, or one that ought to work, or another."""
        if not walk.intended and self._pairs and chance.happens(_NEW_AIM):
            first, second = self._pairs[chance.below(len(self._pairs))]
            walk.intended = [*self._way_to(first, walk.facts), first, second]
        if walk.intended:
            return walk.intended.pop(0)
        outlook = self._outlook(walk.facts)
        chosen: Sequence[WrittenCall]
        if chance.happens(_MEANT_TO_WORK):
            chosen = list(outlook.working)
        elif chance.happens(_DOUBTED):
            chosen = outlook.doubtful
        else:
            chosen = [call for call in self._instances if call not in outlook.working]
        return self._draw(chosen or self._instances, walk, chance)

    def _way_to(self, aim: WrittenCall, facts: Facts) -> list[WrittenCall]:
        """A shortest way to where a skill ought to work; empty if none is found."""
        frontier: list[tuple[Facts, list[WrittenCall]]] = [(facts, [])]
        seen = {facts}
        for _ in range(_FARTHEST + 1):
            following: list[tuple[Facts, list[WrittenCall]]] = []
            for now, way in frontier:
                working = self._outlook(now).working
                if aim in working:
                    return way
                for call, outcome in working.items():
                    if outcome not in seen:
                        seen.add(outcome)
                        following.append((outcome, [*way, call]))
            frontier = following
        return []

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

    def _outlook(self, facts: Facts) -> _Outlook:
        if facts not in self._outlooks:
            imagined = [(call, *self._imagine(call, facts)) for call in self._instances]
            self._outlooks[facts] = _Outlook(
                {call: following for call, unmet, following in imagined if unmet == 0},
                tuple(call for call, unmet, _ in imagined if 0 < unmet < MANY),
            )
        return self._outlooks[facts]

    def _imagine(self, call: WrittenCall, facts: Facts) -> tuple[int, Facts]:
        """By the rule that has the least against the call; without any, nothing is known."""
        best = (MANY, facts)
        for rule in self._rules:
            if rule.skill == call.name and rule.arity == len(call.arguments):
                best = min(best, rule.imagine(call, facts, self._objects), key=lambda i: i[0])
        return best


def _pairs(lines: Sequence[str]) -> list[tuple[WrittenCall, WrittenCall]]:
    found = [find_calls(line) for line in lines if line.startswith("- ")]
    return [
        (WrittenCall(c[0].name, c[0].arguments), WrittenCall(c[1].name, c[1].arguments))
        for c in found
        if len(c) == 2
    ]
