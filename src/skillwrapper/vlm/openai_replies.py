"""Reading the body of a reply: every form in which servers wrap what a model said."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from skillwrapper.vlm.streamed_replies import BrokenStreamError, assembled, is_stream

_CUT_OFF = re.compile(
    r"length|max\w{0,20}tokens?|(?:token|output|context)\w{0,20}(?:limit|exceed)|truncat|incomplete"
)
"""Every server has a word of its own for it."""
_REFUSED = frozenset(
    {"content_filter", "content_filtered", "filtered", "safety", "refusal",
     "refused", "prohibited_content", "blocklist", "recitation", "spii", "image_safety",
     "guardrail_intervened", "guardrails", "sensitive", "moderation", "content_policy",
     "policy_violation", "unsafe", "error_toxic"}
)  # fmt: skip
_BROKEN_OFF = frozenset(
    {"error", "abort", "aborted", "cancelled", "canceled", "network_error", "timeout", "max_time",
     "insufficient_system_resource", "engine_overloaded", "repetition", "unknown_error"}
)  # fmt: skip
"""The server could not end the answer: what there is of it is none."""
_REASONS = ("finish_reason", "native_finish_reason", "stop_reason", "finish_details", "done_reason")
_REASONING_FIELDS = ("reasoning_content", "reasoning", "thinking", "reasoning_text")
_REASONING_PARTS = frozenset({"thinking", "reasoning", "redacted_thinking"})
_A_WORD = re.compile(r"[\w-]*+")
_TEXT_KEYS = ("text", "content", "value", "output_text")
_DEEPEST = 4


class NoCompletionError(Exception):
    """The body is no chat completion.

    Args:
        what: it is instead.
        is_broken: whether it may have been one; else something else answers at this address.
    """

    def __init__(self, what: str, *, is_broken: bool) -> None:
        super().__init__(what)
        self.is_broken = is_broken


class ErrorInReplyError(Exception):
    """The body reports an error although the status says that all went well.

    Args:
        status: the status that the provider meant, or 500 if it does not tell.
        body: the error as it came.
    """

    def __init__(self, status: int, body: object) -> None:
        super().__init__("an error in a reply")
        self.status, self.body = status, body


@dataclass(frozen=True)
class Completion:
    """What a model said.

    Attributes:
        text: the answer; may be empty.
        refusal: what it said in refusing; None if it did not refuse.
        cut_off: whether the answer ended because a limit on its length was reached.
        reason: the finish reason, for messages.
        input_tokens: None if not told.
        output_tokens: None if not told.
    """

    text: str
    refusal: str | None
    cut_off: bool
    reason: str
    input_tokens: int | None
    output_tokens: int | None


def read_completion(body: bytes) -> Completion:
    """The completion in a body.

    Raises:
        NoCompletionError: if it holds none.
        ErrorInReplyError: if it holds an error.
    """
    data = _json_object(body)
    choices = data.get("choices")
    if data.get("error") and not choices:
        raise _reported(data["error"])
    if not isinstance(choices, list):
        raise NoCompletionError("JSON without choices", is_broken=False)
    usage = data.get("usage")
    counted = usage if isinstance(usage, dict) else {}
    tokens = (_count(counted.get("prompt_tokens")), _count(counted.get("completion_tokens")))
    if not choices:
        return Completion("", None, False, "no choice", *tokens)
    choice = choices[0]
    if not isinstance(choice, dict):
        raise NoCompletionError("a choice that is no object", is_broken=True)
    if choice.get("error"):
        raise _reported(choice["error"])
    if not _BROKEN_OFF.isdisjoint(_reasons(choice)):
        raise NoCompletionError(f"an answer that broke off ({_reason(choice)})", is_broken=True)
    return _of_choice(choice, *tokens)


def _of_choice(choice: dict[str, Any], tokens_in: int | None, tokens_out: int | None) -> Completion:
    message = choice.get("message")
    if message is None and isinstance(choice.get("text"), str):
        message = {"content": choice["text"]}
    if not isinstance(message, dict):
        raise NoCompletionError("a choice without a message", is_broken=True)
    reason = _reason(choice)
    text, refusal = _text(message.get("content")), _text(message.get("refusal"))
    refusal = refusal or _refusal_part(message.get("content"))
    cut_off = any(_CUT_OFF.search(why) for why in _reasons(choice))
    if not text.strip() and not refusal and not cut_off:
        others = (_tool_calls(message), *(_text(message.get(f)) for f in _REASONING_FIELDS))
        text = next(filter(str.strip, others), "")
    refused = bool(refusal) or not _REFUSED.isdisjoint(_reasons(choice))
    return Completion(
        text, (refusal or text) if refused else None, cut_off, reason, tokens_in, tokens_out
    )


def _reason(choice: Mapping[str, Any]) -> str:
    return next((_plain_reason(choice[name]) for name in _REASONS if choice.get(name)), "none")


def _reasons(choice: Mapping[str, Any]) -> tuple[str, ...]:
    """What server and provider say of the end, which may be two things, in plain words."""
    said = (_plain_reason(choice.get(name)).lower() for name in _REASONS)
    return tuple(re.sub(r"[ -]", "_", why.removeprefix("finish_reason_")) for why in said)


def _plain_reason(reason: object) -> str:
    if isinstance(reason, Mapping):
        reason = reason.get("type") or reason.get("reason")
    return reason if isinstance(reason, str) else ""


def _tool_calls(message: Mapping[str, Any]) -> str:
    """The calls of a model that answers with tools which nobody offered, a line for each."""
    calls = message.get("tool_calls")
    functions = [
        call.get("function", call)
        for call in (calls if isinstance(calls, list) else ())
        if isinstance(call, dict)
    ] or [message.get("function_call")]
    written = (_call(function) for function in functions if isinstance(function, dict))
    return "\n".join(filter(None, written))


def _call(function: Mapping[str, Any]) -> str:
    """Name and arguments as one object, of which the arguments often come as a string."""
    name, arguments = function.get("name"), function.get("arguments", {})
    if isinstance(arguments, str):
        try:
            arguments = json.loads(arguments or "{}")
        except (ValueError, RecursionError):
            return ""
    values = list(arguments.values()) if isinstance(arguments, dict) else [arguments]
    if len(values) == 1 and isinstance(values[0], str) and not _A_WORD.fullmatch(values[0]):
        return values[0]  # the answer itself, and no name of an object
    return json.dumps({"name": name, "arguments": arguments}) if isinstance(name, str) else ""


def _json_object(body: bytes) -> dict[str, Any]:
    if is_stream(body):
        try:
            return assembled(body)
        except BrokenStreamError:
            raise NoCompletionError("a stream that broke off", is_broken=True) from None
    try:
        data = json.loads(body)
    except (ValueError, RecursionError):
        start = body[:200].lstrip().lower()
        if start.startswith((b"<!doctype", b"<html", b"<?xml", b"<head", b"<body")):
            raise NoCompletionError("a web page", is_broken=False) from None
        raise NoCompletionError("no JSON" if body.strip() else "nothing", is_broken=True) from None
    if isinstance(data, list) and len(data) == 1 and isinstance(data[0], dict):
        data = data[0]  # Google wraps errors in a list
    if not isinstance(data, dict):
        raise NoCompletionError("JSON of another shape", is_broken=False)
    return data


def _reported(error: object) -> ErrorInReplyError:
    status = 500
    if isinstance(error, dict):
        for name in ("code", "status", "status_code"):
            value = error.get(name)
            number = int(value) if isinstance(value, str) and value.isdecimal() else value
            if isinstance(number, int) and not isinstance(number, bool) and 400 <= number < 600:
                status = number
                break
    return ErrorInReplyError(status, error)


def _text(content: object, depth: int = 0) -> str:
    """The text in a message's content: a string, or parts of which some are no answer."""
    if isinstance(content, str):
        return content
    if depth > _DEEPEST:
        return ""
    if isinstance(content, list):
        return "".join(_text(part, depth + 1) for part in content)
    if isinstance(content, dict) and content.get("type") not in _REASONING_PARTS | {"refusal"}:
        return next(filter(None, (_text(content.get(k), depth + 1) for k in _TEXT_KEYS)), "")
    return ""


def _refusal_part(content: object) -> str:
    if not isinstance(content, list):
        return ""
    parts = (p for p in content if isinstance(p, dict) and p.get("type") == "refusal")
    return "".join(str(part.get("refusal") or "") for part in parts)


def _count(value: object) -> int | None:
    is_count = isinstance(value, int) and not isinstance(value, bool) and value >= 0
    return value if is_count else None  # type: ignore[return-value]
