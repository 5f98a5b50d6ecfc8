"""Cups that can be filled and emptied: the smallest simulator that is learned with pictures."""

from drawing import draw

import skillwrapper


class CupWorld(skillwrapper.Simulator[frozenset[str]]):
    def start(self):
        return frozenset()

    def obstacle(self, state, instance):
        full = instance.arguments[1] in state
        return None if full == (instance.skill == "Empty") else "nothing to do"

    def effect(self, state, instance):
        return state ^ {instance.arguments[1]}

    def draw(self, state, layout):
        return {"top": draw(self.scene.names, state, layout)}
