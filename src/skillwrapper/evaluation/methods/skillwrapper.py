"""The whole method, with the experiment's budget of executions and with the paper's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from skillwrapper.evaluation.methods.learned import WHOLE_METHOD, LearnedMethod
from skillwrapper.runs.settings import RunSettings

PAPER_ITERATIONS: Final = 5
PAPER_BUDGET: Final = 15
"""The paper's hyperparameters (Appendix, Hyperparameters)."""
PAPER_SCENES: Final = 3
"""One iteration in each of so many scenes, where the paper tests generalization (Section 4.2)."""

OURS: Final = LearnedMethod("ours", "SkillWrapper (ours)", WHOLE_METHOD)


def _iterations(count: int, budget: int = PAPER_BUDGET) -> Callable[[RunSettings], RunSettings]:
    """Settings with so many iterations of so many executions."""

    def change(config: RunSettings) -> RunSettings:
        exploration = config.exploration.model_copy(update={"budget": budget})
        return config.model_copy(update={"iterations": count, "exploration": exploration})

    return change


OURS_PAPER_BUDGET: Final = LearnedMethod(
    "ours-5x15", "SkillWrapper, 5 x 15", WHOLE_METHOD, _iterations(PAPER_ITERATIONS)
)
OURS_ONCE_A_SCENE: Final = LearnedMethod(
    "ours-3x15", "SkillWrapper, 3 x 15", WHOLE_METHOD, _iterations(PAPER_SCENES)
)
OURS_OFTEN_RESET: Final = LearnedMethod(
    "ours-15x5", "SkillWrapper, 15 x 5", WHOLE_METHOD, _iterations(15, budget=5)
)
"""The paper's number of executions, with three times its resets: for worlds with dead ends."""
