"""Exploration as the paper has it: the model proposes sequences, scores or chance choose one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.evaluation.methods.method import Shares
from skillwrapper.runs.settings import RunSettings


def _proposed(choice: str) -> Callable[[RunSettings], RunSettings]:
    """The whole method, exploring by proposals of which one is taken by a choice."""

    def configure(config: RunSettings) -> RunSettings:
        changes = {"explorer": "paper", "choice": choice}
        exploration = config.exploration.model_copy(update=changes)
        return config.model_copy(update={"exploration": exploration})

    return configure


_PARTS = Shares(
    "reads pictures, proposes predicates and skill sequences",
    "asks, scores and prunes predicates, learns operators, plans",
)
PAPER_EXPLORATION: Final = LearnedMethod(
    "paper-exploration", "The paper's exploration", _PARTS, _proposed("pareto")
)
NO_HEURISTIC: Final = LearnedMethod("no-heuristic", "No Heuristic", _PARTS, _proposed("uniform"))
