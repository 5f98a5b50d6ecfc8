"""What an attempt leaves to be tried: less, where no skill leads back from it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.lookahead import Lookahead
from skillwrapper.exploration.worth import Values


def price(lookahead: Lookahead, values: Values, left: int) -> Values:
    """How many skills of the episode attempts cost (nodes, instances).

    These are the way there, the attempt, and a share of those that could be run afterwards: as much
    as the best that is then still within reach is worth less than the best that is now.

    Args:
        lookahead: what is within reach.
        values: what every instance is worth in every node (nodes, instances).
        left: how many skills may still be run in this episode.
    """
    best = _best_within_reach(lookahead, _best_of_others(lookahead, values))
    number = np.arange(values.shape[1])
    state = lookahead.state[:, np.newaxis]
    then = best[_after(lookahead, values.shape[1])[state, number], number]
    now = best[lookahead.state[0]]
    lost = 1 - np.minimum(1, np.divide(then, now, out=np.ones_like(then), where=now > 0))
    steps = (lookahead.depth + 1)[:, np.newaxis]
    skills: Values = steps + (left - steps) * lost
    return skills


def _best_of_others(lookahead: Lookahead, values: Values) -> Values:
    """The best value of any other instance in every state (states, instances)."""
    best = np.zeros((len(lookahead.states), values.shape[1]))
    np.maximum.at(best, lookahead.state, values)
    if best.shape[1] < 2:
        return np.zeros_like(best)
    order = np.argsort(best, axis=1)
    rows = np.arange(len(best))
    first, second = order[:, -1], order[:, -2]
    others = np.repeat(best[rows, first][:, np.newaxis], best.shape[1], axis=1)
    others[rows, first] = best[rows, second]
    return others


def _best_within_reach(lookahead: Lookahead, values: Values) -> Values:
    """The best of a state or of any that skills lead to from there (states + 1, instances).

    The last row stands for all states that were not looked at; they may lead anywhere.
    """
    best = np.vstack([values, values.max(axis=0, initial=0.0)])
    edges = lookahead.edges[np.argsort(lookahead.edges[:, 0], kind="stable")]
    starts, firsts = np.unique(edges[:, 0], return_index=True)
    while len(starts):
        reached = np.maximum(best[starts], np.maximum.reduceat(best[edges[:, 2]], firsts, axis=0))
        if (reached == best[starts]).all():
            break
        best[starts] = reached
    return best


def _after(lookahead: Lookahead, instances: int) -> NDArray[np.intp]:
    """The state in which an instance leaves one, as far as is known (states, instances)."""
    states = np.arange(len(lookahead.states))
    after = np.repeat(states[:, np.newaxis], instances, axis=1)
    for state, instance, then in lookahead.edges[::-1].tolist():
        after[state, instance] = then
    return after
