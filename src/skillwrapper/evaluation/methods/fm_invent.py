"""FM Invent: all predicates in one batch from all pictures of the first iteration."""

from __future__ import annotations

from typing import Final

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.evaluation.methods.method import Shares
from skillwrapper.runs.settings import RunSettings


def _invent_at_once(config: RunSettings) -> RunSettings:
    learning = config.learning.model_copy(update={"invention": "batch"})
    return config.model_copy(update={"learning": learning})


_PARTS = Shares(
    "reads pictures, names all predicates at once",
    "learns operators from them, plans",
    decided_by_model=True,
)
FM_INVENT: Final = LearnedMethod("fm-invent", "FM Invent", _PARTS, _invent_at_once)
