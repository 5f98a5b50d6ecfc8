"""Exploration efficiency: what the executions of a learning method were worth.

The paper says that such a metric is missing. Ours: how much of the exact model is known after how
many executions, how many executions taught anything, how many pairs of skills were tried.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from skillwrapper.evaluation.exact.learning_curves import CurvePoint, area_under, learning_curve
from skillwrapper.evaluation.methods.method import Prepared
from skillwrapper.exploration.scores import PairCounts
from skillwrapper.learning.clusters import cluster_successes
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.operators import cluster_operators
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.perception.labelling import Labeller, TruthSource
from skillwrapper.symbols import Operator, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.domain import Domain


@dataclass(frozen=True)
class Efficiency:
    """What executions were worth.

    Attributes:
        curve: a point for every iteration; empty where there are no exact figures.
        area: area under recall over executions, as a share of what an all-knowing learner has;
            recall is 0 before the first iteration ends, and constant between two ends. None where
            there are no exact figures.
        changing: share of executions after which relearning, with the final vocabulary, gives
            other operators than before.
        pairs_covered: share of pairs of skill instances that were tried one after the other.
    """

    curve: tuple[CurvePoint, ...]
    area: float | None
    changing: float
    pairs_covered: float

    def to_json(self) -> dict[str, Any]:
        """Plain data with the attributes as keys."""
        return {**vars(self), "curve": [vars(point) for point in self.curve]}


def efficiency_of(prepared: Prepared, domain: Domain) -> Efficiency | None:
    """The efficiency of a method; None for one that executes nothing to learn."""
    if not prepared.episodes or prepared.recorded is None:
        return None
    curve = learning_curve(prepared.stages, prepared.exact) if prepared.exact else ()
    vocabulary = prepared.stages[-1].model.predicates
    pairs = PairCounts(domain.skill_instances)
    for episode in prepared.episodes:
        pairs.add(t.instance for t in episode.transitions)
    return Efficiency(
        curve=curve,
        area=area_under([(p.executions, p.recall) for p in curve]),
        changing=share_changing(domain, prepared, prepared.recorded, vocabulary),
        pairs_covered=pairs.share_covered(),
    )


def share_changing(
    domain: Domain, prepared: Prepared, recorded: TruthSource, predicates: Sequence[Predicate]
) -> float:
    """Share of executions that change what is learned with the final vocabulary.

    Operators are learned as they are before they are mended (docs/semantics.md, D5): mending looks
    at all predictions, which takes too long after every single execution.
    """
    done, changes = RecordedTransitions(domain), 0
    labeller = Labeller(done, recorded)
    settings = LearnerSettings(absences=prepared.absences)
    known: dict[str, tuple[Operator, ...]] = {}
    for episode in prepared.episodes:
        for transition in episode.transitions:
            done.add(replace(episode, transitions=(transition,)))
            skill = domain.skill_by_name[transition.instance.skill]
            data = labeller.label(predicates).of_skill(skill.name)
            language = OperatorLanguage(domain, skill, predicates, settings)
            found = cluster_operators(language, cluster_successes(data))
            learned = tuple(o.operator for o in found)
            changes += learned != known.get(skill.name, ())
            known[skill.name] = learned
    return changes / len(done) if len(done) else 0.0
