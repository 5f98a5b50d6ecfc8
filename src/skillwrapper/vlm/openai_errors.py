"""From the exceptions of the ``openai`` client to ours. The key never gets into a message."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import openai

from skillwrapper.errors import (
    AuthenticationError,
    ModelCapabilityError,
    ModelNotFoundError,
    ModelUnavailableError,
    ProviderError,
    TemporaryProviderError,
)

_TEMPORARY = frozenset({408, 409, 425, 429})
_LOOKS_LIKE_A_KEY = re.compile(r"\b(?:sk|pk|key|AIza|Bearer)[-_ ][\w*.-]{6,}|AIza[\w-]{10,}")
_PICTURES = re.compile(r"image|vision|multi-?modal|picture", re.IGNORECASE)
_NO_CREDIT = re.compile(r"insufficient_quota|billing|credit", re.IGNORECASE)
_TOO_LONG = re.compile(r"context.{0,10}(?:length|window)|too many tokens", re.IGNORECASE)
_NO_MODEL = re.compile(r"model.{0,60}(?:not found|not exist|unknown|invalid)|model_not_found", re.I)
_LONGEST_QUOTE = 200


@dataclass(frozen=True)
class ErrorTranslator:
    """Says in our words what went wrong with a call.

    Attributes:
        model: provider and model, for messages.
        endpoint: address of the endpoint, for messages.
        key: the secret that must not be repeated.
    """

    model: str
    endpoint: str
    key: str = field(repr=False)

    def translate(self, error: Exception) -> ProviderError:
        """Our exception for one of the client's."""
        if isinstance(error, openai.APITimeoutError):
            return TemporaryProviderError(f"{self.endpoint} did not answer in time")
        if isinstance(error, openai.APIConnectionError):
            return self._of_connection(error)
        if isinstance(error, openai.APIStatusError):
            return self._of_status(error)
        # A reply that is no JSON, or JSON of another shape: a proxy's page, a cut-off body.
        return TemporaryProviderError(
            f"{self.endpoint} sent something that is no chat completion "
            f"({type(error).__name__}); is it an OpenAI-compatible endpoint?"
        )

    def redact(self, text: str) -> str:
        """The text without the key and without anything that looks like one, on one line."""
        if self.key:
            text = text.replace(self.key, "[key]")
        text = " ".join(_LOOKS_LIKE_A_KEY.sub("[key]", text).split())
        return text if len(text) <= _LONGEST_QUOTE else text[: _LONGEST_QUOTE - 3] + "..."

    def _of_connection(self, error: openai.APIConnectionError) -> ProviderError:
        # By name: older versions of the client raise it from another HTTP library.
        if type(error.__cause__).__name__ == "ConnectError":
            return NobodyAnswersError(
                f"nobody answers at {self.endpoint}; start the server, or mend --base-url"
            )
        return TemporaryProviderError(f"the connection to {self.endpoint} broke")

    def _of_status(self, error: openai.APIStatusError) -> ProviderError:
        status, said = error.status_code, self.redact(_detail(error))
        quote = f"{self.model}: status {status} from {self.endpoint}: {said}"
        if status == 429 and _NO_CREDIT.search(said):
            return ModelUnavailableError(f"{quote}; top up the account, then resume the run")
        if status in _TEMPORARY or status >= 500:
            return TemporaryProviderError(quote, _retry_after(error))
        if status in {401, 403}:
            return AuthenticationError(
                f"{quote}; set the environment variable OPENAI_API_KEY to a valid key"
            )
        return _of_refused_request(status, said, quote)


def _of_refused_request(status: int, said: str, quote: str) -> ProviderError:
    """The same request would be refused again."""
    if status in {404, 405} or _NO_MODEL.search(said):
        return ModelNotFoundError(
            f"{quote}; check the name of the model, and that --base-url is the address of an "
            "OpenAI-compatible endpoint (most end in /v1)"
        )
    if _PICTURES.search(said):
        return ModelCapabilityError(f"{quote}; choose a model that accepts pictures")
    if _TOO_LONG.search(said):
        return ModelCapabilityError(
            f"{quote}; choose a model with a longer context, or ask for fewer groundings at once"
        )
    return ProviderError(f"{quote}; the provider does not accept this request")


class NobodyAnswersError(TemporaryProviderError):
    """No connection could be made at all; lasting, unless there was one before."""


def _detail(error: openai.APIStatusError) -> str:
    """What the provider says, without the client's wrapping."""
    body = error.body
    if isinstance(body, dict):
        parts = [body.get("message"), body.get("code")]
        said = ", ".join(str(part) for part in parts if part)
        if said:
            return said
    return error.message or "no reason given"


def _retry_after(error: openai.APIStatusError) -> float | None:
    headers = error.response.headers
    for name, unit in (("retry-after-ms", 0.001), ("retry-after", 1.0)):
        try:
            return max(0.0, float(headers[name]) * unit)
        except (KeyError, ValueError):
            continue
    return None
