"""All methods by name."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from skillwrapper.baselines.expert import EXPERT, EXPERT_READ
from skillwrapper.baselines.fm_invent import FM_INVENT
from skillwrapper.baselines.no_heuristic import NO_HEURISTIC
from skillwrapper.baselines.random_exploration import RANDOM_EXPLORATION
from skillwrapper.baselines.skillwrapper import OURS, OURS_PAPER_BUDGET
from skillwrapper.baselines.system import SYSTEM, SYSTEM_ABSENCE
from skillwrapper.baselines.vila import VILA
from skillwrapper.errors import UnknownNameError
from skillwrapper.evaluation.methods import Method

_ALL: tuple[Method, ...] = (
    EXPERT,
    EXPERT_READ,
    SYSTEM,
    SYSTEM_ABSENCE,
    VILA,
    RANDOM_EXPLORATION,
    FM_INVENT,
    NO_HEURISTIC,
    OURS_PAPER_BUDGET,
    OURS,
)

METHODS: Final[Mapping[str, Method]] = MappingProxyType({method.name: method for method in _ALL})
"""The methods in the order of tables."""


def method_of(name: str) -> Method:
    """The method of a name.

    Raises:
        UnknownNameError: if there is none.
    """
    if name not in METHODS:
        raise UnknownNameError("method", name, METHODS)
    return METHODS[name]
