"""What a run was asked to do; ``config.yaml`` in the run's folder."""

from __future__ import annotations

from dataclasses import replace

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.learning.settings import LearningSettings
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.settings import AssistantSettings


class ModelSettings(BaseModel):
    """Which models answer, and how they are asked.

    Attributes:
        name: the model of every role, e.g. ``embedded`` or ``openai:gpt-5``.
        roles: models of single roles, where they differ.
        noise: noise profile of the embedded model.
        base_url: address of an OpenAI-compatible endpoint; None for the provider's own.
        prompts: folder of prompt templates that replace the built-in ones; None for none.
        assistant: how models are asked.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = "embedded"
    roles: dict[Role, str] = Field(default_factory=dict)
    noise: str = "none"
    base_url: str | None = None
    prompts: str | None = None
    assistant: AssistantSettings = Field(default_factory=AssistantSettings)


class RunConfig(BaseModel):
    """Everything that decides what a run does.

    Attributes:
        domain: a bundled domain's name.
        seed: decides every choice by chance, the layouts and the embedded model's replies.
        iterations: how often to explore and learn (the paper's m).
        until_converged: stop earlier, when an iteration brought nothing new.
        exploration: how skill sequences are chosen.
        learning: how predicates are invented.
        model: which models answer.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    domain: str
    seed: int = 0
    iterations: int = Field(default=5, ge=1)
    until_converged: bool = False
    exploration: ExplorationSettings = Field(default_factory=ExplorationSettings)
    learning: LearningSettings = Field(default_factory=LearningSettings)
    model: ModelSettings = Field(default_factory=ModelSettings)

    def layout_seed(self, iteration: int) -> int:
        """The seed with which the environment is reset in an iteration (from 1)."""
        return self.seed * 1000 + iteration

    def difference(self, other: RunConfig) -> str:
        """The first setting in which another configuration differs; empty if there is none.

        The number of iterations, when to stop before them, the number of parallel calls and the
        address of the endpoint may differ: they do not change what is learned, only how far and
        how fast.
        """
        return _first_difference(self._essence(), other._essence())

    def _essence(self) -> dict[str, object]:
        assistant = replace(self.model.assistant, parallel=1)
        model = self.model.model_copy(update={"assistant": assistant, "base_url": None})
        changes = {"iterations": 1, "until_converged": False, "model": model}
        return self.model_copy(update=changes).model_dump(mode="json")


def _first_difference(mine: object, theirs: object, path: str = "") -> str:
    if isinstance(mine, dict) and isinstance(theirs, dict):
        for key in dict.fromkeys((*mine, *theirs)):
            place = f"{path}.{key}".lstrip(".")
            found = _first_difference(mine.get(key), theirs.get(key), place)
            if found:
                return found
        return ""
    return "" if mine == theirs else f"{path}: {mine!r} there, {theirs!r} now"
