"""What providers answer when they do not answer: status, headers and body of known kinds of error.

The forms are those of real servers, shortened; each is there because a client could take it for
something else.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from email.utils import formatdate
from types import MappingProxyType
from typing import Any

_JSON = "application/json"
_PAGE = "<!DOCTYPE html><html><head><title>{0}</title></head><body><h1>{0}</h1></body></html>"
_QUOTA = "You exceeded your current quota, please check your plan and billing details."


@dataclass(frozen=True)
class Call:
    """What a canned error may depend on.

    Attributes:
        body: of the request.
        authorization: the header with the key.
    """

    body: Mapping[str, Any]
    authorization: str = field(default="", repr=False)

    @property
    def has_system_role(self) -> bool:
        """Whether a message has the role ``system``."""
        return any(message["role"] == "system" for message in self.body["messages"])

    @property
    def pictures(self) -> int:
        """How many pictures go along."""
        parts = [m["content"] for m in self.body["messages"] if isinstance(m["content"], list)]
        return sum(part["type"] == "image_url" for content in parts for part in content)

    def sends(self, *names: str) -> bool:
        """Whether a parameter of one of these names is sent."""
        return any(name in self.body for name in names)


@dataclass(frozen=True)
class CannedError:
    """An answer that does not depend on a model.

    Attributes:
        summary: what it is, in a line.
        status: HTTP status.
        body: JSON data, or text that is no JSON.
        headers: besides the usual ones.
        when: which calls get it; the others are answered.
    """

    summary: str
    status: int
    body: object
    headers: Mapping[str, str] = field(default_factory=dict)
    when: Callable[[Call], bool] = lambda call: True

    @property
    def content_type(self) -> str:
        """Of the body."""
        return "text/html" if isinstance(self.body, str) else _JSON


def _error(message: str, code: object = None, **more: object) -> dict[str, Any]:
    return {"error": {"message": message, "code": code, **more}}


def _with_pictures(call: Call) -> bool:
    return call.pictures > 0


CANNED_ERRORS: Mapping[str, CannedError] = MappingProxyType(
    {
        "unavailable": CannedError(
            "status 503, overloaded", 503, _error("The model is overloaded")
        ),
        "bad-gateway": CannedError("status 502 with a web page", 502, _PAGE.format("Bad gateway")),
        "rate-limit-in-words": CannedError(
            "status 429, the wait in the text only",
            429,
            _error(f"{_QUOTA} Please retry in 0.05s.", 429, status="RESOURCE_EXHAUSTED"),
        ),
        "no-pictures": CannedError(
            "status 500 of a server for text",
            500,
            _error(
                "image input is not supported - hint: provide the mmproj", 500, type="server_error"
            ),
            when=_with_pictures,
        ),
        "text-only": CannedError(
            "status 400: the content must be a string",
            400,
            _error("messages[1].content must be a string", type="invalid_request_error"),
            when=_with_pictures,
        ),
        "one-picture": CannedError(
            "status 400 with more than one picture",
            400,
            {"object": "error", "message": "At most 1 image(s) may be provided in one prompt."},
            when=lambda call: call.pictures > 1,
        ),
        "large-pictures": CannedError(
            "status 400: the picture is too large",
            400,
            _error("image dimensions exceed max allowed size: 512 pixels"),
            when=_with_pictures,
        ),
        "content-filter": CannedError(
            "status 400: the provider's filter refuses",
            400,
            _error(
                "The response was filtered due to the prompt triggering the content management "
                "policy.",
                "content_filter",
                innererror={"code": "ResponsibleAIPolicyViolation"},
            ),
        ),
        "error-in-reply": CannedError(
            "status 200 with an error in the body",
            200,
            _error("Provider returned error: upstream is overloaded", 502),
        ),
        "wrong-key-in-reply": CannedError(
            "status 200 with the error of a wrong key in the body",
            200,
            _error("No auth credentials found", 401),
        ),
        "no-system-role": CannedError(
            "status 400 where there is a system prompt",
            400,
            _error("System role not supported", "invalid_request_error"),
            when=lambda call: call.has_system_role,
        ),
        "alternating-roles": CannedError(
            "status 500 of a chat template where there is a system prompt",
            500,
            _error("Conversation roles must alternate user/assistant/user/assistant/..."),
            when=lambda call: call.has_system_role,
        ),
        "no-temperature": CannedError(
            "status 400 where a temperature is sent",
            400,
            _error(
                "Unsupported value: 'temperature' does not support 0.0 with this model. Only the "
                "default (1) value is supported.",
                "unsupported_value",
                param="temperature",
            ),
            when=lambda call: call.sends("temperature"),
        ),
        "old-token-limit": CannedError(
            "status 400 where max_completion_tokens is sent",
            400,
            _error("Unknown parameter: 'max_completion_tokens'.", "unknown_parameter"),
            when=lambda call: call.sends("max_completion_tokens"),
        ),
        "no-reasoning-effort": CannedError(
            "status 422 where a reasoning effort is sent",
            422,
            {
                "detail": [
                    {"loc": ["body", "reasoning_effort"], "msg": "Extra inputs are not permitted"}
                ]
            },
            when=lambda call: call.sends("reasoning_effort"),
        ),
        "no-credit": CannedError(
            "status 429: the quota is used up", 429, _error(_QUOTA, "insufficient_quota")
        ),
        "payment-required": CannedError(
            "status 402", 402, _error("This request requires more credits", 402)
        ),
        "daily-limit": CannedError(
            "status 429 until tomorrow",
            429,
            _error("Rate limit exceeded: free-models-per-day"),
            {"Retry-After": "30000"},
        ),
        "wrong-key": CannedError(
            "status 400: the key is not valid",
            400,
            [
                _error(
                    "API key not valid. Please pass a valid API key.",
                    400,
                    status="INVALID_ARGUMENT",
                )
            ],
        ),
        "forbidden-key": CannedError(
            "status 403: no such key",
            403,
            {"detail": "Access denied due to invalid subscription key or wrong API endpoint."},
        ),
        "no-access": CannedError(
            "status 403: a model that the key may not use",
            403,
            _error("Project does not have access to model `gpt-x`", "model_not_found"),
        ),
        "long-context": CannedError(
            "status 400: the prompt is too long",
            400,
            _error(
                "This model's maximum context length is 4096 tokens. However, your messages "
                "resulted in 5120 tokens.",
                "context_length_exceeded",
            ),
        ),
        "long-prompt": CannedError(
            "status 500: the prompt is too long",
            500,
            _error(
                "the request exceeds the available context size", type="exceed_context_size_error"
            ),
        ),
        "high-output-limit": CannedError(
            "status 400 where an output limit is sent",
            400,
            _error(
                "max_tokens is too large: 99999. This model supports at most 4096 completion "
                "tokens."
            ),
            when=lambda call: call.sends("max_tokens", "max_completion_tokens"),
        ),
        "unknown-model": CannedError(
            "status 404: no such model",
            404,
            _error("model 'm' not found, try pulling it first", "model_not_found"),
        ),
        "invalid-model": CannedError(
            "status 400: no such model", 400, _error("m/m is not a valid model ID", 400)
        ),
        "region": CannedError(
            "status 403: not served here",
            403,
            _error("Country, region, or territory not supported", "unsupported_country_region"),
        ),
        "moved": CannedError(
            "status 308 to another address",
            308,
            "",
            {"Location": "https://elsewhere.invalid/v1/chat/completions"},
        ),
        "web-page": CannedError("status 200 with a web page", 200, _PAGE.format("Welcome")),
        "web-page-404": CannedError("status 404 with a web page", 404, _PAGE.format("Not found")),
        "invalid-json": CannedError(
            "status 200 with half a JSON object", 200, '{"choices": [{"mess'
        ),
        "other-json": CannedError("status 200 with JSON of another kind", 200, {"status": "ok"}),
        "nothing": CannedError("status 200 with an empty body", 200, ""),
    }
)
"""By the name of the fault."""


def rate_limit(wait: float, *, as_date: bool = False) -> CannedError:
    """A rate limit that says how long to wait.

    Args:
        wait: seconds.
        as_date: as a date (whole seconds, so the wait is longer by up to one).
    """
    value = formatdate(time.time() + wait + 1, usegmt=True) if as_date else f"{wait:g}"
    body = _error("Rate limit reached", "rate_limit_exceeded", type="rate_limit_error")
    return CannedError("status 429, says how long to wait", 429, body, {"Retry-After": value})


def echoed_key(call: Call) -> CannedError:
    """An error that repeats the key, in the forms that servers do."""
    message = f"Incorrect API key provided. Headers: {{'Authorization': '{call.authorization}'}}"
    headers = {"X-Echo": call.authorization}
    return CannedError("status 401 that repeats the key", 401, _error(message), headers)
