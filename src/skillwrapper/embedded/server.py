"""A chat-completions server in front of the embedded model, for tests and for trying things."""

from __future__ import annotations

import hashlib
import json
import socket
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import TracebackType
from typing import Any, Self

from skillwrapper.embedded import server_faults as faults
from skillwrapper.embedded.canned_errors import (
    CANNED_ERRORS,
    Call,
    CannedError,
    echoed_key,
    rate_limit,
)
from skillwrapper.embedded.chat_protocol import (
    BadChatRequestError,
    completion,
    error_body,
    in_events,
    in_parts,
    in_reasoning,
    in_tool_call,
    read_request,
    refusal,
    without_choice,
)
from skillwrapper.embedded.server_faults import FaultChooser, FaultPlan
from skillwrapper.embedded.spoilt_replies import FINISH_REASONS, spoilt
from skillwrapper.errors import ConfigurationError
from skillwrapper.vlm.protocol import ModelRequest, VisionLanguageModel

SEEING, BLIND = "embedded", "embedded-blind"
"""The models that the server has: the embedded model, and one that accepts no pictures."""
_DRIPS, _DRIP_EVERY = 10_000, 0.05


@dataclass(frozen=True)
class ServerSettings:
    """How the server behaves.

    Attributes:
        port: on 127.0.0.1; 0 for any that is free.
        latency: seconds that every call takes at least.
        faults: what goes wrong and how often.
        key: the key that calls must carry; empty for none.
    """

    port: int = 0
    latency: float = 0.0
    faults: FaultPlan = field(default_factory=FaultPlan)
    key: str = field(default="", repr=False)


class VlmServer:
    """Serves a model on 127.0.0.1, path ``/v1``. Use it as a context manager.

    Args:
        model: what answers, e.g. the embedded model.
        settings: how the server behaves.

    Raises:
        ConfigurationError: if the port cannot be used.
    """

    def __init__(self, model: VisionLanguageModel, settings: ServerSettings | None = None) -> None:
        self._settings = settings or ServerSettings()
        self._server = _open(_Service(model, self._settings), self._settings.port)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    @property
    def url(self) -> str:
        """The address to give as ``--base-url``."""
        return f"http://127.0.0.1:{self._server.server_address[1]}/v1"

    @property
    def calls(self) -> int:
        """How many completions were asked for, failed ones included."""
        return self._server.service.calls

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._server.service.closed = True
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()

    def serve(self) -> None:
        """Serve until interrupted; for use without the context manager."""
        try:
            self._server.serve_forever()
        finally:
            self._server.server_close()


@dataclass(frozen=True)
class _Answer:
    """Status, body (JSON data, or text that is none) and headers; some are sent in part."""

    status: int
    body: object
    headers: Mapping[str, str] = field(default_factory=dict)
    content_type: str = "application/json"
    share: float = 1.0
    drips: bool = False

    @classmethod
    def of_error(cls, error: CannedError) -> _Answer:
        return cls(error.status, error.body, error.headers, error.content_type)


class _Service:
    """Prepares answers; knows nothing of HTTP but status numbers."""

    def __init__(self, model: VisionLanguageModel, settings: ServerSettings) -> None:
        self._model, self._settings = model, settings
        self._chooser = FaultChooser(settings.faults)
        self._lock = threading.Lock()
        self.calls = 0
        self.closed = False

    def models(self) -> _Answer:
        entries = [{"id": name, "object": "model", "owned_by": "skillwrapper"}
                   for name in (SEEING, BLIND)]  # fmt: skip
        return _Answer(200, {"object": "list", "data": entries})

    def complete(self, body: bytes, authorization: str) -> _Answer | None:
        """The answer to a call; None if the connection is to be cut."""
        if self.closed:  # connections that are kept open outlive the server
            return None
        if self._settings.key and authorization != f"Bearer {self._settings.key}":
            return _Answer(401, error_body("Incorrect API key provided", "invalid_request_error"))
        try:
            name, request = read_request(body)
        except BadChatRequestError as error:
            return _Answer(400, error_body(str(error), "invalid_request_error"))
        unable = _unable(name, request)
        if unable is not None:
            return unable
        with self._lock:
            self.calls += 1
            fault = self._chooser.choose(hashlib.sha256(body).hexdigest())
        time.sleep(self._settings.latency)
        if fault == faults.CUT:
            return None
        call = Call(json.loads(body), authorization)
        return self._error(call, fault) or self._answer(name, request, fault, call)

    def _error(self, call: Call, fault: str | None) -> _Answer | None:
        """The answer of a fault that keeps the model from being asked."""
        error = CANNED_ERRORS.get(fault or "")
        if error is not None:
            return _Answer.of_error(error) if error.when(call) else None
        if fault in {faults.RATE_LIMIT, faults.RATE_LIMIT_DATE}:
            as_date = fault == faults.RATE_LIMIT_DATE
            return _Answer.of_error(rate_limit(self._settings.faults.retry_after, as_date=as_date))
        if fault == faults.KEY_IN_ERROR:
            return _Answer.of_error(echoed_key(call))
        if fault == faults.SERVER_ERROR:
            return _Answer(500, error_body("The server had an error", "server_error"))
        return None

    def _answer(self, name: str, request: ModelRequest, fault: str | None, call: Call) -> _Answer:
        """The model's answer, in the form that a fault gives it."""
        if fault == faults.SLOW:
            time.sleep(self._settings.faults.slowness)
        reply = spoilt(self._model.complete(request), fault, call.authorization)
        bodies = {
            faults.REFUSAL: lambda: refusal(name, reply),
            faults.EMPTY: lambda: without_choice(name, reply),
            faults.CONTENT_PARTS: lambda: in_parts(name, reply),
            faults.REASONING_FIELD: lambda: in_reasoning(name, reply),
            faults.TOOL_CALL: lambda: in_tool_call(name, reply),
        }
        if fault in {faults.STREAMED, faults.STREAM_CUT}:
            share = 0.5 if fault == faults.STREAM_CUT else 1.0
            return _Answer(200, in_events(name, reply), share=share)
        if fault in bodies:
            return _Answer(200, bodies[fault]())
        body = completion(name, reply, FINISH_REASONS.get(fault or "", "stop"))
        share = 0.5 if fault == faults.TRUNCATED else 1.0
        return _Answer(200, body, share=share, drips=fault == faults.DRIP)


def _unable(name: str, request: ModelRequest) -> _Answer | None:
    """The answer for a model that there is not, or that cannot do what is asked."""
    if name not in {SEEING, BLIND}:
        message = f"The model '{name}' does not exist; there are {SEEING} and {BLIND}"
        return _Answer(404, error_body(message, "invalid_request_error", "model_not_found"))
    if name == BLIND and request.pictures:
        message = "This model does not accept image input"
        return _Answer(400, error_body(message, "invalid_request_error"))
    return None


class _HttpServer(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 128

    def __init__(self, address: tuple[str, int], service: _Service) -> None:
        self.service = service
        super().__init__(address, _Handler)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A client that hangs up is no error of ours."""


class _Handler(BaseHTTPRequestHandler):
    server: _HttpServer
    protocol_version = "HTTP/1.1"
    wbufsize = -1  # send an answer in one piece
    disable_nagle_algorithm = True

    def do_GET(self) -> None:
        if self.path.rstrip("/").endswith("/v1/models"):
            self._send(self.server.service.models())
        else:
            self._send(_not_found(self.path))

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
        if self.path.rstrip("/") != "/v1/chat/completions":
            self._send(_not_found(self.path))
            return
        authorization = self.headers.get("Authorization") or ""
        answer = self.server.service.complete(body, authorization)
        if answer is None:
            self._hang_up()
        else:
            self._send(answer)

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing is logged: requests may carry keys."""

    def _send(self, answer: _Answer) -> None:
        text = answer.body if isinstance(answer.body, str) else json.dumps(answer.body)
        data = text.encode()
        data = data[: int(len(data) * answer.share)]
        self.send_response(answer.status)
        self.send_header("Content-Type", answer.content_type)
        self.send_header("Content-Length", str(len(data) + _DRIPS * answer.drips))
        for name, value in answer.headers.items():
            self.send_header(name, value)
        self.end_headers()
        if answer.drips:
            self._drip()
        self.wfile.write(data)
        self.wfile.flush()

    def _drip(self) -> None:
        """Blanks before the answer, as some servers send to keep a connection open."""
        for _ in range(_DRIPS):
            if self.server.service.closed:
                break
            self.wfile.write(b" ")
            self.wfile.flush()
            time.sleep(_DRIP_EVERY)

    def _hang_up(self) -> None:
        self.close_connection = True
        self.connection.shutdown(socket.SHUT_RDWR)


def _not_found(path: str) -> _Answer:
    return _Answer(404, error_body(f"Unknown path {path}", "invalid_request_error"))


def _open(service: _Service, port: int) -> _HttpServer:
    try:
        return _HttpServer(("127.0.0.1", port), service)
    except (OSError, OverflowError) as error:
        raise ConfigurationError(
            f"port {port} on 127.0.0.1 cannot be used ({error}); choose another with --port"
        ) from error
