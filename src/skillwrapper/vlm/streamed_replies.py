"""Putting together a reply that was streamed, although nobody had asked for that.

Some servers and proxies always send server-sent events. See the streaming format of the
chat-completions protocol: lines ``data: {...}`` with pieces of the message, the last ``[DONE]``.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

_STARTS = (b"data:", b"event:", b"id:", b"retry:", b": ")
_DONE = "[DONE]"
_TEXTS = ("content", "refusal", "reasoning_content", "reasoning")


class BrokenStreamError(ValueError):
    """The stream ended before the reply did, or holds what is no piece of one."""


def is_stream(body: bytes) -> bool:
    """Whether a body is a stream of events, rather than JSON."""
    return body[:200].lstrip().startswith(_STARTS)


def assembled(body: bytes) -> dict[str, Any]:
    """The completion that a stream would have been in one piece; an error if it brought one.

    Raises:
        BrokenStreamError: if the reply did not come to its end.
    """
    texts = dict.fromkeys(_TEXTS, "")
    calls: dict[int, dict[str, str]] = {}
    usage, reason, is_done = None, None, False
    for event in _events(body):
        if event == _DONE:
            is_done = True
            break
        chunk = _object(event)
        if chunk.get("error"):
            return {"error": chunk["error"]}
        usage = chunk.get("usage") or usage
        choice = _first(chunk.get("choices"))
        piece = choice.get("delta") or choice.get("message") or {}
        if not isinstance(piece, dict):
            raise BrokenStreamError
        for name in _TEXTS:
            texts[name] += _text(piece.get(name))
        _add_calls(calls, piece.get("tool_calls"))
        reason = choice.get("finish_reason") or reason
    if not (is_done or reason):
        raise BrokenStreamError
    message = {**texts, "tool_calls": [{"function": calls[n]} for n in sorted(calls)]}
    return {"choices": [{"message": message, "finish_reason": reason}], "usage": usage}


def _events(body: bytes) -> Iterator[str]:
    """The data of all events; comments and names of events are left out."""
    for line in body.decode("utf-8", errors="replace").splitlines():
        if line.startswith("data:") and line[5:].strip():
            yield line[5:].strip()


def _object(text: str) -> dict[str, Any]:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        raise BrokenStreamError from None
    if not isinstance(data, dict):
        raise BrokenStreamError
    return data


def _first(choices: object) -> dict[str, Any]:
    first = choices[0] if isinstance(choices, list) and choices else {}
    return first if isinstance(first, dict) else {}


def _text(piece: object) -> str:
    return piece if isinstance(piece, str) else ""


def _add_calls(calls: dict[int, dict[str, str]], pieces: object) -> None:
    """Names and arguments of tool calls, which come in pieces as well."""
    for number, piece in enumerate(pieces if isinstance(pieces, list) else ()):
        function = piece.get("function") if isinstance(piece, dict) else None
        if isinstance(function, dict):
            index = piece.get("index")
            known = calls.setdefault(
                index if isinstance(index, int) else number, {"name": "", "arguments": ""}
            )
            for name in known:
                known[name] += _text(function.get(name))
