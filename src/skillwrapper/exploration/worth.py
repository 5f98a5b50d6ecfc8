"""What an attempt is worth: the information that can be expected of it, node by node."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.beliefs import Expectations
from skillwrapper.exploration.lookahead import Lookahead
from skillwrapper.exploration.memory import Memory
from skillwrapper.exploration.roles import SceneRoles

Values = NDArray[np.float64]

_PLAYED = 0.4
"""What new roles of an instance's own arguments count beside what it sees of them."""


@dataclass(frozen=True)
class Weights:
    """What counts how much; starting points, chosen on a bundled kitchen (docs/semantics.md D16).

    Attributes:
        unproven: newness of an attempt at a skill that never succeeded.
        promising: an attempt at such a skill that promises most, however little is new of it.
        unmatched: the same if the skill never succeeded with arguments of such types.
        untried: an instance that was never tried where it sees what others saw, as a share of the
            hope for its skill.
        silent: a skill that never seemed to change anything, in a state that is as new as can be.
        elsewhere: any other skill in such a state: what it changes may hang on things far away.
        vain: an instance that failed so far, in a state that is as new as can be beside those.
        unheard: so much every skill of a way to an attempt is worth, as a share of the hope for it,
            if the attempt is at a skill that never succeeded, and skills had to do with its
            arguments that had not before any other attempt where the same was seen.
        failing: newness where the model predicts a failure, times the entropy of how often that
            was wrong of late.
        least_failing: the least of that product.
        working: newness where the model predicts a success, times the like entropy.
        covered: a combination of roles that was never tried, where success is predicted.
        covered_failing: the same where it is not.
        witness: an attempt like one that the model cannot explain.
        other_witness: an attempt at the same skill, as a share of that.
        repeated: an attempt like a success that rests on doubtful labels.
        fading: what is left of it after every time that it was gone after.
        slow_fading: the same after every time that any cause of the skill was.
    """

    unproven: float = 2.0
    promising: float = 1.0
    unmatched: float = 0.2
    untried: float = 0.05
    silent: float = 0.5
    elsewhere: float = 0.1
    vain: float = 0.03
    unheard: float = 0.05
    failing: float = 0.4
    least_failing: float = 0.05
    working: float = 0.5
    covered: float = 0.3
    covered_failing: float = 0.08
    witness: float = 0.8
    other_witness: float = 0.15
    repeated: float = 0.5
    fading: float = 0.75
    slow_fading: float = 0.9


@dataclass(frozen=True)
class Lead:
    """An attempt that is worth making again.

    Attributes:
        skill: the skill.
        number: of the transition.
    """

    skill: str
    number: int


@dataclass(frozen=True, eq=False)
class Worth:
    """What attempts are worth, by what they would be for; each (nodes, instances).

    Attributes:
        test: whether a condition is needed.
        new: what may be found where nothing is known.
        check: whether the model is right where it is sure.
        cover: combinations of skills that were not tried.
        witness: what the model cannot explain, seen again.
        repeat: what only doubtful labels tell of, seen again.
    """

    test: Values
    new: Values
    check: Values
    cover: Values
    witness: Values
    repeat: Values

    @property
    def total(self) -> Values:
        """All together."""
        return self.test + self.new + self.check + self.cover + self.witness + self.repeat

    def main_part(self, node: int, instance: int) -> str:
        """What an attempt would be for most of all."""
        return max(vars(self), key=lambda name: float(vars(self)[name][node, instance]))


def entropy(probability: NDArray[np.float64] | float) -> Values:
    """Of a coin (...), in bits."""
    p = np.clip(probability, 1e-12, 1 - 1e-12)
    bits: Values = -(p * np.log2(p) + (1 - p) * np.log2(1 - p))
    return bits


def weigh(
    lookahead: Lookahead,
    expected: Expectations,
    scene: SceneRoles,
    memory: Memory,
    *,
    unproven: frozenset[str],
    silent: frozenset[str],
    causes: Sequence[Lead],
    frail: Sequence[Lead],
    weights: Weights,
) -> Worth:
    """Weigh every skill instance in every node.

    Args:
        lookahead: the nodes.
        expected: of all instances in the nodes' states.
        scene: the instances.
        memory: earlier attempts.
        unproven: skills that never succeeded.
        silent: skills of which no success seems to change anything.
        causes: what the model cannot explain, one transition for each cause.
        frail: successes that rest on doubtful labels.
        weights: what counts how much.
    """
    of_node = lookahead.state
    sure, success = lookahead.sure[of_node], expected.success[of_node]
    failures, successes = (
        memory.surprises.rate(predicted=False),
        memory.surprises.rate(predicted=True),
    )
    failing = max(weights.least_failing, weights.failing * float(entropy(failures)))
    working = weights.working * float(entropy(successes))
    mix = 0.5 * expected.alone[of_node] + 0.5 * np.sqrt(expected.pairs[of_node])
    mix_done = 0.5 * expected.alone_done[of_node] + 0.5 * np.sqrt(expected.pairs_done[of_node])
    promise = _relative(expected, scene, unproven)
    new, cover = np.where(sure, 0.0, failing * mix), np.zeros_like(mix)
    for number, instance in enumerate(scene.instances):
        places = scene.places[number]
        if instance.skill in unproven:
            alone = memory.new_roles(instance.skill, lookahead.roles, places)
            alone = np.maximum(alone, expected.alone[of_node, number])
            pairs = np.sqrt(expected.pairs[of_node, number])
            hope = memory.hope(instance.skill) * promise[of_node, number] ** 2
            newness = weights.unproven * (0.7 * alone + 0.3 * pairs)
            new[:, number] = np.maximum(newness, weights.promising * hope)
        elif (kind := scene.kinds[number]) not in memory.proven:
            value = weights.unmatched * memory.hope(kind) ** 2 * promise[of_node, number]
            new[:, number] = np.where(sure[:, number], 0.0, np.maximum(new[:, number], value))
        played = memory.new_signatures(memory.played[instance], lookahead.roles, places)
        untried = np.maximum(expected.untried[of_node, number], _PLAYED * played)
        untried *= weights.untried * memory.hope(instance.skill)
        new[:, number] = np.where(sure[:, number], 0.0, np.maximum(new[:, number], untried))
        far = weights.vain * memory.hope(instance) * np.sqrt(expected.elsewhere[of_node, number])
        new[:, number] = np.maximum(new[:, number], far)
        other = weights.silent if instance.skill in silent else weights.elsewhere
        unlike = memory.patience(instance.skill) * np.sqrt(expected.unlike[of_node, number])
        new[:, number] = np.where(sure[:, number], other * unlike, new[:, number])
        unseen = memory.new_signatures(memory.seen[instance.skill], lookahead.roles, places)
        each = np.where(sure[:, number], weights.covered, weights.covered_failing)
        cover[:, number] = each * unseen
    possible = sure | (success > 0.02)
    again = partial(_again, lookahead, possible, scene, memory, weights)
    return Worth(
        test=np.where(sure, 0.0, entropy(success) * np.sqrt(success)),
        new=new,
        check=np.where(sure, working * mix_done, 0.0),
        cover=cover,
        witness=weights.witness * again(causes),
        repeat=weights.repeated * again(frail),
    )


def _relative(expected: Expectations, scene: SceneRoles, unproven: frozenset[str]) -> Values:
    """The promise (states, instances) of attempts beside the most promising one of their kind.

    Of a skill that never succeeded all attempts are of one kind; else those with arguments of the
    same types are, and what is known of others counts too.
    """
    kinds = [k[0] if k[0] in unproven else k for k in scene.kinds]
    found = np.where(
        [kind in unproven for kind in kinds], expected.promise, expected.promise * expected.success
    )
    for kind in dict.fromkeys(kinds):
        own = np.array([k == kind for k in kinds], dtype=bool)
        found[:, own] /= max(float(found[:, own].max(initial=0.0)), 1e-300)
    return found


def _again(
    lookahead: Lookahead,
    possible: NDArray[np.bool_],
    scene: SceneRoles,
    memory: Memory,
    weights: Weights,
    leads: Sequence[Lead],
) -> Values:
    """Attempts like some earlier ones, up to 1; the less the more often they were repeated."""
    found = np.zeros(possible.shape)
    for lead in leads:
        signature = memory.signatures[lead.number]
        worth = weights.fading ** memory.pursued[lead.skill, signature]
        worth *= weights.slow_fading ** memory.pursued_in_all(lead.skill)
        for number, instance in enumerate(scene.instances):
            if instance.skill == lead.skill:
                roles = lookahead.roles[:, scene.places[number]]
                same = (roles == np.array(signature, dtype=np.intp)).all(axis=1)
                value = np.where(same, worth, weights.other_witness * worth)
                better = np.maximum(found[:, number], value)
                found[:, number] = np.where(possible[:, number], better, found[:, number])
    return found
