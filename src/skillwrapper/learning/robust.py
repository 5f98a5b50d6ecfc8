"""The robust learner: takes labels for what they are worth (D24)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.predictions import predict
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.transitions.labelled import Confidence, LabelledTransitions
from skillwrapper.world.skills import Skill


class RobustLearner(FaithfulLearner):
    """Learns as the faithful one does, and then doubts operators that rest on one transition.

    Such an operator is left out if wrong labels explain its transition at a lower price than the
    violations that it causes; what it was learned from stays in sight, as a violation. Labels
    without a doubt are never explained away, so from these both learners learn the same.

    Args:
        settings: what conditions may say, and which labels count.
    """

    def __init__(self, settings: LearnerSettings | None = None) -> None:
        super().__init__(settings)
        # A violation is no likelier than that a label is wrong that just counts.
        self._violation = -math.log(max(1e-6, 1 - self._settings.least_confidence))

    def learn(self, transitions: LabelledTransitions) -> Fit:
        """Operators of all skills; skills without transitions have none."""
        fit = super().learn(transitions)
        if all(x.is_certain for scene in transitions.scenes for x in scene.labels):
            return fit
        doubts = _Doubts(transitions)

        def learn_skill(skill: Skill) -> SkillFit:
            leaner = self._without_doubtful(fit.skill(skill.name), doubts)
            return replace(leaner, frail=tuple(sorted(doubts.frail(leaner))))

        return Fit(fit.domain, fit.predicates, learn_skill)

    def _without_doubtful(self, fit: SkillFit, doubts: _Doubts) -> SkillFit:
        while fit.witnesses:
            leaner = (self._worthwhile(fit, learned, doubts) for learned in _resting_on_one(fit))
            better = next((found for found in leaner if found is not None), None)
            if better is None:
                break
            fit = better
        return fit

    def _worthwhile(
        self, fit: SkillFit, learned: LearnedOperator, doubts: _Doubts
    ) -> SkillFit | None:
        """The fit without an operator; None if that explains less than it costs."""
        rest = tuple(o for o in fit.operators if o is not learned)
        leaner = replace(
            fit,
            operators=rest,
            predictions=predict(tuple(p.table for p in fit.predictions), rest),
            left_out=(*fit.left_out, learned.cluster),
        )
        saved = len(fit.witnesses) - len(leaner.witnesses)
        return leaner if saved * self._violation > doubts.nats(learned) else None


def _resting_on_one(fit: SkillFit) -> Iterator[LearnedOperator]:
    return (learned for learned in fit.operators if len(learned.cluster.ids) == 1)


class _Doubts:
    """How likely the labels around single transitions are wrong."""

    def __init__(self, transitions: LabelledTransitions) -> None:
        self._scenes = transitions.scenes
        self._confidence: dict[int, Confidence] = {}

    def nats(self, learned: LearnedOperator) -> float:
        """What it costs to take a label of its one transition for wrong; without end if none is.

        Labels count that speak of the objects of the operator, before and after.
        """
        (number,) = learned.cluster.ids
        objects = learned.cluster.groups[0].lifting.objects
        for place, scene in enumerate(self._scenes):
            row = np.flatnonzero(scene.executions.ids == number)
            if not len(row):
                continue
            about = [
                column
                for column, atom in enumerate(scene.space.atoms)
                if not atom.terms or set(objects).intersection(atom.terms)
            ]
            states = [int(scene.executions.before[row[0]]), int(scene.executions.after[row[0]])]
            right = float(self._all(place)[np.ix_(states, about)].prod())
            return -math.log1p(-right) if right < 1 else math.inf
        return math.inf

    def frail(self, fit: SkillFit) -> set[int]:
        """Successes that are worth seeing again.

        These are the ones that alone, or in the same picture, show what an operator says; and those
        that seem to do no more than a failure, or hang on a label that is in doubt.
        """
        found = {n for learned in fit.operators for n in self._alone(learned.cluster.ids)}
        found |= {one.first for one in fit.inconsistencies if one.kind is InconsistencyKind.EFFECT}
        for prediction in fit.predictions:
            table = prediction.table
            found |= {int(number) for number in table.ids[table.success & table.hanging]}
        return found

    def _alone(self, numbers: Sequence[int]) -> Sequence[int]:
        """The transitions if all begin in one picture, else none."""
        pictures = {self._picture[number] for number in numbers}
        return numbers[:1] if len(pictures) == 1 else ()

    @cached_property
    def _picture(self) -> dict[int, tuple[int, int]]:
        """Scene and picture in which every transition begins."""
        return {
            int(number): (place, int(before))
            for place, scene in enumerate(self._scenes)
            for number, before in zip(scene.executions.ids, scene.executions.before, strict=True)
        }

    def _all(self, place: int) -> Confidence:
        """The confidence (states, atoms) of all labels of a scene."""
        if place not in self._confidence:
            columns = [x.confidence for x in self._scenes[place].labels]
            self._confidence[place] = np.hstack(columns).astype(np.float64)
        return self._confidence[place]
