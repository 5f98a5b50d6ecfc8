"""Answering the proposal prompt: walks by chance that like to stay with an object, and that
often, not always, take a skill of which the prompt's own operators say that it works."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Sequence

from skillwrapper.vlm.embedded.chance import Chance
from skillwrapper.vlm.embedded.noise import Judgement
from skillwrapper.vlm.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.vlm.embedded.rehearsing import Facts, Rehearsal
from skillwrapper.vlm.embedded.sight import Sight
from skillwrapper.vlm.parsing.calls import find_calls

_SAME_OBJECT = 4.0
_SCARCE_SKILL = 2.0
_UNEXPLORED_PAIR = 3.0
_REPEATED = 0.05
_LIKELY_STEPS = 0.7
"""Share of the steps that are taken among those that should work, as far as is known."""
_COUNT = r"[Pp]lan (\d+) different"
_LENGTH = r"at least (\d+) skills"


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
    walker = _Walker(prompt, Rehearsal(prompt, sight, judgement))
    count, length = prompt.number(_COUNT, 5), prompt.number(_LENGTH, 15)
    blocks = []
    for number in range(1, count + 1):
        steps = walker.walk(length, chance)
        blocks.append("\n".join([f"Sequence {number}:", *map(str, steps)]))
    return "\n\n".join(blocks)


class _Walker:
    """Knows what the prompt asks to prefer; holds no rule of when a skill works."""

    def __init__(self, prompt: PromptText, rehearsal: Rehearsal) -> None:
        self._rehearsal = rehearsal
        self._instances = all_instances(prompt)
        self._scarce = frozenset(
            line[2:].strip() for line in prompt.lines("Skills that seldom worked so far")
        )
        self._pairs = frozenset(_pairs(prompt.lines("Least explored pairs")))
        self._instances_of = Counter(call.name for call in self._instances)
        everywhere = [set(call.arguments) for call in self._instances]
        self._common = set.intersection(*everywhere) if everywhere else set()

    def walk(self, length: int, chance: Chance) -> list[WrittenCall]:
        steps: list[WrittenCall] = []
        facts = self._rehearsal.start
        while self._instances and len(steps) < length:
            choices = self._instances
            if chance.happens(_LIKELY_STEPS):
                choices = self._likely(facts) or choices
            weights = [self._weight(steps[-1:], call) for call in choices]
            steps.append(chance.pick_weighted(choices, weights))
            following = self._rehearsal.outcome(facts, steps[-1])
            facts = facts if following is None else following
        return steps

    def _likely(self, facts: Facts) -> tuple[WrittenCall, ...]:
        """What should work as far as is known, and what nothing is known of."""
        rehearsal = self._rehearsal
        return tuple(
            call
            for call in self._instances
            if not rehearsal.is_known(call) or rehearsal.outcome(facts, call) is not None
        )

    def _weight(self, last: Sequence[WrittenCall], call: WrittenCall) -> float:
        weight = 1 / self._instances_of[call.name]  # every skill alike, however many objects fit
        if call.name in self._scarce:
            weight *= _SCARCE_SKILL
        for previous in last:
            if previous == call:
                weight *= _REPEATED
            if (previous, call) in self._pairs:
                weight *= _UNEXPLORED_PAIR
            if set(previous.arguments) & set(call.arguments) - self._common:
                weight *= _SAME_OBJECT
        return weight


def _pairs(lines: Sequence[str]) -> list[tuple[WrittenCall, WrittenCall]]:
    found = [find_calls(line) for line in lines if line.startswith("- ")]
    return [
        (WrittenCall(c[0].name, c[0].arguments), WrittenCall(c[1].name, c[1].arguments))
        for c in found
        if len(c) == 2
    ]
