"""The way to an endpoint: a client that ends every call in time, and bounds what comes back."""

from __future__ import annotations

import ssl
import time
import weakref
from collections.abc import Iterator

import httpx2
import openai

from skillwrapper.errors import ConfigurationError
from skillwrapper.vlm.endpoints import Endpoint, as_shown

_LONGEST_CONNECTING = 10.0
_LARGEST_REPLY = 32 * 1024 * 1024


def open_client(endpoint: Endpoint, timeout: float) -> openai.OpenAI:
    """A client that asks once, follows no redirection, and ends every call in time.

    Args:
        endpoint: whom to ask.
        timeout: seconds from the start of a call to the last byte of the reply.

    Raises:
        ConfigurationError: if the HTTP library refuses the address or a proxy.
    """
    guard = _Guard(timeout)
    try:
        http_client = httpx2.Client(
            auth=endpoint.login,
            timeout=httpx2.Timeout(timeout, connect=min(timeout, _LONGEST_CONNECTING)),
            limits=httpx2.Limits(max_connections=1000, max_keepalive_connections=100),
            follow_redirects=False,
            verify=_certificates(endpoint),
            trust_env=not endpoint.is_local,
            event_hooks={"request": [guard.begin], "response": [guard.watch]},
        )
        client = openai.OpenAI(
            api_key=endpoint.key, base_url=endpoint.url, max_retries=0, http_client=http_client
        )
        weakref.finalize(client, http_client.close)
        return client
    except (httpx2.InvalidURL, ImportError, OSError, ValueError) as error:
        said = as_shown(str(error))
        raise ConfigurationError(
            f"{endpoint.url} cannot be asked ({said}); mend --base-url, or the proxies and "
            "certificates that the environment names"
        ) from None


class _Guard:
    """Ends replies that take too long in all, or do not end: single reads never time out then."""

    def __init__(self, timeout: float) -> None:
        self._timeout = timeout

    def begin(self, request: httpx2.Request) -> None:
        request.extensions["deadline"] = time.monotonic() + self._timeout

    def watch(self, response: httpx2.Response) -> None:
        if isinstance(response.stream, httpx2.SyncByteStream):
            deadline = response.request.extensions["deadline"]
            response.stream = _BoundedStream(response.stream, deadline)


class _BoundedStream(httpx2.SyncByteStream):
    def __init__(self, stream: httpx2.SyncByteStream, deadline: float) -> None:
        self._stream, self._deadline = stream, deadline

    def __iter__(self) -> Iterator[bytes]:
        size = 0
        for chunk in self._stream:
            size += len(chunk)
            if time.monotonic() > self._deadline:
                raise httpx2.ReadTimeout("the reply took too long")
            if size > _LARGEST_REPLY:
                raise httpx2.ReadError(f"a reply of more than {_LARGEST_REPLY} bytes")
            yield chunk

    def close(self) -> None:
        self._stream.close()


def _certificates(endpoint: Endpoint) -> ssl.SSLContext | bool:
    """What proves that a server is who it says; of no use without TLS, on this machine."""
    if endpoint.is_local and endpoint.url.startswith("http://"):
        return False
    return httpx2.create_ssl_context()
