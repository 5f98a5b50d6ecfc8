"""The chat-completions protocol, as far as our test server speaks it."""

from __future__ import annotations

import base64
import binascii
import hashlib
import json
import re
from typing import Any

from skillwrapper.errors import UserError
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role
from skillwrapper.world.observation import Picture

_DATA_URL = "data:image/"


class BadChatRequestError(UserError):
    """A request body that is no chat-completions request."""


def read_request(body: bytes) -> tuple[str, ModelRequest]:
    """The name of the model that is asked, and what it is asked.

    Raises:
        BadChatRequestError: if the body is not what the protocol asks for.
    """
    try:
        data = json.loads(body)
        system = [_text(m["content"]) for m in data["messages"] if m["role"] == "system"]
        user = [m["content"] for m in data["messages"] if m["role"] == "user"]
        pictures = tuple(picture for content in user for picture in _pictures(content))
        prompt = "\n".join(_text(content) for content in user)
        # Which role a prompt has is not part of the protocol; the embedded model asks no role.
        return str(data["model"]), ModelRequest(Role.EVALUATE, "\n".join(system), prompt, pictures)
    except (ValueError, KeyError, TypeError, binascii.Error) as error:
        raise BadChatRequestError(
            f"expected a chat-completions request, got {type(error).__name__}: {error}"
        ) from error


def completion(model: str, reply: ModelReply, reason: str = "stop") -> dict[str, Any]:
    """The body of an answer, with its finish reason."""
    message = {"role": "assistant", "content": reply.text, "refusal": None}
    return _body(model, message, reply, reason)


def in_parts(model: str, reply: ModelReply) -> dict[str, Any]:
    """The body of an answer in parts, of which the first is no answer."""
    half = len(reply.text) // 2
    parts = [
        {"type": "thinking", "thinking": "Let me look."},
        {"type": "text", "text": reply.text[:half]},
        {"type": "text", "text": reply.text[half:]},
    ]
    return _body(model, {"role": "assistant", "content": parts}, reply)


def in_reasoning(model: str, reply: ModelReply) -> dict[str, Any]:
    """The body of an answer in the field that is meant for reasoning."""
    message = {"role": "assistant", "content": "", "reasoning_content": reply.text}
    return _body(model, message, reply)


def in_tool_call(model: str, reply: ModelReply) -> dict[str, Any]:
    """The body of an answer as the argument of a tool."""
    function = {"name": "answer", "arguments": json.dumps({"text": reply.text})}
    call = {"id": "call_0", "type": "function", "function": function}
    message = {"role": "assistant", "content": None, "tool_calls": [call]}
    return _body(model, message, reply, "tool_calls")


def in_events(model: str, reply: ModelReply) -> str:
    """The body of an answer as a stream of events, a word in each."""
    words = re.findall(r"\s*\S+|\s+$", reply.text)
    chunks: list[dict[str, Any]] = [
        {"choices": [{"index": 0, "delta": {"content": word}, "finish_reason": None}]}
        for word in words
    ]
    usage = _body(model, {}, reply)["usage"]
    chunks.append({"choices": [{"index": 0, "delta": {}, "finish_reason": "stop"}], "usage": usage})
    events = (f"data: {json.dumps({'model': model, **chunk})}\n\n" for chunk in chunks)
    return "".join((": keep-alive\n\n", *events, "data: [DONE]\n\n"))


def refusal(model: str, reply: ModelReply) -> dict[str, Any]:
    """The body of a refusal."""
    said = "I'm sorry, but I can't help with that."
    return _body(model, {"role": "assistant", "content": None, "refusal": said}, reply)


def without_choice(model: str, reply: ModelReply) -> dict[str, Any]:
    """The body of an answer that holds none."""
    return {**_body(model, {}, reply), "choices": []}


def error_body(message: str, kind: str, code: str | None = None) -> dict[str, Any]:
    """The body of an error."""
    return {"error": {"message": message, "type": kind, "param": None, "code": code}}


def _body(
    model: str, message: dict[str, Any], reply: ModelReply, reason: str = "stop"
) -> dict[str, Any]:
    tokens_in, tokens_out = reply.usage.input_tokens or 0, reply.usage.output_tokens or 0
    digest = hashlib.sha256(reply.text.encode("utf-8", "surrogatepass")).hexdigest()
    return {
        "id": f"chatcmpl-{digest[:24]}",
        "object": "chat.completion",
        "created": 0,
        "model": model,
        "choices": [{"index": 0, "message": message, "finish_reason": reason, "logprobs": None}],
        "usage": {
            "prompt_tokens": tokens_in,
            "completion_tokens": tokens_out,
            "total_tokens": tokens_in + tokens_out,
        },
    }


def _text(content: Any) -> str:
    if isinstance(content, str):
        return content
    return "\n".join(part["text"] for part in content if part["type"] == "text")


def _pictures(content: Any) -> list[Picture]:
    if isinstance(content, str):
        return []
    urls = [part["image_url"]["url"] for part in content if part["type"] == "image_url"]
    for url in urls:
        if not url.startswith(_DATA_URL):
            raise ValueError("pictures must be data URLs")
    return [Picture(base64.b64decode(url.partition(",")[2], validate=True)) for url in urls]
