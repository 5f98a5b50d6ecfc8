"""The whole method, with the experiment's budget of executions and with the paper's."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import WHOLE_METHOD, LearnedMethod
from skillwrapper.runs.settings import RunSettings

PAPER_ITERATIONS: Final = 5
PAPER_BUDGET: Final = 15
"""The paper's hyperparameters (Appendix, Hyperparameters)."""

OURS: Final = LearnedMethod("ours", "SkillWrapper (ours)", WHOLE_METHOD)


def _paper_budget(config: RunSettings) -> RunSettings:
    exploration = config.exploration.model_copy(update={"budget": PAPER_BUDGET})
    return config.model_copy(update={"iterations": PAPER_ITERATIONS, "exploration": exploration})


OURS_PAPER_BUDGET: Final = LearnedMethod(
    "ours-5x15", "SkillWrapper, 5 x 15", WHOLE_METHOD, _paper_budget
)
