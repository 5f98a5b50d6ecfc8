"""skillwrapper: symbolic planning models of black-box robot skills, learned from pictures.

What is named here is what a program needs to bring a robot, learn, and use what was learned
(docs/python.md). Each name is imported when it is first used, so that the package is light.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from skillwrapper.domains.discovery import find_domain
    from skillwrapper.errors import SkillWrapperError
    from skillwrapper.learning.learner import learn_operators
    from skillwrapper.runs.abstract_states import AbstractState
    from skillwrapper.runs.launch import learn
    from skillwrapper.runs.learned_model import LearnedModel
    from skillwrapper.runs.results import LearningResult
    from skillwrapper.runs.settings import RunSettings
    from skillwrapper.transitions.entries import label_entries
    from skillwrapper.transitions.files import read_transitions
    from skillwrapper.vlm.protocol import ModelReply, ModelRequest
    from skillwrapper.world.domain import Domain, load_domain
    from skillwrapper.world.environment import Environment
    from skillwrapper.world.episode import Outcome
    from skillwrapper.world.pictures import observation_of
    from skillwrapper.world.robot import Robot, RobotEnvironment
    from skillwrapper.world.simulator import Simulator
    from skillwrapper.world.skills import SkillInstance

__version__ = "0.1.0"

__all__ = [
    "AbstractState",
    "Domain",
    "Environment",
    "LearnedModel",
    "LearningResult",
    "ModelReply",
    "ModelRequest",
    "Outcome",
    "Robot",
    "RobotEnvironment",
    "RunSettings",
    "Simulator",
    "SkillInstance",
    "SkillWrapperError",
    "__version__",
    "find_domain",
    "label_entries",
    "learn",
    "learn_operators",
    "load_domain",
    "observation_of",
    "read_transitions",
]

_HOMES: Final = {
    "AbstractState": "runs.abstract_states",
    "Domain": "world.domain",
    "Environment": "world.environment",
    "LearnedModel": "runs.learned_model",
    "LearningResult": "runs.results",
    "ModelReply": "vlm.protocol",
    "ModelRequest": "vlm.protocol",
    "Outcome": "world.episode",
    "Robot": "world.robot",
    "RobotEnvironment": "world.robot",
    "RunSettings": "runs.settings",
    "Simulator": "world.simulator",
    "SkillInstance": "world.skills",
    "SkillWrapperError": "errors",
    "find_domain": "domains.discovery",
    "label_entries": "transitions.entries",
    "learn": "runs.launch",
    "learn_operators": "learning.learner",
    "load_domain": "world.domain",
    "observation_of": "world.pictures",
    "read_transitions": "transitions.files",
}
"""Where every public name is defined, below this package."""


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used."""
    if name not in _HOMES:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    found = getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
