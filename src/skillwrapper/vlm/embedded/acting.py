"""Answering the next-action prompt: a guess at what brings the picture nearer to the goal."""

from __future__ import annotations

from skillwrapper.vlm.embedded.chance import Chance
from skillwrapper.vlm.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.vlm.embedded.scene import Scene
from skillwrapper.vlm.embedded.sequencing import all_instances
from skillwrapper.vlm.embedded.sight import Sight

_GIVES_UP = 0.03
_LONGEST_PLAN = 4
_FAILED_BEFORE = 0.1


def plan_actions(prompt: PromptText, now: Sight | None, goal: Sight | None, chance: Chance) -> str:
    """Name the differences, then skills on the things that differ."""
    instances = all_instances(prompt)
    if now is None or goal is None or not instances:
        return "I cannot make out the pictures.\n\nImpossible"
    differing = differing_things(now.scene, goal.scene)
    if not differing:
        return "Everything is as in the goal picture.\n\nDone"
    reasoning = f"What differs from the goal: {', '.join(sorted(differing))}."
    if chance.happens(_GIVES_UP):
        return f"{reasoning} I see no way to get there.\n\nImpossible"
    failed = {str(call) for call in prompt.calls("Run so far")[-1:]} if _last_failed(prompt) else {}
    weights = [
        _weight(call, differing, goal.scene) * (_FAILED_BEFORE if str(call) in failed else 1)
        for call in instances
    ]
    steps = [chance.pick_weighted(instances, weights) for _ in range(_LONGEST_PLAN)]
    plan = [str(a) for a, b in zip(steps, [None, *steps], strict=False) if a != b]
    return "\n".join([reasoning, "", *plan, "Done"])


def differing_things(now: Scene, goal: Scene) -> frozenset[str]:
    """Things that lie elsewhere, are held otherwise or look different in the goal."""
    names = {thing.name for thing in (*now.things, *goal.things)}
    return frozenset(
        name
        for name in names
        if now.on.get(name) != goal.on.get(name)
        or now.held.get(name) != goal.held.get(name)
        or now.attributes.get(name, frozenset()) != goal.attributes.get(name, frozenset())
    )


def _weight(call: WrittenCall, differing: frozenset[str], goal: Scene) -> float:
    """Skills on things that differ come to mind, most of all with where they are to lie."""
    moved = [name for name in call.arguments if name in differing]
    if not moved:
        return 0.02
    places = {goal.on.get(name) for name in moved}
    return 4.0 if places & set(call.arguments) else 1.0


def _last_failed(prompt: PromptText) -> bool:
    lines = [line for line in prompt.lines("Run so far") if line.startswith("- ")]
    return bool(lines) and lines[-1].endswith("failed")
