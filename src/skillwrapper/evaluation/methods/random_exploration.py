"""Random Exploration: skill instances are drawn by chance; all else as in the whole method."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.runs.config import RunConfig


def _explore_randomly(config: RunConfig) -> RunConfig:
    exploration = config.exploration.model_copy(update={"choice": "random"})
    return config.model_copy(update={"exploration": exploration})


RANDOM_EXPLORATION: Final = LearnedMethod("random", "Random Exploration", _explore_randomly)
