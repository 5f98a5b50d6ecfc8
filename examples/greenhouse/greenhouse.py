"""The greenhouse itself: its states, when skills work, what they change.

This is the physics of a toy; a real robot has the world instead, and then a class with ``look`` and
``run`` is all it takes (``skillwrapper.Robot``). Nothing that learns ever looks in here: it gets
pictures, and whether a skill worked.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from drawing import draw_greenhouse
from PIL import Image

import skillwrapper
from skillwrapper import SkillInstance


@dataclass(frozen=True)
class State:
    """How things are.

    Attributes:
        covered: pairs of a pot and the bell over it; a bell in no pair is in the robot's hand.
        wet: the pots whose soil is wet.
        trimmed: the pots whose plant is trimmed.
    """

    covered: frozenset[tuple[str, str]]
    wet: frozenset[str] = frozenset()
    trimmed: frozenset[str] = frozenset()

    def bell_over(self, pot: str) -> str | None:
        """The bell over a pot; None if there is none."""
        return dict(self.covered).get(pot)

    def is_held(self, bell: str) -> bool:
        """Whether a bell is in the robot's hand."""
        return all(bell != other for _, other in self.covered)


class Greenhouse(skillwrapper.Simulator[State]):
    """A robot that tends plants."""

    def start(self) -> State:
        """Every bell covers a pot; all soil is dry and no plant is trimmed."""
        return State(frozenset(zip(self._names("pot"), self._names("bell"), strict=False)))

    def obstacle(self, state: State, instance: SkillInstance) -> str | None:
        """Why a skill fails in a state; None if it works."""
        return next(self._obstacles(state, instance), None)

    def effect(self, state: State, instance: SkillInstance) -> State:
        """How things are after a skill that works."""
        match instance.skill, instance.arguments:
            case "Lift", (_, bell):
                left = frozenset(pair for pair in state.covered if bell not in pair)
                return replace(state, covered=left)
            case "Cover", (_, bell, pot):
                return replace(state, covered=state.covered | {(pot, bell)})
            case "Water", (_, pot):
                return replace(state, wet=state.wet | {pot})
            case _, (_, pot):
                return replace(state, trimmed=state.trimmed | {pot})

    def draw(self, state: State, layout: int) -> Image.Image:
        """The picture of a state."""
        return draw_greenhouse(self.scene.names, state, layout)

    def _obstacles(self, state: State, instance: SkillInstance) -> Iterator[str]:
        match instance.skill, instance.arguments:
            case "Lift", _:
                if any(map(state.is_held, self._names("bell"))):
                    yield "the hand is full"
            case "Cover", (_, bell, pot):
                if not state.is_held(bell):
                    yield f"the {bell} is not in the hand"
                if state.bell_over(pot):
                    yield f"the {pot} is covered"
            case "Water", (_, pot):
                if state.bell_over(pot):
                    yield f"the {pot} is covered"
                if pot in state.wet:
                    yield f"the {pot} is wet"
            case "Trim", (_, pot):
                if state.bell_over(pot):
                    yield f"the {pot} is covered"
                if pot not in state.wet:
                    yield f"the {pot} is dry"
                if pot in state.trimmed:
                    yield f"the {pot} is trimmed"

    def _names(self, kind: str) -> list[str]:
        """Names of the things of a type that are present."""
        return [thing.name for thing in self.scene.objects if kind in thing.types]
