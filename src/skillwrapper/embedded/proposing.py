"""Answering the proposal prompt: walks by chance that heed the hints in the prompt.

It knows what the skills are called, what they are run on and what the prompt asks to try; not
when a skill works, nor what it brings about.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.vlm.parsing.calls import find_calls

_SAME_OBJECT = 4.0
"""How much likelier the next skill is about something that was just handled."""
_SELDOM_WORKED = 3.0
"""How much likelier a skill is that seldom worked so far."""
_WANTED_PAIR = 0.15
"""How likely one of the least explored pairs is run next."""
_COUNT = r"[Pp]lan (\d+) different"
_LENGTH = r"at least (\d+) skills"

Pair = tuple[WrittenCall, WrittenCall]
"""Two calls, one right after the other."""


def propose_sequences(prompt: PromptText, chance: Chance) -> str:
    """As many sequences as wanted, as long as wanted."""
    walker = _Walker(prompt)
    count, length = prompt.number(_COUNT, 5), prompt.number(_LENGTH, 15)
    blocks = []
    for number in range(1, count + 1):
        steps = walker.walk(length, chance)
        blocks.append("\n".join([f"Sequence {number}:", *map(str, steps)]))
    return "\n\n".join(blocks)


class _Walker:
    """Knows what the prompt asks to prefer, and draws the rest."""

    def __init__(self, prompt: PromptText) -> None:
        self._instances = prompt.instances
        self._pairs = _pairs(prompt.lines("Least explored pairs"))
        seldom = prompt.lines("Skills that seldom worked so far")
        self._seldom = {line.removeprefix("- ") for line in seldom}
        self._instances_of = Counter(call.name for call in self._instances)
        everywhere = [set(call.arguments) for call in self._instances]
        self._common = set.intersection(*everywhere) if everywhere else set()

    def walk(self, length: int, chance: Chance) -> list[WrittenCall]:
        """One sequence, with at least one of the least explored pairs in it."""
        steps: list[WrittenCall] = []
        pairs = list(self._pairs)
        first = chance.below(max(1, length - 1))
        while self._instances and len(steps) < length:
            if pairs and (len(steps) == first or chance.happens(_WANTED_PAIR)):
                steps += self._take_pair(pairs, chance)
            else:
                steps.append(self._draw(steps[-1] if steps else None, chance))
        return steps[:length]

    def _take_pair(self, pairs: list[Pair], chance: Chance) -> Pair:
        """The earlier the prompt names a pair, the likelier it is taken."""
        pair = chance.pick_weighted(pairs, [1 / rank for rank in range(1, len(pairs) + 1)])
        pairs.remove(pair)
        return pair

    def _draw(self, last: WrittenCall | None, chance: Chance) -> WrittenCall:
        weights = [self._weight(last, call) for call in self._instances]
        return chance.pick_weighted(self._instances, weights)

    def _weight(self, last: WrittenCall | None, call: WrittenCall) -> float:
        weight: float = self._instances_of[call.name] ** -0.5  # between every skill and every call
        if call.name in self._seldom:
            weight *= _SELDOM_WORKED
        if last is None:
            return weight
        if last == call and len(self._instances) > 1:
            return 0.0
        shared = set(last.arguments) & set(call.arguments) - self._common
        return weight * (_SAME_OBJECT if shared else 1.0)


def _pairs(lines: Sequence[str]) -> tuple[Pair, ...]:
    found = [find_calls(line) for line in lines if line.startswith("- ")]
    return tuple(
        (WrittenCall(c[0].name, c[0].arguments), WrittenCall(c[1].name, c[1].arguments))
        for c in found
        if len(c) == 2
    )
