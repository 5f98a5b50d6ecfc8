"""All methods by name."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from skillwrapper.evaluation.methods.expert import EXPERT, EXPERT_READ
from skillwrapper.evaluation.methods.fm_invent import FM_INVENT
from skillwrapper.evaluation.methods.method import Method
from skillwrapper.evaluation.methods.proposed_sequences import NO_HEURISTIC, PAPER_EXPLORATION
from skillwrapper.evaluation.methods.random_exploration import RANDOM_EXPLORATION
from skillwrapper.evaluation.methods.skillwrapper import (
    OURS,
    OURS_OFTEN_RESET,
    OURS_ONCE_A_SCENE,
    OURS_PAPER_BUDGET,
)
from skillwrapper.evaluation.methods.system import SYSTEM, SYSTEM_ABSENCE
from skillwrapper.evaluation.methods.vila import VILA

_ALL: tuple[Method, ...] = (
    EXPERT,
    EXPERT_READ,
    SYSTEM,
    SYSTEM_ABSENCE,
    VILA,
    RANDOM_EXPLORATION,
    FM_INVENT,
    NO_HEURISTIC,
    PAPER_EXPLORATION,
    OURS_ONCE_A_SCENE,
    OURS_OFTEN_RESET,
    OURS_PAPER_BUDGET,
    OURS,
)

METHODS: Final[Mapping[str, Method]] = MappingProxyType({method.name: method for method in _ALL})
"""The methods in the order of tables."""
