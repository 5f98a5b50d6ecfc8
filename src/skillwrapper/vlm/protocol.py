"""What a vision-language model is to the rest of the package: text and pictures in, text out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Protocol, runtime_checkable

from skillwrapper.usage import Usage
from skillwrapper.vlm.answers import answer_of, clean_text
from skillwrapper.world.observation import Picture

OUTPUT_LIMIT = "max_output_tokens"
"""The parameter of a model that cuts replies off, and changes nothing else of them."""


class Role(StrEnum):
    """What a call is for; every role may have a model of its own."""

    PROPOSE = "propose"
    INVENT = "invent"
    EVALUATE = "evaluate"
    SUMMARISE = "summarise"
    ACT = "act"


@dataclass(frozen=True)
class ModelRequest:
    """One call: a rendered prompt and pictures, nothing else.

    Attributes:
        role: what the call is for.
        system: system prompt, may be empty.
        prompt: user prompt.
        pictures: attached pictures in the order in which the prompt speaks of them.
        repetition: 0, or the number of the repetition when the same question is asked again.
    """

    role: Role
    system: str
    prompt: str
    pictures: tuple[Picture, ...] = ()
    repetition: int = 0


@dataclass(frozen=True)
class ModelReply:
    """What a model answered.

    Attributes:
        text: the reply with all its reasoning, mended on receipt (``clean_text``); not empty,
            unless it was cut off.
        usage: what it took.
        taken_back: whether the reply was of no use when it came. It then tells how a question
            went, so that it is asked again in the same way, and must not be taken for an answer.
        cut_off: whether it ends where the output limit was reached (finish reason ``length``),
            perhaps before the model said anything but its reasoning. Never taken for an answer.
    """

    text: str
    usage: Usage = field(default_factory=Usage)
    taken_back: bool = False
    cut_off: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", clean_text(self.text))

    @property
    def answer(self) -> str:
        """The reply without the model's reasoning; may be empty."""
        return answer_of(self.text)


class VisionLanguageModel(Protocol):
    """A model behind any provider. Must be safe to call from several threads."""

    @property
    def name(self) -> str:
        """Provider and model, e.g. ``openai:gpt-5`` or ``embedded``."""
        ...

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        """Every setting that changes replies; part of the key of the call store."""
        ...

    def complete(self, request: ModelRequest) -> ModelReply:
        """Answer one request.

        Raises:
            ProviderError: if no usable answer comes.
        """
        ...


@runtime_checkable
class TakesBack(Protocol):
    """A model that keeps replies, and can be told that one of them was of no use."""

    def take_back(self, request: ModelRequest) -> None:
        """Do not serve the reply to a request as an answer again."""
        ...


class ModelWrapper:
    """A model around another one: passes everything on; a base for those that do more.

    Args:
        model: the model behind.
    """

    def __init__(self, model: VisionLanguageModel) -> None:
        self._model = model

    @property
    def name(self) -> str:
        """The name of the model behind."""
        return self._model.name

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        """The parameters of the model behind."""
        return self._model.parameters

    def complete(self, request: ModelRequest) -> ModelReply:
        """What the model behind answers.

        Raises:
            ProviderError: as the model behind does.
        """
        return self._model.complete(request)

    def take_back(self, request: ModelRequest) -> None:
        """Pass on that the reply to a request was of no use."""
        if isinstance(self._model, TakesBack):
            self._model.take_back(request)
