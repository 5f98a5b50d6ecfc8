"""FM Invent: all predicates in one batch from all pictures of the first iteration."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.runs.config import RunConfig


def _invent_at_once(config: RunConfig) -> RunConfig:
    learning = config.learning.model_copy(update={"invention": "batch"})
    return config.model_copy(update={"learning": learning})


FM_INVENT: Final = LearnedMethod("fm-invent", "FM Invent", _invent_at_once)
