"""Imagining, by the rules that a prompt tells, what may be true after some calls."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from skillwrapper.embedded.prompt_text import WrittenCall
from skillwrapper.embedded.told_rules import MANY, Doubt, Facts, Imagined, ToldRule

_WORLDS = 2
"""How many ideas of what may be true are kept in mind."""
_FARTHEST = 4
"""How many steps are thought ahead."""

Belief = tuple[Facts, ...]
"""What may be true, the likelier first."""
Reached = tuple[Belief, list[WrittenCall]]
"""What may be true after some calls, and the calls."""


@dataclass(frozen=True)
class Outlook:
    """What can be expected where certain facts are true.

    Attributes:
        working: calls that ought to work, with the facts afterwards.
        doubtful: calls against which something speaks, but not everything.
        tests: for calls against which one thing alone speaks of which it is not sure that it
            matters, these things, and the facts afterwards if it does not.
    """

    working: dict[WrittenCall, Facts]
    doubtful: tuple[WrittenCall, ...]
    tests: dict[WrittenCall, tuple[tuple[Doubt, ...], Facts]]

    def outcomes(self, facts: Facts, call: WrittenCall) -> Belief:
        """What may be true after a call; one that does not work changes nothing."""
        if call in self.working:
            return (self.working[call],)
        return (facts, self.tests[call][1]) if call in self.tests else (facts,)


class Imagination:
    """Knows what the prompt tells of the skills, and no rule of its own.

    Args:
        rules: what is told.
        instances: every call that can be made.
        objects: types of every object.
    """

    def __init__(
        self,
        rules: Sequence[ToldRule],
        instances: Sequence[WrittenCall],
        objects: Mapping[str, frozenset[str]],
    ) -> None:
        self._rules, self._instances, self._objects = rules, instances, objects
        self._outlooks: dict[Facts, Outlook] = {}

    def knows(self, call: WrittenCall) -> bool:
        """Whether anything is told of a skill."""
        return any(rule.skill == call.name for rule in self._rules)

    def after(self, belief: Belief, call: WrittenCall) -> Belief:
        """What may be true after a call; what is least likely is let go."""
        each = [self.outlook(facts).outcomes(facts, call) for facts in belief]
        together = itertools.chain.from_iterable(itertools.zip_longest(*each))
        return tuple(dict.fromkeys(facts for facts in together if facts is not None))[:_WORLDS]

    def surely_working(self, belief: Belief) -> list[WrittenCall]:
        """The calls that ought to work whatever is true."""
        first, *others = (self.outlook(facts).working for facts in belief)
        return [call for call in first if all(call in other for other in others)]

    def sure_tests(self, belief: Belief) -> Iterator[tuple[WrittenCall, Doubt]]:
        """The tests that can be made whatever is true."""
        first, *others = (self.outlook(facts).tests for facts in belief)
        for call, (doubts, _) in first.items():
            for doubt in doubts:
                if all(call in other and doubt in other[call][0] for other in others):
                    yield call, doubt

    def reachable(self, belief: Belief) -> Iterator[list[Reached]]:
        """What may be true after no step, one, two, ..., each with a way to it."""
        frontier: list[Reached] = [(belief, [])]
        seen = {belief}
        for _ in range(_FARTHEST + 1):
            yield frontier
            following: list[Reached] = []
            for now, way in frontier:
                for call in dict.fromkeys(c for facts in now for c in self.outlook(facts).working):
                    outcome = self.after(now, call)
                    if outcome not in seen:
                        seen.add(outcome)
                        following.append((outcome, [*way, call]))
            frontier = following

    def outlook(self, facts: Facts) -> Outlook:
        """What can be expected of every call."""
        if facts not in self._outlooks:
            imagined = {call: self._imagine(call, facts) for call in self._instances}
            self._outlooks[facts] = Outlook(
                {call: i.facts for call, i in imagined.items() if i.unmet == 0},
                tuple(call for call, i in imagined.items() if 0 < i.unmet < MANY),
                {call: (i.doubts, i.facts) for call, i in imagined.items() if i.doubts},
            )
        return self._outlooks[facts]

    def _imagine(self, call: WrittenCall, facts: Facts) -> Imagined:
        """By the rule that has the least against the call; without any, nothing is known."""
        best = Imagined(MANY, facts)
        doubts: dict[Doubt, None] = {}
        for rule in self._rules:
            if rule.skill == call.name and rule.arity == len(call.arguments):
                imagined = rule.imagine(call, facts, self._objects)
                best = min(best, imagined, key=lambda i: i.unmet)
                doubts.update(dict.fromkeys(imagined.doubts))
        return replace(best, doubts=tuple(doubts) if best.unmet else ())
