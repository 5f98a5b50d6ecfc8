"""Random Exploration: skill instances are drawn by chance; all else as in the whole method."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.evaluation.methods.method import Shares
from skillwrapper.runs.settings import RunSettings


def _explore_randomly(config: RunSettings) -> RunSettings:
    exploration = config.exploration.model_copy(update={"explorer": "random"})
    return config.model_copy(update={"exploration": exploration})


_PARTS = Shares(
    "reads pictures, proposes predicates",
    "asks, scores and prunes predicates, learns operators, plans; explores by chance",
)
RANDOM_EXPLORATION: Final = LearnedMethod("random", "Random Exploration", _PARTS, _explore_randomly)
