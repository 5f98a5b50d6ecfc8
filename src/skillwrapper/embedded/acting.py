"""Answering the next-action prompt: a guess at what brings the picture nearer to the goal."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.concepts import Concept
from skillwrapper.embedded.lexicon import GENERAL_CONCEPTS
from skillwrapper.embedded.noise import Judgement
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.embedded.scene import Scene
from skillwrapper.embedded.sequencing import all_instances
from skillwrapper.embedded.sight import Sight

_GIVES_UP = 0.03
_LONGEST_PLAN = 4
_FAILED_BEFORE = 0.1

_PLACES = ("on", "on_station", "on_table")
_COMPARED = (*_PLACES, "holding", "cut", "cooked")
_CONCEPTS = {c.key: c for c in GENERAL_CONCEPTS if c.key in _COMPARED}

Looks = dict[str, frozenset[tuple[str, ...]]]
"""Of every item, what is judged to be true of it: a concept and its arguments."""


def plan_actions(
    prompt: PromptText,
    now: Sight | None,
    goal: Sight | None,
    judgement: Judgement,
    chance: Chance,
) -> str:
    """Name the differences, then skills on the things that differ."""
    instances = all_instances(prompt)
    if now is None or goal is None or not instances:
        return "I cannot make out the pictures.\n\nImpossible"
    seen, wanted = looks(now, judgement), looks(goal, judgement)
    differing = differing_things(seen, wanted)
    if not differing:
        return "Everything is as in the goal picture.\n\nDone"
    reasoning = f"What differs from the goal: {', '.join(sorted(differing))}."
    if chance.happens(_GIVES_UP):
        return f"{reasoning} I see no way to get there.\n\nImpossible"
    failed = {str(call) for call in prompt.calls("Run so far")[-1:]} if _last_failed(prompt) else {}
    weights = [
        _weight(call, differing, wanted) * (_FAILED_BEFORE if str(call) in failed else 1)
        for call in instances
    ]
    steps = [chance.pick_weighted(instances, weights) for _ in range(_LONGEST_PLAN)]
    plan = [str(a) for a, b in zip(steps, [None, *steps], strict=False) if a != b]
    return "\n".join([reasoning, "", *plan, "Done"])


def looks(sight: Sight, judgement: Judgement) -> Looks:
    """Where every item lies, who holds it and how it looks, as the model judges it."""
    return {
        name: frozenset(
            (key, *arguments)
            for key, concept in _CONCEPTS.items()
            for arguments in _arguments(concept, name, sight.scene)
            if judgement.truth(concept, sight, arguments)
        )
        for name in sight.scene.names("item")
    }


def differing_things(now: Looks, goal: Looks) -> frozenset[str]:
    """Things that lie elsewhere, are held otherwise or look different in the goal."""
    nothing: frozenset[tuple[str, ...]] = frozenset()
    names = {*now, *goal}
    return frozenset(name for name in names if now.get(name, nothing) != goal.get(name, nothing))


def _arguments(concept: Concept, name: str, scene: Scene) -> Iterator[tuple[str, ...]]:
    """Arguments with which a concept is about an item, the first one of its own kind."""
    own = concept.kinds.index("item")
    others = [
        (name,) if place == own else tuple(n for n in scene.names(kind) if n != name)
        for place, kind in enumerate(concept.kinds)
    ]
    return itertools.product(*others)


def _weight(call: WrittenCall, differing: frozenset[str], goal: Looks) -> float:
    """Skills on things that differ come to mind, most of all with where they are to lie."""
    moved = [name for name in call.arguments if name in differing]
    if not moved:
        return 0.02
    looks_like = (look for name in moved for look in goal.get(name, ()))
    places = {place for key, *rest in looks_like if key in _PLACES for place in rest[1:]}
    return 4.0 if places & set(call.arguments) else 1.0


def _last_failed(prompt: PromptText) -> bool:
    lines = [line for line in prompt.lines("Run so far") if line.startswith("- ")]
    return bool(lines) and lines[-1].endswith("failed")
