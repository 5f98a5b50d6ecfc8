"""A model behind any OpenAI-compatible endpoint."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import openai

from skillwrapper.errors import (
    AuthenticationError,
    ConfigurationError,
    ModelNotFoundError,
    ProviderError,
    UnusableReplyError,
)
from skillwrapper.vlm.openai_errors import ErrorTranslator, NobodyAnswersError
from skillwrapper.vlm.pictures import PictureEncoder
from skillwrapper.vlm.prices import Price, list_price
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Usage

KEY_VARIABLE = "OPENAI_API_KEY"
"""The environment variable that holds the key; the key is never taken from anywhere else."""
_NO_KEY = "none-needed"
_OWN_ENDPOINT = "https://api.openai.com/v1"


@dataclass(frozen=True)
class OpenAISettings:
    """How an endpoint is asked.

    Attributes:
        model: the provider's name of the model.
        base_url: address of the endpoint; None for OpenAI's own.
        temperature: 0 to 2; None for the model's default, some models accept no other.
        reasoning_effort: e.g. ``"low"``; None for the model's default.
        max_output_tokens: None for the model's default.
        image_size: pictures with a longer side are scaled down to this many pixels; None for
            never.
        timeout: seconds that one attempt may take.

    Raises:
        ConfigurationError: if a number makes no sense.
    """

    model: str
    base_url: str | None = None
    temperature: float | None = None
    reasoning_effort: str | None = None
    max_output_tokens: int | None = None
    image_size: int | None = 1024
    timeout: float = 120.0

    def __post_init__(self) -> None:
        if not self.model:
            raise ConfigurationError("expected the name of a model after 'openai:', got none")
        if self.base_url is not None and not self.base_url.startswith(("http://", "https://")):
            raise ConfigurationError(
                f"'base-url': expected an address like http://localhost:8000/v1, "
                f"got '{self.base_url}'"
            )
        for name in ("image_size", "max_output_tokens", "timeout"):
            value = getattr(self, name)
            if value is not None and value <= 0:
                raise ConfigurationError(f"'{name}': expected more than 0, got {value}")

    @property
    def endpoint(self) -> str:
        """The address that is asked."""
        return self.base_url or os.environ.get("OPENAI_BASE_URL") or _OWN_ENDPOINT


class OpenAIModel:
    """Asks an endpoint once for each request; see ``RetryingModel`` for more attempts.

    Args:
        settings: which model, where, and how.
        price: what it costs; the list price by default, which may be unknown.

    Raises:
        AuthenticationError: if there is no key and the endpoint needs one.
    """

    def __init__(self, settings: OpenAISettings, price: Price | None = None) -> None:
        self._settings = settings
        key = _find_key(settings)
        self._errors = ErrorTranslator(self.name, settings.endpoint, key)
        self._price = price or list_price(settings.model, settings.base_url)
        self._encoder = PictureEncoder(settings.image_size)
        self._was_reached = False
        self._client = openai.OpenAI(
            api_key=key,
            base_url=settings.endpoint,
            timeout=settings.timeout,
            max_retries=0,
        )

    @property
    def name(self) -> str:
        """``openai:`` and the name of the model."""
        return f"openai:{self._settings.model}"

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        """The settings that change replies; the address and the timeout do not."""
        settings = {
            "temperature": self._settings.temperature,
            "reasoning_effort": self._settings.reasoning_effort,
            "max_output_tokens": self._settings.max_output_tokens,
            "image_size": self._settings.image_size,
        }
        return {name: value for name, value in settings.items() if value is not None}

    def complete(self, request: ModelRequest) -> ModelReply:
        """Ask once.

        Raises:
            TemporaryProviderError: if another attempt may work.
            ProviderError: if it would fail in the same way.
        """
        began = time.perf_counter()
        try:
            completion = self._client.chat.completions.create(**self._arguments(request))
        except (openai.OpenAIError, ValueError) as error:
            # Without the chain: the client's exception may quote headers or the key.
            raise self._lasting_or_not(self._errors.translate(error)) from None
        self._was_reached = True
        return self._read(completion, time.perf_counter() - began)

    def close(self) -> None:
        """Close the connections."""
        self._client.close()

    def _arguments(self, request: ModelRequest) -> dict[str, Any]:
        content: list[dict[str, Any]] = [{"type": "text", "text": request.prompt}]
        for picture in request.pictures:
            url = self._encoder.data_url(picture)
            content.append({"type": "image_url", "image_url": {"url": url}})
        messages: list[dict[str, Any]] = [{"role": "user", "content": content}]
        if request.system:
            messages.insert(0, {"role": "system", "content": request.system})
        optional = {
            "temperature": self._settings.temperature,
            "reasoning_effort": self._settings.reasoning_effort,
            "max_completion_tokens": self._settings.max_output_tokens,
        }
        chosen = {name: value for name, value in optional.items() if value is not None}
        return {"model": self._settings.model, "messages": messages, **chosen}

    def _lasting_or_not(self, error: ProviderError) -> ProviderError:
        """Where there never was a server, waiting for one is of no use."""
        if isinstance(error, NobodyAnswersError) and not self._was_reached:
            return ModelNotFoundError(str(error))
        return error

    def _read(self, completion: Any, seconds: float) -> ModelReply:
        """The text of a completion; the client does not check its shape."""
        usage = self._usage(completion, seconds)
        try:
            choice = completion.choices[0]
            text, refusal = choice.message.content, getattr(choice.message, "refusal", None)
            reason = choice.finish_reason
        except (AttributeError, IndexError, TypeError):
            if isinstance(getattr(completion, "choices", None), list):
                raise UnusableReplyError(
                    f"{self.name} sent no choice", "empty", usage=usage
                ) from None
            raise self._errors.translate(TypeError("no completion")) from None
        if refusal or reason == "content_filter":
            said = self._errors.redact(str(refusal or text or ""))
            raise UnusableReplyError(f"{self.name} refused: {said}", "refused", said, usage)
        if not isinstance(text, str) or not text.strip():
            raise UnusableReplyError(
                f"{self.name} replied nothing (finish reason: {reason})", "empty", usage=usage
            )
        return ModelReply(text, usage)

    def _usage(self, completion: Any, seconds: float) -> Usage:
        told = getattr(completion, "usage", None)
        tokens = [getattr(told, name, None) for name in ("prompt_tokens", "completion_tokens")]
        counted = [value if isinstance(value, int) else None for value in tokens]
        cost = self._price.cost(*counted) if self._price else None
        return Usage(counted[0], counted[1], cost, seconds)


def _find_key(settings: OpenAISettings) -> str:
    """The key from the environment; endpoints of one's own usually need none."""
    key = os.environ.get(KEY_VARIABLE, "").strip()
    if key:
        return key
    if settings.endpoint == _OWN_ENDPOINT:
        raise AuthenticationError(
            f"no key for openai:{settings.model}; set the environment variable {KEY_VARIABLE}, or "
            "name the address of an endpoint that needs none with --base-url"
        )
    return _NO_KEY
