"""How promising attempts at a skill are that never succeeded: what no failure rules out.

The skill needs something: some of the features that an attempt may have, rather few than many. A
failure rules out every part of its own features. What is left, of the parts of one, two and three
features and of the whole if few failures had its features, is weighed by how likely things of the
kind are needed: that is how likely an attempt works, but for a factor that is the same for all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.novelty import Features
from skillwrapper.grounding.abstract_states import different_rows

_NEGATIVE = 0.5
"""Something that must not hold is needed so much more rarely than something that must; as in
``learning.version_space.Prior``."""
_MOST_FEATURES = 80
"""Of more, those that hold most rarely are looked at: there are as many triples as its cube."""


def promise_of(seen: Features, failed: Features) -> NDArray[np.float64]:
    """The weight (attempts,) of what the attempts have that no failure had.

    Args:
        seen: what holds in the attempts (attempts, features); the first half of the features are
            those that say that something holds.
        failed: the same of earlier attempts, all of which failed.
    """
    first, place = different_rows(seen)
    rows = seen[first]
    chosen = _varying(rows, failed)
    if not len(chosen):
        return np.full(len(seen), float(not len(failed)))
    half = seen.shape[1] // 2
    weight = np.where(chosen < half, 1.0, _NEGATIVE).astype(np.float32)
    held, before = rows[:, chosen] * weight, failed[:, chosen].astype(np.float32)
    single = held @ (before.sum(axis=0) == 0)
    pairs = np.zeros(len(rows))
    triples = np.zeros(len(rows))
    for number in range(len(chosen)):
        together = before[before[:, number] > 0]
        new = (together.T @ together == 0).astype(np.float32)
        pairs += held[:, number] * (held @ np.diag(new)) / 2
        triples += held[:, number] * ((held @ new) * held).sum(axis=1) / 6
    size = float(len(chosen))
    other = (held > 0).astype(np.float32) @ (1 - before).T + (held == 0) @ before.T
    rarity = np.log((len(before) + 2) / (before.sum(axis=0) + 1))
    whole = (held @ rarity) ** 2 * (other > 0).all(axis=1)
    found = single + pairs / size + triples / size**2 + whole / size**2
    promise: NDArray[np.float64] = found[place]
    return promise


def _varying(rows: Features, failed: Features) -> NDArray[np.intp]:
    """The features that hold in some attempts and not in others."""
    everything = np.vstack([rows, failed])
    share = everything.mean(axis=0)
    varying = np.flatnonzero((share > 0) & (share < 1))
    return np.sort(varying[np.argsort(share[varying], kind="stable")][:_MOST_FEATURES])
