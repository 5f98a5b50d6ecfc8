"""Serves a review on 127.0.0.1, to whoever has the address with its token."""

from __future__ import annotations

import hmac
import secrets
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import TracebackType
from typing import Any, Self
from urllib.parse import parse_qsl, urlencode, urlsplit

from skillwrapper.errors import ConfigurationError, SkillWrapperError
from skillwrapper.review.session import Review

_LONGEST_FORM = 64 * 2**10
_HTML, _PNG = "text/html; charset=utf-8", "image/png"
_HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; img-src 'self' data:; "
    "style-src 'unsafe-inline'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class ReviewServer:
    """Serves a review. Use it as a context manager, or let it ``serve``.

    Args:
        review: of a run.
        port: on 127.0.0.1; 0 for any that is free.

    Raises:
        ConfigurationError: if the port cannot be used.
    """

    def __init__(self, review: Review, port: int = 0) -> None:
        self._server = _open(review, port)
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)

    @property
    def url(self) -> str:
        """The address to open, with its token."""
        return f"{self._server.origin}/?{urlencode({'token': self._server.token})}"

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()

    def serve(self) -> None:
        """Serve until interrupted."""
        try:
            self._server.serve_forever()
        finally:
            self._server.server_close()


class _HttpServer(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, address: tuple[str, int], review: Review) -> None:
        super().__init__(address, _Handler)
        self.review, self.token = review, secrets.token_urlsafe(24)
        self.one_at_a_time = threading.Lock()

    @property
    def origin(self) -> str:
        return f"http://127.0.0.1:{self.server_address[1]}"


class _Handler(BaseHTTPRequestHandler):
    server: _HttpServer
    timeout = 30.0

    def do_GET(self) -> None:
        path, asked = self._asked()
        if not self._may(asked):
            self._refuse()
        elif path == "/":
            self._send(200, _HTML, self._page(asked).encode())
        elif path.startswith("/picture/"):
            png = self.server.review.picture(path.removeprefix("/picture/").removesuffix(".png"))
            self._send(200 if png else 404, _PNG, png or b"")
        else:
            self._send(404, "text/plain", b"there is no such page")

    def do_POST(self) -> None:
        path, asked = self._asked()
        form = self._form()
        if not self._may(asked):
            self._refuse()
        elif path != "/correct" or form is None:
            self._send(404, "text/plain", b"there is no such form")
        else:
            self._correct(asked, form)

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing is logged: addresses carry the token."""

    def _correct(self, asked: dict[str, str], form: dict[str, str]) -> None:
        try:
            with self.server.one_at_a_time:
                self.server.review.correct(form)
        except SkillWrapperError as error:
            self._send(422, _HTML, self._page(asked, str(error)).encode())
            return
        query = urlencode({"token": self.server.token, "page": asked.get("page", "1")})
        self._send(303, "text/plain", b"", {"Location": f"/?{query}#{form.get('at', '')[:80]}"})

    def _page(self, asked: dict[str, str], problem: str = "") -> str:
        page = asked.get("page", "1")
        number = int(page) if page.isascii() and page.isdigit() else 1
        return self.server.review.page(number, token=self.server.token, problem=problem)

    def _asked(self) -> tuple[str, dict[str, str]]:
        parts = urlsplit(self.path)
        return parts.path, dict(parse_qsl(parts.query))

    def _form(self) -> dict[str, str] | None:
        length = self.headers.get("Content-Length") or ""
        if not (length.isascii() and length.isdigit()) or int(length) > _LONGEST_FORM:
            return None
        return dict(parse_qsl(self.rfile.read(int(length)).decode("utf-8", "replace")))

    def _may(self, asked: dict[str, str]) -> bool:
        """Whether the caller has the token, and meant this machine (no other name for it)."""
        host = self.headers.get("Host", "")
        given = asked.get("token", "").encode("utf-8", "replace")
        return f"http://{host}" == self.server.origin and hmac.compare_digest(
            given, self.server.token.encode()
        )

    def _refuse(self) -> None:
        self._send(403, "text/plain", b"open the address that skillwrapper review has printed")

    def _send(
        self, status: int, kind: str, body: bytes, headers: dict[str, str] | None = None
    ) -> None:
        self.send_response(status)
        for name, value in {**_HEADERS, **(headers or {})}.items():
            self.send_header(name, "".join(c for c in value if c.isprintable()))
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)


def _open(review: Review, port: int) -> _HttpServer:
    try:
        return _HttpServer(("127.0.0.1", port), review)
    except (OSError, OverflowError) as error:
        raise ConfigurationError(
            f"port {port} on 127.0.0.1 cannot be used ({error}); choose another with --port"
        ) from error
