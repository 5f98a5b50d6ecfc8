"""What a run is asked to do: one tree of settings, kept in ``config.yaml`` in the run's folder.

Every setting says what it means and in which unit; ``skillwrapper settings`` lists them all.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Final

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.perception.settings import PerceptionSettings
from skillwrapper.redaction import SafeUrl
from skillwrapper.vlm.limits import CallLimits
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.retrying import RetryPolicy
from skillwrapper.vlm.settings import AskingSettings, EndpointSettings
from skillwrapper.world.domain_file import Prose

FREE: Final = (
    "iterations",
    "until_converged",
    "model.base_url",
    "model.asking.parallel",
    "model.endpoint.timeout",
    "model.endpoint.max_output_tokens",
    "calls",
)
"""Settings that may differ when a run is resumed: they decide how far and how fast it goes, not
what it learns on the way."""

AbsolutePath = Annotated[Path, AfterValidator(lambda path: path.absolute())]
"""The same from whichever folder a run is resumed."""


class ModelSettings(BaseModel):
    """Which models answer, and how they are asked."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str = Field(
        default="embedded",
        description="model of every role: embedded, openai:NAME or recorded:DIR",
    )
    roles: dict[Role, str] = Field(
        default_factory=dict, description="models of single roles, where they differ"
    )
    noise: str = Field(
        default="none",
        description="noise profile of the embedded model, or a rate of wrong judgements",
        coerce_numbers_to_str=True,
    )
    base_url: SafeUrl | None = Field(
        default=None,
        repr=False,
        description="address of an OpenAI-compatible endpoint; none for the provider's own",
    )
    prompts: AbsolutePath | None = Field(
        default=None, description="folder of prompt templates that replace the built-in ones"
    )
    asking: AskingSettings = Field(default_factory=AskingSettings, description="how they are asked")
    endpoint: EndpointSettings = Field(
        default_factory=EndpointSettings, description="how models behind an endpoint are asked"
    )


class CallSettings(BaseModel):
    """What a run may spend on model calls, and how patient it is."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    max_calls: int | None = Field(
        default=None,
        ge=0,
        description="stop after so many calls, failed ones included",
        json_schema_extra={"unit": "calls"},
    )
    max_cost: float | None = Field(
        default=None,
        ge=0.0,
        description="stop after so much, where prices are known",
        json_schema_extra={"unit": "US dollars"},
    )
    max_seconds: float | None = Field(
        default=None,
        ge=0.0,
        description="stop after so long",
        json_schema_extra={"unit": "seconds"},
    )
    shared_store: AbsolutePath | None = Field(
        default=None,
        description="file in which several runs share replies; made if it is missing",
    )
    attempts: int = Field(
        default=12,
        ge=1,
        description="how often a call is made at most that fails in passing",
        json_schema_extra={"unit": "calls"},
    )
    first_wait: float = Field(
        default=0.5,
        ge=0.0,
        description="wait before the second attempt; doubles with every further one",
        json_schema_extra={"unit": "seconds"},
    )
    longest_wait: float = Field(
        default=30.0,
        ge=0.0,
        description="no wait is longer, unless the provider asks for it",
        json_schema_extra={"unit": "seconds"},
    )
    longest_asked_wait: float = Field(
        default=120.0,
        ge=0.0,
        description="a call is given up if the provider asks to wait longer",
        json_schema_extra={"unit": "seconds"},
    )

    @property
    def limits(self) -> CallLimits:
        """After which the run stops."""
        return CallLimits(self.max_calls, self.max_cost, self.max_seconds)

    @property
    def retries(self) -> RetryPolicy:
        """How calls are repeated."""
        return RetryPolicy(
            self.attempts, self.first_wait, self.longest_wait, self.longest_asked_wait
        )


class RunIdentity(BaseModel):
    """What a run is of."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    domain: str = Field(
        description="the domain: a bundled or installed one, its folder, or package.module:name"
    )
    seed: int = Field(
        default=0,
        ge=0,
        description="decides everything left to chance: sequences, layouts, the embedded model",
        json_schema_extra={"unit": "a number"},
    )


class SharedSettings(BaseModel):
    """What runs of several domains and seeds may have in common."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    iterations: int = Field(
        default=5,
        ge=1,
        description="how often to explore and learn (the paper's m)",
        json_schema_extra={"unit": "iterations"},
    )
    until_converged: bool = Field(
        default=False, description="stop earlier, when an iteration brought nothing new"
    )
    scenes: tuple[str, ...] = Field(
        default=(),
        description="scenes to learn in, one iteration each in turn; empty for all of the domain",
    )
    predicates: tuple[Prose, ...] = Field(
        default=(),
        description="predicates that are known beforehand, each as name(?type, ...): meaning; they "
        "are tried before a model is asked",
    )
    exploration: ExplorationSettings = Field(
        default_factory=ExplorationSettings, description="how skill sequences are chosen"
    )
    perception: PerceptionSettings = Field(
        default_factory=PerceptionSettings, description="what is made of what pictures show"
    )
    learning: LearningSettings = Field(
        default_factory=LearningSettings, description="how predicates are invented"
    )
    model: ModelSettings = Field(default_factory=ModelSettings, description="which models answer")
    calls: CallSettings = Field(
        default_factory=CallSettings, description="what may be spent on model calls"
    )

    @property
    def decodes_labels(self) -> bool:
        """Whether it is learned from the likeliest states behind what was read (D24)."""
        if self.perception.labels == "auto":
            return self.learning.learner == "robust"
        return self.perception.labels == "decoded"


class RunSettings(SharedSettings, RunIdentity):
    """Everything that decides what a run does."""

    def layout_seed(self, iteration: int) -> int:
        """The seed with which the environment is reset in an iteration (from 1)."""
        return self.seed * 1000 + iteration

    def difference(self, other: RunSettings) -> str:
        """The first setting in which another run differs; empty if there is none.

        What is ``FREE`` to differ does not count.
        """
        return _first_difference(self.model_dump(mode="json"), other.model_dump(mode="json"))


def _first_difference(
    mine: Mapping[str, Any], theirs: Mapping[str, Any], path: tuple[str, ...] = ()
) -> str:
    for key in dict.fromkeys((*mine, *theirs)):
        place = (*path, key)
        name = ".".join(place)
        here, there = mine.get(key), theirs.get(key)
        if name in FREE or here == there:
            continue
        if isinstance(here, Mapping) and isinstance(there, Mapping):
            found = _first_difference(here, there, place)
            if found:
                return found
        else:
            return f"{name}: {here!r} there, {there!r} now"
    return ""
