"""A model behind any OpenAI-compatible endpoint."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass

import openai

from skillwrapper.errors import ConfigurationError, UnusableReplyError
from skillwrapper.usage import Usage
from skillwrapper.vlm.endpoints import Endpoint
from skillwrapper.vlm.openai_connection import open_client
from skillwrapper.vlm.openai_dialect import INSTEAD, Dialect, Feature, NotUnderstoodError
from skillwrapper.vlm.openai_errors import ErrorTranslator
from skillwrapper.vlm.openai_replies import (
    Completion,
    ErrorInReplyError,
    NoCompletionError,
    read_completion,
)
from skillwrapper.vlm.pictures import PictureEncoder
from skillwrapper.vlm.prices import price_of
from skillwrapper.vlm.protocol import OUTPUT_LIMIT, ModelReply, ModelRequest

_LOG = logging.getLogger(__name__)
_HOTTEST = 2.0


@dataclass(frozen=True)
class OpenAISettings:
    """How an endpoint is asked.

    Attributes:
        model: the provider's name of the model.
        base_url: address of the endpoint; None for that of the environment, or OpenAI's own.
        temperature: 0 to 2; None for the model's default, some models accept no other.
        reasoning_effort: e.g. ``"low"``; None for the model's default.
        max_output_tokens: tokens of a reply, reasoning included; None for the model's default.
        image_size: pictures with a longer side are scaled down to this many pixels; None for
            never.
        timeout: seconds that one attempt may take, from the first byte sent to the last received.

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
        for name in ("image_size", "max_output_tokens", "timeout"):
            value = getattr(self, name)
            if value is not None and value <= 0:
                raise ConfigurationError(f"'{name}': expected more than 0, got {value}")
        if self.temperature is not None and not 0 <= self.temperature <= _HOTTEST:
            raise ConfigurationError(f"'temperature': expected 0 to 2, got {self.temperature}")

    @property
    def options(self) -> dict[Feature, object | None]:
        """What is sent along where the endpoint knows it."""
        return {
            Feature.TEMPERATURE: self.temperature,
            Feature.REASONING_EFFORT: self.reasoning_effort,
            Feature.MAX_COMPLETION_TOKENS: self.max_output_tokens,
        }


class OpenAIModel:
    """Asks an endpoint once for each request; see ``RetryingModel`` for more attempts.

    What an endpoint does not know of the protocol is found out in the first calls, told once in
    the log, and avoided from then on.

    Args:
        settings: which model, where, and how.

    Raises:
        AuthenticationError: if there is no key and the endpoint needs one.
        ConfigurationError: if the address, the key, a proxy or a certificate cannot be used.
    """

    def __init__(self, settings: OpenAISettings) -> None:
        self._settings = settings
        endpoint = Endpoint.find(settings.model, settings.base_url)
        self._redactor = endpoint.redactor
        self._errors = ErrorTranslator(self.name, endpoint.url, endpoint.redactor, endpoint.proxies)
        self._price = price_of(settings.model, endpoint.url)
        self._encoder = PictureEncoder(settings.image_size)
        self._dialect, self._lock = Dialect(), threading.Lock()
        self._was_reached = False
        self._client = open_client(endpoint, settings.timeout)

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
            OUTPUT_LIMIT: self._settings.max_output_tokens,
            "image_size": self._settings.image_size,
        }
        return {name: value for name, value in settings.items() if value is not None}

    def complete(self, request: ModelRequest) -> ModelReply:
        """Ask once; again at once where the endpoint does not know a part of the protocol.

        Raises:
            TemporaryProviderError: if another attempt may work.
            ProviderError: if it would fail in the same way.
            ConfigurationError: if the way to the endpoint cannot be used.
        """
        while True:
            dialect = self._dialect
            try:
                return self._ask(request, dialect)
            except NotUnderstoodError as error:
                if error.feature in dialect.missing or not self._is_sent(error.feature, request):
                    raise
                self._avoid(error.feature)

    def close(self) -> None:
        """Close the connections."""
        self._client.close()

    def _ask(self, request: ModelRequest, dialect: Dialect) -> ModelReply:
        messages = dialect.messages(request, self._encoder.data_url)
        options = dialect.options(self._settings.options)
        began = time.perf_counter()
        try:
            raw = self._client.chat.completions.with_raw_response.create(
                model=self._settings.model,
                messages=messages,  # type: ignore[arg-type]
                **options,
            )
            body, headers = raw.content, raw.headers
        except (openai.OpenAIError, ValueError) as error:
            translated = self._errors.translate(error)
            if not self._was_reached:
                translated = self._errors.lasting(translated)
            # Without the chain: the client's exception may quote headers or the key.
            raise translated from None
        seconds = time.perf_counter() - began
        try:
            completion = read_completion(body)
        except NoCompletionError as error:
            lasts = not (error.is_broken or self._was_reached)
            raise self._errors.no_completion(str(error), lasts=lasts) from None
        except ErrorInReplyError as error:
            raise self._errors.refused(error.status, error.body, headers) from None
        self._was_reached = True
        return self._reply(completion, seconds)

    def _reply(self, completion: Completion, seconds: float) -> ModelReply:
        tokens = (completion.input_tokens, completion.output_tokens)
        cost = self._price(*tokens) if self._price else None
        usage = Usage(*tokens, cost, seconds)
        if completion.refusal is not None:
            said = self._errors.quote(completion.refusal)
            raise UnusableReplyError(f"{self.name} refused: {said}", "refused", said, usage)
        if not completion.text.strip() and not completion.cut_off:
            raise UnusableReplyError(
                f"{self.name} replied nothing (finish reason: {completion.reason})",
                "empty",
                usage=usage,
            )
        text = self._redactor.redact(completion.text)
        return ModelReply(text, usage, cut_off=completion.cut_off)

    def _is_sent(self, feature: Feature, request: ModelRequest) -> bool:
        """Whether a request makes use of a feature: only then can doing without it help."""
        if feature is Feature.SYSTEM_ROLE:
            return bool(request.system)
        return self._settings.options[feature] is not None

    def _avoid(self, feature: Feature) -> None:
        with self._lock:
            if feature not in self._dialect.missing:
                self._dialect = self._dialect.without(feature)
                _LOG.warning("%s does not know %s: %s", self.name, feature, INSTEAD[feature])
