"""No Heuristic: any of the proposed sequences is taken, without balance and coverage."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.evaluation.methods.method import Shares
from skillwrapper.runs.settings import RunSettings


def _choose_uniformly(config: RunSettings) -> RunSettings:
    exploration = config.exploration.model_copy(update={"choice": "uniform"})
    return config.model_copy(update={"exploration": exploration})


_PARTS = Shares(
    "reads pictures, proposes predicates and skill sequences",
    "asks, scores and prunes predicates, learns operators, plans",
)
NO_HEURISTIC: Final = LearnedMethod("no-heuristic", "No Heuristic", _PARTS, _choose_uniformly)
