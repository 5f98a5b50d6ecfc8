"""A small world to explore: a lamp behind doors, and things that nothing ties."""

from __future__ import annotations

from notebook import Notebook, make_domain, picture

from skillwrapper.exploration.explorer import Situation
from skillwrapper.symbols import Predicate
from skillwrapper.world import Episode, SkillInstance, Transition

HOUSE = make_domain(
    types={"hand": (), "thing": (), "door": ("thing",), "lamp": ("thing",)},
    objects={"h": "hand", "front": "door", "back": "door", "lamp": "lamp"},
    skills={"Open": "hand door", "Light": "hand lamp", "Tie": "hand thing thing"},
)
OPEN, AIRY = Predicate("open", ("door",)), Predicate("airy", ())
SCENE = HOUSE.scene()


class House:
    """Doors open one after the other; the lamp can only be lit where it is airy. Nothing ties."""

    def __init__(self) -> None:
        self.notebook = Notebook(HOUSE, OPEN, AIRY)
        self.state = ""
        self.done: list[Transition] = []

    def situation(self, left: int = 9) -> Situation:
        seen = picture(self.state)
        return Situation(
            SCENE, seen, tuple(self.done), left, self.notebook.fit,
            lambda space: self.notebook.labels(space, [seen])[0],
        )  # fmt: skip

    def run(self, chosen: SkillInstance) -> bool:
        works = {
            "Open": "open(front)" in self.state or chosen.arguments[1] == "front",
            "Light": "open(back)" in self.state,
            "Tie": False,
        }[chosen.skill]
        after = self.state
        if works and chosen.skill == "Open" and str(chosen.arguments[1]) not in after:
            after = (
                "open(front)" if chosen.arguments[1] == "front" else f"{after} open(back) airy()"
            )
        before, then = picture(self.state), picture(after)
        self.done.append(Transition(before, chosen, works, then))
        self.notebook.recorded.add(Episode(SCENE, 0, (self.done[-1],)))
        self.state = after
        return works

    def reset(self) -> Episode:
        episode = Episode(SCENE, 0, tuple(self.done))
        self.state, self.done = "", []
        return episode
