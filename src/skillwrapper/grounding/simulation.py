"""What a model says of one skill instance after the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding.atom_space import Labels
from skillwrapper.grounding.models import GroundModel
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True, eq=False)
class Simulation:
    """A sequence of skill instances as the model expects it.

    Attributes:
        states: the abstract states (steps + 1, atoms), the start first.
        succeeds: whether each step (steps,) is predicted to succeed; else it changes nothing.
    """

    states: Labels
    succeeds: NDArray[np.bool_]


def simulate(model: GroundModel, start: Labels, sequence: Sequence[SkillInstance]) -> Simulation:
    """Run a sequence in the model; of several operators that surely apply the first one counts.

    Args:
        model: the operators.
        start: abstract state (atoms,) to start from.
        sequence: skill instances over the objects of the scene.
    """
    states = np.empty((len(sequence) + 1, len(start)), dtype=np.int8)
    succeeds = np.zeros(len(sequence), dtype=np.bool_)
    states[0] = start
    for number, instance in enumerate(sequence):
        after = _next(model, states[number], instance)
        succeeds[number] = after is not None
        states[number + 1] = states[number] if after is None else after
    return Simulation(states, succeeds)


def _next(model: GroundModel, state: Labels, instance: SkillInstance) -> Labels | None:
    for bindings in model.bind(state[np.newaxis], [instance]):
        sure = bindings.sure
        if len(sure):
            first: Labels = sure.select(slice(1)).successors()[0]
            return first
    return None
