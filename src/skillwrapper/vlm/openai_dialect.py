"""What an endpoint understands of the protocol, and how a request is put into its words."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType
from typing import Any

from skillwrapper.errors import ProviderError
from skillwrapper.vlm.protocol import ModelRequest
from skillwrapper.world.observation import Picture


class Feature(StrEnum):
    """Parts of the protocol that not every endpoint knows, and that can be done without."""

    SYSTEM_ROLE = "system role"
    MAX_COMPLETION_TOKENS = "max_completion_tokens"
    TEMPERATURE = "temperature"
    REASONING_EFFORT = "reasoning_effort"


INSTEAD: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.SYSTEM_ROLE: "the system prompt is put in front of the question",
        Feature.MAX_COMPLETION_TOKENS: "the output limit is sent as max_tokens",
        Feature.TEMPERATURE: "the model's own is used",
        Feature.REASONING_EFFORT: "the model's own is used",
    }
)
"""What happens where an endpoint does not know a feature."""


class NotUnderstoodError(ProviderError):
    """The endpoint does not know a part of the protocol.

    Args:
        message: what it said, and what to do.
        feature: the part.
    """

    def __init__(self, message: str, feature: Feature) -> None:
        super().__init__(message)
        self.feature = feature


@dataclass(frozen=True)
class Dialect:
    """How requests are written for one endpoint.

    Attributes:
        missing: what the endpoint does not know.
    """

    missing: frozenset[Feature] = field(default_factory=frozenset)

    def without(self, feature: Feature) -> Dialect:
        """The dialect that also avoids a feature."""
        return Dialect(self.missing | {feature})

    def messages(
        self, request: ModelRequest, url_of: Callable[[Picture], str]
    ) -> list[dict[str, Any]]:
        """The messages of a request.

        Args:
            request: what is asked.
            url_of: makes a data URL of a picture.
        """
        system, prompt = request.system, request.prompt
        if Feature.SYSTEM_ROLE in self.missing and system:
            system, prompt = "", f"{system}\n\n{prompt}"
        asked = {"role": "user", "content": _content(prompt, request.pictures, url_of)}
        return [{"role": "system", "content": system}, asked] if system else [asked]

    def options(self, wanted: Mapping[Feature, object | None]) -> dict[str, Any]:
        """The optional parameters that are sent.

        Args:
            wanted: the user's settings; None for the model's own.
        """
        chosen = {feature: value for feature, value in wanted.items() if value is not None}
        limit = chosen.pop(Feature.MAX_COMPLETION_TOKENS, None)
        options = {str(f): value for f, value in chosen.items() if f not in self.missing}
        if limit is not None:
            old = Feature.MAX_COMPLETION_TOKENS in self.missing
            options["max_tokens" if old else "max_completion_tokens"] = limit
        return options


def _content(
    prompt: str, pictures: tuple[Picture, ...], url_of: Callable[[Picture], str]
) -> str | list[dict[str, Any]]:
    """A plain string where no picture goes along: servers for text take nothing else."""
    if not pictures:
        return prompt
    shown = [{"type": "image_url", "image_url": {"url": url_of(picture)}} for picture in pictures]
    return [{"type": "text", "text": prompt}, *shown]
