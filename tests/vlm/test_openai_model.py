"""The real client against the test server on this machine; nothing leaves it."""

from __future__ import annotations

import io
import json
import logging
import socket
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np
import pytest
from PIL import Image
from scripted import ScriptedModel

from skillwrapper.embedded import server_faults as faults
from skillwrapper.embedded.server import BLIND, SEEING, ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FaultChooser, FaultPlan
from skillwrapper.errors import (
    AuthenticationError,
    ConfigurationError,
    ModelCapabilityError,
    ModelNotFoundError,
    ModelUnavailableError,
    ProviderError,
    TemporaryProviderError,
    UnusableReplyError,
)
from skillwrapper.vlm.openai_model import OpenAIModel, OpenAISettings
from skillwrapper.vlm.pictures import PictureEncoder, scaled_down
from skillwrapper.vlm.prices import price_of
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.vlm.retrying import RetryingModel, RetryPolicy
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_model import StoredModel
from skillwrapper.world import Picture, encode_png

PLANTED_KEY = "sk-planted-4711-secret"


@pytest.fixture(autouse=True)
def _no_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_API_KEY", "OPENAI_BASE_URL", "HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


def png(size: tuple[int, int] = (40, 20)) -> bytes:
    return encode_png(Image.new("RGB", size, (10, 200, 30)))


def request(prompt: str = "hello") -> ModelRequest:
    return ModelRequest(Role.EVALUATE, "be brief", prompt, (Picture(png()),))


@contextmanager
def serving(
    answer: Callable[[ModelRequest], str] = lambda _: "hi there", **settings: Any
) -> Iterator[tuple[VlmServer, ScriptedModel]]:
    behind = ScriptedModel(answer)
    with VlmServer(behind, ServerSettings(**settings)) as server:
        yield server, behind


def client(server: VlmServer, model: str = SEEING, **settings: Any) -> OpenAIModel:
    return OpenAIModel(OpenAISettings(model, base_url=server.url, **settings))


def test_prompts_and_pictures_arrive_unchanged_and_the_reply_comes_back() -> None:
    with serving() as (server, behind):
        model = client(server)
        reply = model.complete(request("what is it?\n\nsay so"))
        model.close()
    (asked,) = behind.requests
    assert reply.text == "hi there"
    assert (asked.system, asked.prompt) == ("be brief", "what is it?\n\nsay so")
    assert [p.png for p in asked.pictures] == [png()]


def test_usage_is_told_and_the_price_of_an_own_endpoint_is_unknown() -> None:
    with serving() as (server, _):
        reply = client(server).complete(request())
    assert reply.usage.input_tokens == 0
    assert reply.usage.cost is None
    assert reply.usage.seconds > 0


def test_prices_of_sellers_and_of_nobody() -> None:
    price = price_of("gpt-5-2025-08-07", "https://api.openai.com/v1")
    assert price is not None
    assert price(1_000_000, 100_000) == pytest.approx(2.25)
    assert price(None, 5) is None
    assert price_of("openai/gpt-5", "https://openrouter.ai/api/v1") is not None
    assert price_of("gpt-5", "http://localhost:8000/v1") is None
    assert price_of("gpt-5", "https://notopenai.com/v1") is None
    assert price_of("brand-new", "https://api.openai.com/v1") is None


def faulty(kind: str, **settings: Any) -> Any:
    return serving(faults=FaultPlan(1.0, (kind,), **settings))


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        (faults.RATE_LIMIT, TemporaryProviderError),
        (faults.SERVER_ERROR, TemporaryProviderError),
        (faults.CUT, TemporaryProviderError),
        (faults.TRUNCATED, TemporaryProviderError),
        (faults.EMPTY, UnusableReplyError),
        (faults.REFUSAL, UnusableReplyError),
    ],
)
def test_every_fault_becomes_one_of_our_exceptions(
    fault: str, expected: type[ProviderError]
) -> None:
    with faulty(fault) as (server, _), pytest.raises(expected) as caught:
        client(server).complete(request())
    assert type(caught.value) is expected


def test_the_wait_that_a_server_asks_for_is_understood() -> None:
    with (
        faulty(faults.RATE_LIMIT, retry_after=1.5) as (server, _),
        pytest.raises(TemporaryProviderError) as caught,
    ):
        client(server).complete(request())
    assert caught.value.retry_after == 1.5


def test_a_slow_server_times_out() -> None:
    with faulty(faults.SLOW, slowness=0.5) as (server, _):
        with pytest.raises(TemporaryProviderError, match="did not answer in time"):
            client(server, timeout=0.1).complete(request())
        assert client(server, timeout=5).complete(request()).text == "hi there"


def test_nonsense_is_a_reply_like_any_other_to_the_client() -> None:
    with faulty(faults.NONSENSE) as (server, _):
        assert "Colourless" in client(server).complete(request()).text


def test_a_third_of_all_calls_may_fail() -> None:
    plan = FaultPlan(0.3, tuple(f for f in faults.PASSING if f != faults.NONSENSE), slowness=0.01)
    with serving(lambda r: f"reply to {r.prompt}", faults=plan) as (server, _):
        model = RetryingModel(client(server), RetryPolicy(first_wait=0.001))
        for number in range(60):
            assert model.complete(request(str(number))).text == f"reply to {number}"
        assert server.calls > 70


def test_faults_depend_on_the_question_and_not_on_the_order_of_arrival() -> None:
    plan = FaultPlan(0.5, seed=3)
    questions = [str(number) for number in range(50)]
    one, two = FaultChooser(plan), FaultChooser(plan)
    faults = {question: one.choose(question) for question in questions}
    assert faults == {question: two.choose(question) for question in reversed(questions)}
    assert 10 < sum(fault is not None for fault in faults.values()) < 40
    assert one.choose("0") is two.choose("0")


def test_no_key_where_one_is_needed() -> None:
    with pytest.raises(AuthenticationError, match="set the environment variable OPENAI_API_KEY"):
        OpenAIModel(OpenAISettings("gpt-5"))


def test_a_wrong_key(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", PLANTED_KEY)
    with (
        serving(key="another") as (server, _),
        pytest.raises(AuthenticationError, match=r"status 401.*OPENAI_API_KEY"),
    ):
        client(server).complete(request())
    with serving(key=PLANTED_KEY) as (server, _):
        assert client(server).complete(request()).text == "hi there"


def test_an_unknown_model() -> None:
    with (
        serving() as (server, _),
        pytest.raises(ModelNotFoundError, match="'gpt-9' does not exist"),
    ):
        client(server, "gpt-9").complete(request())


def test_a_model_without_vision() -> None:
    with serving() as (server, _):
        with pytest.raises(ModelCapabilityError, match="choose a model that accepts pictures"):
            client(server, BLIND).complete(request())
        assert client(server, BLIND).complete(ModelRequest(Role.SUMMARISE, "", "x")).text


def test_an_address_where_nobody_answers_is_told_at_once() -> None:
    with socket.socket() as reserved:
        reserved.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{reserved.getsockname()[1]}/v1"
        model = RetryingModel(OpenAIModel(OpenAISettings("m", base_url=url)))
        with pytest.raises(ModelNotFoundError, match="nobody answers at"):
            model.complete(request())


def test_a_server_that_goes_away_later_is_waited_for() -> None:
    with serving() as (server, _):
        model = client(server)
        model.complete(request())
    with pytest.raises(TemporaryProviderError):
        model.complete(request())
    with pytest.raises(TemporaryProviderError, match="nobody answers"):
        model.complete(request())


@contextmanager
def page(status: int, body: bytes, content_type: str) -> Iterator[str]:
    """A server that is no endpoint."""

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            self.rfile.read(int(self.headers["Content-Length"]))
            self.send_response(status)
            self.send_header("Content-Type", content_type)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: Any) -> None:
            pass

    server = HTTPServer(("127.0.0.1", 0), Handler)
    thread = Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_address[1]}/v1"
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.mark.parametrize(
    ("status", "body", "content_type", "expected", "words"),
    [
        (200, b"<html>welcome</html>", "text/html", ModelNotFoundError, "a web page, which is no"),
        (200, b"[1, 2]", "application/json", ModelNotFoundError, "no chat completion"),
        (200, b"null", "application/json", ModelNotFoundError, "no chat completion"),
        (200, b'{"choices": 7}', "application/json", ModelNotFoundError, "no chat completion"),
        (200, b'{"choices": [{"me', "application/json", TemporaryProviderError, "no JSON"),
        (404, b"<html>nothing here</html>", "text/html", ModelNotFoundError, "end in /v1"),
        (405, b"", "text/plain", ModelNotFoundError, "end in /v1"),
        (503, b"", "text/plain", TemporaryProviderError, "status 503"),
        (400, b'{"error": {"message": "odd"}}', "application/json", ProviderError, "odd"),
        (
            429,
            b'{"error": {"message": "no money", "code": "insufficient_quota"}}',
            "application/json",
            ModelUnavailableError,
            "top up",
        ),
        (
            400,
            b'{"error": {"message": "context length exceeded"}}',
            "application/json",
            ModelCapabilityError,
            "longer context",
        ),
    ],
)
def test_what_other_servers_answer(
    status: int, body: bytes, content_type: str, expected: type[ProviderError], words: str
) -> None:
    with page(status, body, content_type) as url, pytest.raises(expected, match=words) as caught:
        OpenAIModel(OpenAISettings("m", base_url=url)).complete(request())
    assert type(caught.value) is expected


def test_the_key_never_gets_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """Servers echo keys; neither errors, tracebacks, logs nor stores may."""
    monkeypatch.setenv("OPENAI_API_KEY", PLANTED_KEY)
    echo = json.dumps({"error": {"message": f"Incorrect key provided: {PLANTED_KEY}"}}).encode()
    written = io.StringIO()
    with caplog.at_level(logging.DEBUG), CallStore(tmp_path / "calls.sqlite") as store:
        for status in (401, 400, 404, 429, 500):
            with page(status, echo, "application/json") as url:
                model = OpenAIModel(OpenAISettings("m", base_url=url))
                kept = StoredModel(model, store)
                with pytest.raises(ProviderError) as caught:
                    RetryingModel(kept, RetryPolicy(attempts=1)).complete(request())
                traceback.print_exception(caught.value, file=written)
                written.write(repr(model) + repr(vars(model)))
        with serving() as (server, _):
            StoredModel(client(server), store).complete(request())
    text = written.getvalue() + caplog.text + str(caplog.records)
    files = b"".join(path.read_bytes() for path in tmp_path.iterdir())
    assert PLANTED_KEY not in text
    assert PLANTED_KEY.encode() not in files


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"model": ""}, "name of a model"),
        ({"model": "m", "temperature": 3.0}, "temperature"),
        ({"model": "m", "image_size": 0}, "image_size"),
        ({"model": "m", "timeout": 0}, "timeout"),
    ],
)
def test_settings_are_checked(settings: dict[str, Any], words: str) -> None:
    with pytest.raises(ConfigurationError, match=words):
        OpenAISettings(**settings)


def test_only_what_changes_replies_is_a_parameter() -> None:
    with serving() as (server, _):
        settings = {"temperature": 0.0, "timeout": 3.0, "image_size": 256}
        assert client(server, **settings).parameters == {"temperature": 0.0, "image_size": 256}
        assert client(server).name == "openai:embedded"


def test_large_pictures_are_scaled_down_and_small_ones_left_alone() -> None:
    assert scaled_down(png((40, 20)), 40) == png((40, 20))
    with Image.open(io.BytesIO(scaled_down(png((400, 200)), 100))) as image:
        assert image.size == (100, 50)
    file = io.BytesIO()
    Image.fromarray(np.full((200, 400), 25_000, np.uint16)).save(file, "PNG")
    with Image.open(io.BytesIO(scaled_down(file.getvalue(), 100))) as image:
        assert image.getpixel((50, 25)) == (97, 97, 97)  # 16-bit grey keeps its upper bits
    encoder = PictureEncoder(largest=None, memory=1)
    first, second = Picture(png((30, 30))), Picture(png((50, 50)))
    urls = [encoder.data_url(picture) for picture in (first, second, first)]
    assert urls[0] == urls[2] != urls[1]
    assert urls[0].startswith("data:image/png;base64,")


def test_a_port_in_use() -> None:
    with serving() as (server, _):
        port = int(server.url.split(":")[2].split("/")[0])
        with pytest.raises(ConfigurationError, match=f"port {port}"):
            VlmServer(ScriptedModel(lambda _: ""), ServerSettings(port=port))


def test_fault_plans_are_checked() -> None:
    with pytest.raises(ConfigurationError, match="share from 0 to 1"):
        FaultPlan(1.5)
    with pytest.raises(ConfigurationError, match="at least one kind"):
        FaultPlan(0.5, ())
