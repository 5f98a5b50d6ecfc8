"""Random Exploration: skill instances are drawn by chance; all else as in the whole method."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.runs.settings import RunSettings


def _explore_randomly(config: RunSettings) -> RunSettings:
    exploration = config.exploration.model_copy(update={"choice": "random"})
    return config.model_copy(update={"exploration": exploration})


RANDOM_EXPLORATION: Final = LearnedMethod("random", "Random Exploration", _explore_randomly)
