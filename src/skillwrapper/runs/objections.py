"""What recorded transitions say against operators."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.predictions import TablePrediction


@dataclass(frozen=True)
class Objection:
    """A transition that speaks against operators.

    Attributes:
        skill: that was run.
        kind: what is wrong, as the middle of a sentence.
        transition: its number.
        subject: the first operator that is wrong, or the first of a skill that takes one more; the
            skill if it has none.
    """

    skill: str
    kind: str
    transition: int
    subject: str


def objections(fit: Fit) -> Iterator[Objection]:
    """All, in order of the skills and of time."""
    for of_skill in fit.each():
        names = [learned.operator.name for learned in of_skill.operators] or [of_skill.skill]
        for prediction in of_skill.predictions:
            found = [
                *_of_rows(prediction, of_skill.skill, "applies where it failed:", failed=True),
                *_of_rows(prediction, of_skill.skill, "says another change of:", failed=False),
                *_missed(prediction, of_skill.skill, names[0]),
            ]
            yield from sorted(found, key=lambda objection: objection.transition)


def new_objections(fit: Fit, known: Fit) -> list[Objection]:
    """What speaks against a model that does not speak against the known one."""
    before = {(o.kind, o.transition) for o in objections(known)}
    return [o for o in objections(fit) if (o.kind, o.transition) not in before]


def _of_rows(
    prediction: TablePrediction, skill: str, kind: str, *, failed: bool
) -> Iterator[Objection]:
    table = prediction.table
    wrong: dict[int, str] = {}
    for application in prediction.applications:
        rows = application.sure if failed else application.mispredicted
        for row in rows[~table.success[rows]] if failed else rows:
            wrong.setdefault(int(table.ids[row]), application.operator.name)
    return (Objection(skill, kind, number, name) for number, name in wrong.items())


def _missed(prediction: TablePrediction, skill: str, subject: str) -> Iterator[Objection]:
    table = prediction.table
    for row in np.flatnonzero(table.success & ~prediction.accounted & ~prediction.undecided):
        yield Objection(skill, "no longer explains:", int(table.ids[row]), subject)
