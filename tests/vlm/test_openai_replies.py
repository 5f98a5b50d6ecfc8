"""Bodies of replies in the forms of other servers, proxies and gateways."""

from __future__ import annotations

import json
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillwrapper.vlm.openai_replies import (
    Completion,
    ErrorInReplyError,
    NoCompletionError,
    read_completion,
)


def read(message: dict[str, Any], reason: str | None = "stop", **more: Any) -> Completion:
    choice = {"index": 0, "message": message, "finish_reason": reason}
    return read_completion(json.dumps({"choices": [choice], **more}).encode())


def events(*chunks: object, done: bool = True) -> bytes:
    lines = [f"data: {json.dumps(chunk)}\n\n" for chunk in chunks]
    return "".join([": ping\n\n", *lines, "data: [DONE]\n\n" * done]).encode()


def piece(reason: str | None = None, **delta: Any) -> dict[str, Any]:
    return {"choices": [{"index": 0, "delta": delta, "finish_reason": reason}]}


@pytest.mark.parametrize(
    "content",
    [
        "a: true",
        [{"type": "text", "text": "a: "}, {"type": "text", "text": "true"}],
        [{"type": "output_text", "text": "a: true"}],
        [{"text": "a: true"}],
        ["a: ", "true"],
        {"type": "text", "text": "a: true"},
        [{"type": "text", "text": {"value": "a: true"}}],
        [{"type": "thinking", "thinking": [{"text": "b: true"}]}, {"text": "a: true"}],
        [{"type": "reasoning", "text": "b: true"}, {"type": "text", "text": "a: true"}],
    ],
    ids=repr,
)
def test_content_in_every_form(content: object) -> None:
    assert read({"content": content, "reasoning_content": "no"}).text == "a: true"


@pytest.mark.parametrize(
    ("message", "reason"),
    [
        ({"content": None, "refusal": "I cannot."}, "stop"),
        ({"content": [{"type": "refusal", "refusal": "I cannot."}]}, "stop"),
        ({"content": "I cannot."}, "SAFETY"),
        ({"content": "I cannot."}, "FINISH_REASON_SAFETY"),
        ({"content": "I cannot."}, "refusal"),
        ({"content": "I cannot."}, "content_filtered"),
        ({"content": "I cannot.", "refusal": ""}, "content-filter"),
    ],
)
def test_refusals(message: dict[str, Any], reason: str) -> None:
    assert read(message, reason).refusal == "I cannot."


@pytest.mark.parametrize(
    "reason",
    [
        "length", "MAX_TOKENS", "max_new_tokens", "incomplete", "FINISH_REASON_MAX_TOKENS",
        "token limit", "output_limit", "truncated", "max_tokens_reached", "stop_length",
        "model_context_window_exceeded", "context-length-exceeded",
    ],
)  # fmt: skip
def test_what_is_cut_off_is_marked(reason: str) -> None:
    assert read({"content": "a: true"}, reason).cut_off
    assert _ended(finish_reason=None, stop_reason=reason).cut_off
    assert _ended(finish_reason="stop", native_finish_reason=reason).cut_off
    assert _ended(finish_details={"type": reason}).cut_off
    assert _ended(done_reason=reason).cut_off


@pytest.mark.parametrize(
    "reason", ["stop", "eos", "STOP", "end_turn", "COMPLETE", "tool_calls", ""]
)
def test_what_came_to_its_end_is_whole(reason: str) -> None:
    whole = _ended(finish_reason=reason, stop_reason=107, finish_details=None)
    assert (whole.text, whole.cut_off, whole.refusal) == ("a: true", False, None)


def _ended(**reasons: Any) -> Completion:
    choice = {"message": {"content": "a: true"}, **reasons}
    return read_completion(json.dumps({"choices": [choice]}).encode())


@pytest.mark.parametrize("reason", ["error", "abort", "network_error", "cancelled", "repetition"])
def test_what_the_server_could_not_end_is_no_answer(reason: str) -> None:
    with pytest.raises(NoCompletionError, match="broke off") as caught:
        read({"content": "a: true"}, reason)
    assert caught.value.is_broken


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ('{"text": "a(b): true\\nc(d): false"}', "a(b): true\nc(d): false"),
        ({"summary": "a(b): true"}, "a(b): true"),
        ('{"item": "cup"}', '{"name": "Pick", "arguments": {"item": "cup"}}'),
        ({}, '{"name": "Pick", "arguments": {}}'),
        ("", '{"name": "Pick", "arguments": {}}'),
        ('{"item": "cu', ""),
    ],
)
def test_tools_that_nobody_offered(arguments: object, text: str) -> None:
    function = {"name": "Pick", "arguments": arguments}
    called = {"content": None, "tool_calls": [{"id": "1", "function": function}]}
    assert read(called, "tool_calls").text == text
    assert read({"content": "", "function_call": function}, "function_call").text == text
    assert read({**called, "content": "a: true"}).text == "a: true"


def test_a_stream_reads_like_the_reply_in_one_piece() -> None:
    body = events(
        piece(role="assistant", content=""),
        piece(reasoning_content="Is it?"),
        piece(content="a: "),
        piece(content="true"),
        piece("stop"),
        {"choices": [], "usage": {"prompt_tokens": 7, "completion_tokens": 2}},
    )
    assert read_completion(body) == Completion("a: true", None, False, "stop", 7, 2)


def test_a_streamed_tool_call() -> None:
    parts = [
        {"tool_calls": [{"index": 0, "function": {"name": "Pick", "arguments": '{"item":'}}]},
        {"tool_calls": [{"index": 0, "function": {"arguments": ' "cup"}'}}]},
    ]
    body = events(*(piece(**part) for part in parts), piece("tool_calls"))
    assert read_completion(body).text == '{"name": "Pick", "arguments": {"item": "cup"}}'


@pytest.mark.parametrize(
    "body",
    [
        events(piece(content="a: true"), done=False),
        events(piece(content="a: true"), piece("stop"))[:70],
        b"data: {half\n\ndata: [DONE]\n\n",
        b"data: 7\n\n",
        b": ping\n\n: ping\n\n",
        events(piece("error", content="a: true")),
    ],
)
def test_a_stream_that_breaks_off_is_no_answer(body: bytes) -> None:
    with pytest.raises(NoCompletionError) as caught:
        read_completion(body)
    assert caught.value.is_broken


def test_an_error_in_a_stream() -> None:
    body = events(piece(content="a: "), {"error": {"code": 503, "message": "overloaded"}})
    with pytest.raises(ErrorInReplyError) as caught:
        read_completion(body)
    assert caught.value.status == 503


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(
        st.sampled_from(["choices", "message", "content", "text", "type", "error", "delta", "usage",
                         "tool_calls", "function", "arguments", "name", "finish_reason", "refusal",
                         "prompt_tokens", "index", "code"]),
        inner, max_size=4,
    ),
    max_leaves=12,
)  # fmt: skip


@given(JSON, st.booleans())
def test_whatever_a_body_holds_is_a_completion_or_one_of_our_errors(
    data: object, streamed: bool
) -> None:
    for body in (data, {"choices": [data]}, {"choices": [{"message": data, "delta": data}]}):
        with suppress(NoCompletionError, ErrorInReplyError):
            read_completion(events(body) if streamed else json.dumps(body).encode())


@given(st.binary(max_size=200))
def test_whatever_bytes_a_body_has(body: bytes) -> None:
    for sent in (body, b"data: " + body):
        with pytest.raises((NoCompletionError, ErrorInReplyError)):
            read_completion(sent)
