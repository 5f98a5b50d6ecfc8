"""AMLGym's predictive metrics by their definitions, by joins instead of trying every action.

Averages over actions of counts over all test states, as ``amlgym.metrics.predictive_power`` has
them; the states and what truly applies in them are AMLGym's (``predictive_power_fast``).
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from skillwrapper.action_models.steps import State
from skillwrapper.action_models.strips import Strips

Arguments = tuple[str, ...]


@dataclass(frozen=True)
class TestState:
    """A state in which models are compared.

    Attributes:
        state: the true atoms.
        objects: the type of every object.
        applicable: what truly applies, by action.
    """

    state: State
    objects: Mapping[str, str]
    applicable: Mapping[str, frozenset[Arguments]]


def predictive_power(learned: Strips, true: Strips, tests: Iterable[TestState]) -> dict[str, float]:
    """Precision and recall of applicability and effects, 0 to 1."""
    applies: dict[str, Counter[str]] = defaultdict(Counter)
    changes: dict[str, Counter[str]] = defaultdict(Counter)
    for test in tests:
        found: dict[str, set[Arguments]] = defaultdict(set)
        for name, arguments in learned.applicable(test.state, test.objects):
            found[name].add(arguments)
        for name in {*found, *test.applicable}:
            own, right = found[name], test.applicable.get(name, frozenset())
            applies[name].update(tp=len(own & right), fp=len(own - right), fn=len(right - own))
            for arguments in own & right:
                _compare(changes[name], test.state, learned, true, name, arguments)
    return {
        "applicability_precision": _mean(applies, "fp"),
        "applicability_recall": _mean(applies, "fn"),
        "effects_precision": _mean(changes, "fp"),
        "effects_recall": _mean(changes, "fn"),
    }


def _compare(
    counts: Counter[str],
    state: State,
    learned: Strips,
    true: Strips,
    name: str,
    arguments: Arguments,
) -> None:
    own = learned.actions[name].apply(state, arguments)
    right = true.actions[name].apply(state, arguments)
    for made, wanted in ((own - state, right - state), (state - own, state - right)):
        counts.update(tp=len(made & wanted), fp=len(made - wanted), fn=len(wanted - made))


def _mean(counts: Mapping[str, Counter[str]], wrong: str) -> float:
    """AMLGym counts an action without any case as 1."""
    shares = [
        c["tp"] / (c["tp"] + c[wrong]) if c["tp"] + c[wrong] else 1.0 for c in counts.values()
    ]
    return float(np.mean(shares)) if shares else 1.0
