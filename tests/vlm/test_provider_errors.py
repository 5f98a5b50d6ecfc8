"""Every row of the table of errors, against the test server: kind, advice, and whether to retry.

The forms come from public reports on inference servers and clients (vLLM, llama.cpp, Ollama, Azure,
OpenRouter, Google, ...): what is wrong stands in the words, the status often says something else.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from email.utils import formatdate
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from scripted import ScriptedModel

from skillwrapper.embedded import server_faults as faults
from skillwrapper.embedded.canned_errors import CANNED_ERRORS
from skillwrapper.embedded.server import SEEING, ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FAULTS, FaultPlan
from skillwrapper.errors import (
    AuthenticationError,
    ModelCapabilityError,
    ModelNotFoundError,
    ModelUnavailableError,
    ProviderError,
    TemporaryProviderError,
    UnusableReplyError,
)
from skillwrapper.vlm.openai_model import OpenAIModel, OpenAISettings
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role
from skillwrapper.vlm.provider_errors import ROWS, row_of
from skillwrapper.vlm.retry_after import wait_asked_for
from skillwrapper.world import Picture, encode_png

SAID = "holding(robot, patty): true\nis_cut(lettuce): false"
ASKING = {"temperature": 0.0, "reasoning_effort": "low", "max_output_tokens": 99}


@pytest.fixture(autouse=True)
def _no_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_API_KEY", "OPENAI_BASE_URL", "HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


def picture(shade: int) -> Picture:
    return Picture(encode_png(Image.new("RGB", (40, 20), (shade, 200, 30))))


REQUEST = ModelRequest(Role.EVALUATE, "be brief", "hello", (picture(1), picture(2)))


def ask(fault: str, **settings: Any) -> tuple[ModelReply, list[ModelRequest]]:
    """The reply of a server with a fault, and what the model behind it was asked."""
    behind = ScriptedModel(lambda _: SAID)
    plan = FaultPlan(1.0, (fault,), retry_after=1.5, slowness=0.01)
    with VlmServer(behind, ServerSettings(faults=plan)) as server:
        model = OpenAIModel(OpenAISettings(SEEING, base_url=server.url, **settings))
        try:
            return model.complete(REQUEST), behind.requests
        finally:
            model.close()


ERRORS: dict[str, tuple[type[ProviderError], str]] = {
    faults.RATE_LIMIT: (TemporaryProviderError, "status 429"),
    faults.RATE_LIMIT_DATE: (TemporaryProviderError, "status 429"),
    "rate-limit-in-words": (TemporaryProviderError, "status 429"),
    faults.SERVER_ERROR: (TemporaryProviderError, "status 500"),
    faults.CUT: (TemporaryProviderError, "connection to .* broke"),
    faults.TRUNCATED: (TemporaryProviderError, "no JSON"),
    faults.DRIP: (TemporaryProviderError, "did not answer in time"),
    faults.EMPTY: (UnusableReplyError, "replied nothing"),
    faults.REFUSAL: (UnusableReplyError, "refused: I'm sorry"),
    faults.FILTERED: (UnusableReplyError, "refused"),
    faults.KEY_IN_ERROR: (AuthenticationError, "valid key"),
    faults.STREAM_CUT: (TemporaryProviderError, "a stream that broke off"),
    faults.BROKEN_OFF: (TemporaryProviderError, r"an answer that broke off \(error\)"),
    "unavailable": (TemporaryProviderError, "overloaded"),
    "bad-gateway": (TemporaryProviderError, "a web page"),
    "no-pictures": (ModelCapabilityError, "choose a model that accepts pictures"),
    "text-only": (ModelCapabilityError, "choose a model that accepts pictures"),
    "one-picture": (ModelCapabilityError, "takes several pictures"),
    "large-pictures": (ModelCapabilityError, "--image-size"),
    "content-filter": (UnusableReplyError, "content management"),
    "error-in-reply": (TemporaryProviderError, "upstream is overloaded"),
    "wrong-key-in-reply": (AuthenticationError, "valid key"),
    "no-credit": (ModelUnavailableError, "top up"),
    "payment-required": (ModelUnavailableError, "top up"),
    "daily-limit": (ModelUnavailableError, "counts anew"),
    "wrong-key": (AuthenticationError, "valid key"),
    "forbidden-key": (AuthenticationError, "valid key"),
    "no-access": (ModelNotFoundError, "your key may use"),
    "long-context": (ModelCapabilityError, "longer context"),
    "long-prompt": (ModelCapabilityError, "longer context"),
    "high-output-limit": (ProviderError, "lower --max-output-tokens"),
    "unknown-model": (ModelNotFoundError, "name of the model"),
    "invalid-model": (ModelNotFoundError, "name of the model"),
    "region": (ProviderError, "another endpoint"),
    "moved": (ModelNotFoundError, "has moved to https://elsewhere.invalid"),
    "web-page": (ModelNotFoundError, "a web page"),
    "web-page-404": (ModelNotFoundError, "end in /v1"),
    "invalid-json": (TemporaryProviderError, "no JSON"),
    "other-json": (ModelNotFoundError, "end in /v1"),
    "nothing": (TemporaryProviderError, "sent nothing"),
}
ANSWERED = (
    faults.SLOW,
    faults.CONTENT_PARTS,
    faults.REASONING_FIELD,
    faults.STREAMED,
    faults.TOOL_CALL,
    "no-system-role",
    "alternating-roles",
    "no-temperature",
    "old-token-limit",
    "no-reasoning-effort",
)
SPOILT = {
    faults.NONSENSE,
    faults.KEY_IN_REPLY,
    faults.ALL_TRUE,
    faults.ALL_FALSE,
    faults.DEAF,
    faults.CUT_OFF,
    faults.CUT_OFF_THINKING,
}


def test_every_fault_is_tried() -> None:
    assert {*ERRORS, *ANSWERED, *SPOILT} == set(FAULTS)


@pytest.mark.parametrize("fault", ERRORS)
def test_every_error_becomes_one_of_our_exceptions(fault: str) -> None:
    kind, words = ERRORS[fault]
    with pytest.raises(ProviderError, match=words) as caught:
        ask(fault, **ASKING, timeout=0.4 if fault == faults.DRIP else 5.0)
    assert type(caught.value) is kind
    assert len(str(caught.value).splitlines()) == 1
    assert caught.value.__cause__ is None


@pytest.mark.parametrize("fault", ANSWERED)
def test_what_an_endpoint_does_not_know_is_done_without(fault: str) -> None:
    reply, asked = ask(fault, **ASKING)
    assert reply.text == SAID
    assert not reply.cut_off
    assert len(asked) == 1
    if fault in {"no-system-role", "alternating-roles"}:
        assert (asked[0].system, asked[0].prompt) == ("", "be brief\n\nhello")
        assert len(asked[0].pictures) == 2


@pytest.mark.parametrize("fault", [faults.CUT_OFF, faults.CUT_OFF_THINKING])
def test_a_reply_that_was_cut_off_says_so(fault: str) -> None:
    reply, _ = ask(fault)
    assert reply.cut_off
    assert SAID.startswith(reply.text)


@pytest.mark.parametrize(
    ("fault", "wait"),
    [(faults.RATE_LIMIT, 1.5), ("rate-limit-in-words", 0.05), (faults.RATE_LIMIT_DATE, 2.0)],
)
def test_the_wait_that_is_asked_for(fault: str, wait: float) -> None:
    with pytest.raises(TemporaryProviderError) as caught:
        ask(fault)
    assert caught.value.retry_after == pytest.approx(wait, abs=1.5 if "date" in fault else 0.001)


def test_a_dialect_is_found_out_once() -> None:
    behind = ScriptedModel(lambda _: SAID)
    plan = FaultPlan(1.0, ("no-system-role",))
    with VlmServer(behind, ServerSettings(faults=plan)) as server:
        model = OpenAIModel(OpenAISettings(SEEING, base_url=server.url))
        for _ in range(3):
            model.complete(REQUEST)
        model.close()
        assert server.calls == 4


def test_a_plain_string_where_no_picture_goes_along() -> None:
    """Servers for text take nothing else: the fault only lets strings pass."""
    behind = ScriptedModel(lambda _: SAID)
    with VlmServer(behind, ServerSettings(faults=FaultPlan(1.0, ("text-only",)))) as server:
        model = OpenAIModel(OpenAISettings(SEEING, base_url=server.url))
        assert model.complete(ModelRequest(Role.SUMMARISE, "s", "p")).text == SAID
        model.close()


# Each in the words of another server; (status, words, name of the row).
IN_OTHER_WORDS = [
    (403, "This would exceed your account's rate limit. Try again later.", "busy, by the words"),
    (499, "client closed request", "busy, by the words"),
    (403, "error code: 1010", "kept out by a firewall"),
    (403, "Access denied by the firewall", "kept out by a firewall"),
    (400, "The api_key client option must be set", "wrong key, in words"),
    (429, "Usage limits are reached. You will regain access on 2031-02-01", "daily limit"),
    (400, "No models loaded. Please load a model in the developer page", "unknown model"),
    (400, "Your credit balance is too low to access the API", "no credit"),
    (413, "Request too large on tokens per minute (TPM): Limit 6000", "context too short"),
    (500, "image input is not supported - hint: provide the mmproj", "no pictures"),
    (400, "Invalid content type. image_url is only supported by certain models.", "no pictures"),
    (404, "No endpoints found that support image input", "no pictures"),
    (400, "google/x is not a multimodal model", "no pictures"),
    (422, "unknown variant `image_url`, expected `text`", "no pictures"),
    (400, "At most 0 image(s) may be provided in one request.", "no pictures"),
    (500, "this model is missing data required for image input", "no pictures"),
    (400, "This model doesn't support images", "no pictures"),
    (400, "At most 1 image(s) may be provided in one request.", "too many pictures"),
    (400, "Too many images in request: 4 > 1", "too many pictures"),
    (400, "multiple images are not supported", "too many pictures"),
    (400, "image exceeds 5 MB maximum: 6291456 bytes > 5242880 bytes", "picture too large"),
    (403, "input flagged by moderation", "content filter"),
    (400, "Your request was rejected as a result of our safety system", "content filter"),
    (400, "Output may contain bad things, data_inspection_failed", "content filter"),
    (401, "invalid x-api-key, authentication_error", "wrong key"),
    (401, "User not found.", "wrong key"),
    (400, "Incorrect API key provided: ab***yz", "wrong key, in words"),
    (403, "Method doesn't allow unregistered callers. API key missing", "wrong key, in words"),
    (429, "Your credit balance is too low to access the API", "no credit"),
    (400, "Your credit balance is too low to access the API", "no credit"),
    (403, "Insufficient Balance", "no credit"),
    (402, "", "payment required"),
    (400, "maximum context length is 4096 tokens, your prompt has 9000", "context too short"),
    (400, "prompt is too long: 210000 tokens > 200000 maximum", "context too short"),
    (400, "Input length 5000 exceeds maximum allowed token count", "context too short"),
    (500, "input length exceeds the context window", "context too short"),
    (404, "model `qwen` not found", "unknown model"),
    (400, "The model `gpt-3.9` has been decommissioned", "unknown model"),
    (404, "The API deployment does not exist. DeploymentNotFound", "unknown model"),
    (404, "<html>", "no such path"),
    (400, "Developer instruction is not enabled for models/gemma-3", "no system role"),
    (500, "Only user and assistant roles are supported!", "no system role"),
    (400, "'max_tokens' is not supported with this model", "no max_completion_tokens"),
    (422, "max_completion_tokens, extra fields not permitted", "no max_completion_tokens"),
    (400, "`temperature` is deprecated for this model", "no temperature"),
    (400, "Unrecognized request argument supplied: reasoning_effort", "no reasoning effort"),
    (400, "Client sent an HTTP request to an HTTPS server.", "HTTP where TLS is spoken"),
    (529, "Overloaded", "busy"),
    (503, "The model is loading, not found in cache", "busy"),
    (500, "CUDA out of memory", "server error"),
    (403, "Key limit exceeded (total limit). Manage it in the settings", "no credit"),
    (429, "账户余额不足", "no credit"),
    (400, "Content Exists Risk, invalid_request_error", "content filter"),
    (400, "系统检测到输入或生成内容可能包含不安全或敏感内容, 1301", "content filter"),
    (400, "Your organization must be verified to use the model `o3`", "model not for this key"),
    (403, "Model requires a Pro subscription", "model not for this key"),
    (400, "Invalid max_tokens value, the valid range of max_tokens is [1, 8192]",
     "output limit too high"),
    (400, "Unsupported value: 'messages[0].role' does not support 'system' with this model.",
     "no system role"),
    (400, "Unsupported value: 'temperature' does not support 0 with this model.",
     "no temperature"),
    (400, "invalid reasoning_effort: must be one of low, medium, high", "no reasoning effort"),
    (400, "Thinking mode is not supported by this model", "no reasoning effort"),
    (400, "Invalid value: 'image_url'. Supported values are: 'text'.", "no pictures"),
    (400, "Could not process image, invalid_image", "picture not read"),
    (400, "Provided image is not valid.", "picture not read"),
    (500, "Failed to load image: cannot identify image file", "picture not read"),
    (400, "Range of input length should be [1, 30720]", "context too short"),
    (400, "chatCompletion does not work with the specified model", "unknown model"),
    (500, "model requires more system memory (11.2 GiB) than is available (7.7 GiB)",
     "model too large for its machine"),
    (424, "upstream failed", "busy"),
    (498, "capacity exceeded", "busy"),
    (503, "Unable to load images right now", "busy"),
    (400, "Invalid 'temperature': expected a value <= 2", "other"),
    (400, "odd", "other"),
]  # fmt: skip


@pytest.mark.parametrize(("status", "said", "name"), IN_OTHER_WORDS)
def test_the_same_in_other_words(status: int, said: str, name: str) -> None:
    assert row_of(status, said, None).name == name


def test_every_row_is_reached() -> None:
    reached = {name for _, _, name in IN_OTHER_WORDS}
    for error in CANNED_ERRORS.values():
        reached.add(row_of(error.status, str(error.body), None).name)
    reached |= {
        row_of(429, "insufficient_quota", 3.0).name,
        row_of(429, "quota", 3.0).name,
        row_of(429, "Request too large for x on tokens per min", None).name,
        *(row_of(status, "", None).name for status in (407, 403, 413, 451)),
    }
    assert reached == {row.name for row in ROWS}


@given(st.integers(200, 599), st.text(max_size=200))
def test_every_error_fits_a_row(status: int, said: str) -> None:
    assert row_of(status, said, None).make("x").args


def headers() -> Iterator[tuple[dict[str, str], str, float | None]]:
    yield {"retry-after": "7"}, "", 7.0
    yield {"retry-after-ms": "250"}, "", 0.25
    yield {"retry-after": formatdate(1_000_090, usegmt=True)}, "", 90.0
    yield {"retry-after": formatdate(999_000, usegmt=True)}, "", 0.0
    yield {"retry-after": "soon"}, "", None
    yield {"retry-after": "nan"}, "", None
    yield {}, "Please try again in 1.5s.", 1.5
    yield {}, "Please try again in 120ms", 0.12
    yield {}, "try again in 1m30s", 90.0
    yield {}, "Please retry after 20 seconds", 20.0
    yield {}, '{"retryDelay": "34s"}', 34.0
    yield {}, "busy", None


@pytest.mark.parametrize(("told", "said", "wait"), list(headers()))
def test_forms_of_the_wait(told: dict[str, str], said: str, wait: float | None) -> None:
    assert wait_asked_for(told, said, now=1_000_000.0) == wait


def test_a_table_of_patterns_takes_linear_time() -> None:
    began = time.process_time()
    for piece in ("image not ", "max_tokens unsupported ", "a" * 9, "retry in ", "system role "):
        row_of(400, piece * (20_000 // len(piece)), None)
        wait_asked_for({}, piece * (20_000 // len(piece)))
    assert time.process_time() - began < 10
