"""No Heuristic: any of the proposed sequences is taken, without balance and coverage."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.runs.settings import RunSettings


def _choose_uniformly(config: RunSettings) -> RunSettings:
    exploration = config.exploration.model_copy(update={"choice": "uniform"})
    return config.model_copy(update={"exploration": exploration})


NO_HEURISTIC: Final = LearnedMethod("no-heuristic", "No Heuristic", _choose_uniformly)
