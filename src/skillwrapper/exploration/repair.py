"""Making a proposed sequence one that can be run, and saying what was changed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from skillwrapper.world.skills import SkillInstance


def repair_sequence(
    sequence: Sequence[SkillInstance],
    allowed: Sequence[SkillInstance],
    length: int,
    chance: np.random.Generator,
) -> tuple[tuple[SkillInstance, ...], tuple[str, ...]]:
    """A sequence of exactly ``length`` allowed instances, none twice in a row, and the repairs.

    Instances that are not in the scene and immediate repetitions go; what is missing at the end
    is drawn by chance; what is too long is cut.
    """
    notes = []
    kept: list[SkillInstance] = []
    for instance in sequence:
        if instance not in allowed:
            notes.append(f"dropped {instance}: not in this scene")
        elif kept and kept[-1] == instance:
            notes.append(f"dropped a repetition of {instance}")
        else:
            kept.append(instance)
    if len(kept) > length:
        notes.append(f"cut {len(kept) - length} skills at the end")
    if len(kept) < length:
        notes.append(f"added {length - len(kept)} skills by chance at the end")
        kept += random_sequence(allowed, length - len(kept), chance, after=kept[-1:])
    return tuple(kept[:length]), tuple(notes)


def random_sequence(
    allowed: Sequence[SkillInstance],
    length: int,
    chance: np.random.Generator,
    after: Sequence[SkillInstance] = (),
) -> list[SkillInstance]:
    """Instances drawn uniformly, none twice in a row unless there is only one."""
    drawn = list(after)
    while len(drawn) < length + len(after):
        choices = [i for i in allowed if not drawn or i != drawn[-1]] or list(allowed)
        drawn.append(choices[int(chance.integers(len(choices)))])
    return drawn[len(after) :]
