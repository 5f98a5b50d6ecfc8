"""Answering the next-action prompt: a guess at what brings the picture nearer to the goal.

It sees what differs between the two pictures, and goes by what skills are called and what they
are run on. It knows neither when a skill works nor what it brings about.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.facts import Fact, Sort
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall, WrittenSkill
from skillwrapper.embedded.sight import Sight

_LONGEST_PLAN = 4
_BESIDE_THE_POINT = 0.02
_TO_ITS_PLACE = 4.0
_BY_ITS_NAME = 8.0
_FAILED_BEFORE = 0.1
_ENDINGS = ("ing", "ed", "en", "es", "e", "s", "d")


@dataclass(frozen=True)
class Difference:
    """Something that is otherwise in the goal's picture.

    Attributes:
        fact: what.
        wanted: whether it is the case in the goal.
    """

    fact: Fact
    wanted: bool

    @property
    def thing(self) -> str:
        """The thing that is otherwise."""
        return self.fact.things[0]


def plan_actions(
    prompt: PromptText, now: Sight | None, goal: Sight | None, lexicon: Lexicon, chance: Chance
) -> str:
    """Name the differences, then skills on the things that differ."""
    if now is None or goal is None or not prompt.instances:
        return "I cannot make out the pictures.\n\nImpossible"
    found = differences(now, goal, lexicon)
    if not found:
        return "Everything is as in the goal picture.\n\nDone"
    reasoning = f"What differs from the goal: {', '.join(sorted({d.thing for d in found}))}."
    if any(_can_only_be_undone(d, prompt.skills, lexicon) for d in found):
        return f"{reasoning} No skill is there to turn that back.\n\nImpossible"
    failed = set(_failed_lately(prompt))
    weights = [
        _weight(call, found, lexicon) * (_FAILED_BEFORE if str(call) in failed else 1)
        for call in prompt.instances
    ]
    steps = [chance.pick_weighted(prompt.instances, weights) for _ in range(_LONGEST_PLAN)]
    plan = [str(a) for a, b in zip(steps, [None, *steps], strict=False) if a != b]
    return "\n".join([reasoning, "", *plan, "Done"])


def differences(now: Sight, goal: Sight, lexicon: Lexicon) -> tuple[Difference, ...]:
    """What seems to look, lie or be held otherwise in the goal's picture."""
    facts = dict.fromkeys((*_facts(now, lexicon), *_facts(goal, lexicon)))
    return tuple(
        Difference(fact, wanted)
        for fact in facts
        if (wanted := goal.holds(fact)) is not now.holds(fact)
    )


def _facts(sight: Sight, lexicon: Lexicon) -> Iterator[Fact]:
    """All that might be the case of things that have names."""
    for thing in sight.graph.things:
        if thing.scenery:
            continue
        for attribute in sight.graph.attributes.get(thing.name, ()):
            yield Fact(Sort.ATTRIBUTE, attribute, (thing.name,))
        for relation in sight.graph.outline.relations:
            yield from lexicon.relation(relation).facts_of(sight, thing.name)


def _weight(call: WrittenCall, found: Sequence[Difference], lexicon: Lexicon) -> float:
    """Skills on things that differ come to mind, most of all those named for it."""
    own = [difference for difference in found if difference.thing in call.arguments]
    weight = 1.0 if own else _BESIDE_THE_POINT
    for difference in own:
        if difference.fact.sort is Sort.ATTRIBUTE:
            named = _is_named_for(call.name, difference, lexicon)
            weight = max(weight, _BY_ITS_NAME if named else 0)
        elif difference.wanted and difference.fact.things[1] in call.arguments:
            weight = max(weight, _TO_ITS_PLACE)
    return weight


def _can_only_be_undone(
    difference: Difference, skills: Sequence[WrittenSkill], lexicon: Lexicon
) -> bool:
    """Whether a skill is named for the opposite of what is wanted, and none for what is."""
    if difference.fact.sort is not Sort.ATTRIBUTE:
        return False
    opposite = Difference(difference.fact, not difference.wanted)
    wanted, unwanted = (
        any(_is_named_for(skill.name, one, lexicon) for skill in skills)
        for one in (difference, opposite)
    )
    return unwanted and not wanted


def _is_named_for(skill: str, difference: Difference, lexicon: Lexicon) -> bool:
    """Whether a skill's name has a word for what is wanted, whatever its ending."""
    words = lexicon.words.attribute(difference.fact.name)
    names = words.names if difference.wanted else words.opposite.names
    stems = {_stem(word) for name in names for word in name.split("_")}
    return not stems.isdisjoint(map(_stem, re.findall(r"[a-z]+|[A-Z][a-z]*", skill)))


def _stem(word: str) -> str:
    word = word.casefold()
    for ending in _ENDINGS:
        if word.endswith(ending) and len(word) - len(ending) >= 3:
            return word.removesuffix(ending)
    return word


def _failed_lately(prompt: PromptText) -> Iterator[str]:
    """What failed since something last succeeded."""
    for line in reversed(prompt.lines("Run so far")):
        if line.startswith("- "):
            if not line.endswith("failed"):
                return
            yield line.removeprefix("- ").removesuffix(" failed")
