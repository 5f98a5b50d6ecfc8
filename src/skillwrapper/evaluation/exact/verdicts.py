"""Verdicts on the paper's definitions, each with a shortest counterexample if it does not hold.

A problem may start in any reachable state, so one wrong step is a wrong plan of length one, and a
plan all of whose steps are right is right. That makes the definitions checkable step by step:

- *sound*: what an applicable operator predicts is what happens (skill and change);
- *complete*: wherever a skill truly leads, some abstract plan leads too;
- *suitable*: a skill instance is applicable in the abstract state if and only if it succeeds in the
  real one, both now and after one step of the model.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from skillwrapper.evaluation.exact.predictions import (
    Pairs,
    Predictions,
    WrongEffects,
    applicable_instances,
)
from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, GroundModel, Labels
from skillwrapper.grounding.search import StateGraph, is_reachable

_IMAGINED_STATES = 10
"""Abstract states looked at, as a multiple of the true ones, before completeness stays open."""


class Verdict(StrEnum):
    """Whether a definition holds."""

    HOLDS = "yes"
    FAILS = "no"
    OPEN = "not decided"
    UNDEFINED = "undefined"
    """There is nothing of which it could be said."""

    @property
    def known(self) -> bool | None:
        """True or false; None if it is neither."""
        return {Verdict.HOLDS: True, Verdict.FAILS: False}.get(self)

    @classmethod
    def together(cls, verdicts: Iterable[Verdict]) -> Verdict:
        """That of several scenes: what fails in one fails."""
        found = set(verdicts)
        order = (cls.FAILS, cls.OPEN, cls.HOLDS)
        return next((verdict for verdict in order if verdict in found), cls.UNDEFINED)


@dataclass(frozen=True)
class Refutation:
    """One place where a definition does not hold.

    Attributes:
        verdict: ``"sound"``, ``"complete"`` or ``"suitable"``.
        reason: what is wrong there, in words.
        state: index of the state before.
        instance: index of the skill instance.
        difference: atoms that are predicted otherwise than seen, with the prediction.
    """

    verdict: str
    reason: str
    state: int
    instance: int
    difference: tuple[str, ...] = ()


@dataclass(frozen=True)
class Verdicts:
    """Which definitions hold.

    Attributes:
        sound: see the module; undefined of a model that predicts nothing.
        complete: see the module; undefined without predicates, or where no skill succeeds; open
            if the search for abstract plans became too large.
        suitable: see the module; undefined if nothing is predicted and nothing succeeds.
        refutations: for each that does not hold, one nearest to the start.
    """

    sound: Verdict
    complete: Verdict
    suitable: Verdict
    refutations: tuple[Refutation, ...] = ()


def judge(model: GroundModel, predictions: Predictions) -> Verdicts:
    """Check all definitions on the whole state space."""
    unsound = _nearest(predictions, _unsound(model.space, predictions))
    unsuitable = _nearest(predictions, _unsuitable(model, predictions))
    complete, incomplete = _completeness(model, predictions)
    predicts, succeeds = predictions.applicable.any(), predictions.space.success.any()
    found = (unsound, incomplete, unsuitable)
    return Verdicts(
        sound=_verdict(unsound, defined=bool(predicts)),
        complete=complete,
        suitable=_verdict(unsuitable, defined=bool(predicts or succeeds)),
        refutations=tuple(refutation for refutation in found if refutation is not None),
    )


def _verdict(refutation: Refutation | None, *, defined: bool) -> Verdict:
    if refutation is not None:
        return Verdict.FAILS
    return Verdict.HOLDS if defined else Verdict.UNDEFINED


def _nearest(predictions: Predictions, found: Iterator[Refutation]) -> Refutation | None:
    distance = predictions.space.distance
    return min(found, key=lambda v: (distance[v.state], v.state, v.instance), default=None)


def _unsound(space: AtomSpace, predictions: Predictions) -> Iterator[Refutation]:
    yield from _pairs(predictions, predictions.false_alarms, "sound", "applies, but fails")
    for wrong in predictions.wrong_effects:
        yield _wrong_effect(space, predictions, wrong)


def _wrong_effect(space: AtomSpace, predictions: Predictions, wrong: WrongEffects) -> Refutation:
    nearest = int(np.argmin(predictions.space.distance[wrong.states]))
    state, instance = int(wrong.states[nearest]), int(wrong.instances[nearest])
    truth = predictions.labels[predictions.space.following[state, instance]]
    predicted = wrong.predicted[nearest]
    return Refutation(
        "sound",
        f"{wrong.operator.name} predicts another change",
        state,
        instance,
        _difference(space, predicted, truth),
    )


def _difference(space: AtomSpace, predicted: Labels, truth: Labels) -> tuple[str, ...]:
    words = {TRUE: "true", UNKNOWN: "unknown"}
    return tuple(
        f"{space.atoms[column]}: predicted {words.get(int(predicted[column]), 'false')}, "
        f"is {words.get(int(truth[column]), 'false')}"
        for column in np.flatnonzero(predicted != truth)
    )


def _unsuitable(model: GroundModel, predictions: Predictions) -> Iterator[Refutation]:
    alarms, missed = predictions.false_alarms, predictions.missed
    yield from _pairs(predictions, alarms, "suitable", "applies, but fails")
    yield from _pairs(predictions, missed, "suitable", "succeeds, but no operator applies")
    for wrong in predictions.wrong_effects:
        after = predictions.space.following[wrong.states, wrong.instances]
        expected = applicable_instances(model, predictions.space, wrong.predicted)
        differs = expected != predictions.space.success[after]
        for number in np.flatnonzero(differs.any(axis=1)):
            other = predictions.space.instances[int(np.argmax(differs[number]))]
            reason = f"{wrong.operator.name} predicts wrongly whether {other} can follow"
            state, instance = int(wrong.states[number]), int(wrong.instances[number])
            yield Refutation("suitable", reason, state, instance)


def _pairs(
    predictions: Predictions, marked: Pairs, verdict: str, reason: str
) -> Iterator[Refutation]:
    """A refutation for each marked pair of state and instance, nearest to the start only."""
    states, instances = np.nonzero(marked)
    if len(states):
        first = int(np.argmin(predictions.space.distance[states]))
        yield Refutation(verdict, reason, int(states[first]), int(instances[first]))


def _completeness(
    model: GroundModel, predictions: Predictions
) -> tuple[Verdict, Refutation | None]:
    """Whether abstract plans lead wherever skills truly lead."""
    space, labels = predictions.space, predictions.labels
    if not (space.success.any() and model.space.atoms):
        return Verdict.UNDEFINED, None  # where all states look the same, no plan leads anywhere
    graph = StateGraph(model, limit=_IMAGINED_STATES * len(space.states))
    states, instances = np.nonzero(space.success & ~predictions.reproduced)
    open_questions = False
    for position in np.argsort(space.distance[states], kind="stable"):
        state, instance = int(states[position]), int(instances[position])
        after = labels[space.following[state, instance]]
        reachable = is_reachable(graph, labels[state], after)
        if reachable is False:
            reason = "succeeds, but no abstract plan leads to what is then seen"
            return Verdict.FAILS, Refutation("complete", reason, state, instance)
        open_questions |= reachable is None
        if open_questions:
            break
    return (Verdict.OPEN if open_questions else Verdict.HOLDS), None
