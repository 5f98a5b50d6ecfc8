"""From the exceptions of the ``openai`` client to ours. No secret gets into a message."""

from __future__ import annotations

import json
import socket
import ssl
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import openai

from skillwrapper.errors import (
    ConfigurationError,
    ModelNotFoundError,
    ProviderError,
    SkillWrapperError,
    TemporaryProviderError,
)
from skillwrapper.redaction import Redactor
from skillwrapper.vlm.provider_errors import CHECK_ADDRESS, row_of
from skillwrapper.vlm.retry_after import wait_asked_for

_LONGEST_QUOTE = 300
_LONGEST_READ = 20_000
_PAGE_STARTS = ("<!doctype", "<html", "<?xml", "<head", "<body")
_SELF_SIGNED = frozenset({18, 19})
_EXPIRED, _OTHER_NAME = 10, 62


class NobodyAnswersError(TemporaryProviderError):
    """No connection could be made at all; lasting, unless there was one before."""


@dataclass(frozen=True)
class ErrorTranslator:
    """Says in our words what went wrong with a call.

    Attributes:
        model: provider and model, for messages.
        endpoint: address of the endpoint, for messages; without credentials.
        redactor: knows the secrets that must not be repeated.
        proxies: the variables that name proxies on the way.
    """

    model: str
    endpoint: str
    redactor: Redactor = field(default_factory=Redactor)
    proxies: tuple[str, ...] = ()

    def translate(self, error: Exception) -> SkillWrapperError:
        """Our exception for one of the client's."""
        if isinstance(error, openai.APITimeoutError):
            return TemporaryProviderError(f"{self.endpoint} did not answer in time")
        if isinstance(error, openai.APIConnectionError):
            return self._of_connection(error)
        if isinstance(error, openai.APIStatusError):
            return self.refused(error.status_code, error.body, error.response.headers)
        if isinstance(error, UnicodeError):
            return ConfigurationError(
                f"{self.model}: the prompt or a header holds a character that cannot be sent"
            )
        return TemporaryProviderError(
            f"the call to {self.endpoint} failed ({type(error).__name__})"
        )

    def no_completion(self, what: str, *, lasts: bool) -> ProviderError:
        """For a body that is no chat completion: a proxy's page, a cut-off or foreign body.

        Args:
            what: it is instead.
            lasts: whether another attempt would bring the same.
        """
        kind = ModelNotFoundError if lasts else TemporaryProviderError
        return kind(f"{self.endpoint} sent {what}, which is no chat completion; {CHECK_ADDRESS}")

    def refused(self, status: int, body: object, headers: Mapping[str, str]) -> ProviderError:
        """For a call that the provider did not answer.

        Args:
            status: HTTP status.
            body: the body, as JSON data or text.
            headers: of the reply.
        """
        said = _what_is_said(body)[:_LONGEST_READ]
        wait = wait_asked_for(headers, said)
        row = row_of(status, said, wait)
        moved = f"; it has moved to {headers['location']}" if "location" in headers else ""
        quote = self.quote(f"{said or 'no reason given'}{moved}")
        advice = f"; {row.advice}" if row.advice else ""
        made = row.make(f"{self.model}: status {status} from {self.endpoint}: {quote}{advice}")
        if isinstance(made, TemporaryProviderError):
            made.retry_after = wait
        return made

    def quote(self, text: str) -> str:
        """A text without secrets, on one line, not too long."""
        text = " ".join(self.redactor.redact(text[:_LONGEST_READ]).split())
        return text if len(text) <= _LONGEST_QUOTE else text[: _LONGEST_QUOTE - 3] + "..."

    def _of_connection(self, error: openai.APIConnectionError) -> SkillWrapperError:
        causes = tuple(_causes(error))
        for cause in causes:
            if isinstance(cause, ssl.SSLCertVerificationError):
                return ConfigurationError(f"{self.endpoint}: {_about_certificate(cause)}")
            if isinstance(cause, ssl.SSLError):
                return ConfigurationError(
                    f"{self.endpoint} does not speak TLS as expected; if it is a server without "
                    "TLS, write http:// in --base-url"
                )
            if isinstance(cause, socket.gaierror):
                return self._nobody(": there is no such host, or no network", "mend --base-url")
        # By name: the client raises these from one HTTP library or another.
        names = {type(cause).__name__ for cause in causes}
        if "ProxyError" in names:
            return NobodyAnswersError(
                f"the proxy on the way to {self.endpoint} refused; mend or unset HTTPS_PROXY, "
                "HTTP_PROXY and ALL_PROXY"
            )
        if names & {"ConnectError", "UnsupportedProtocol"}:
            return self._nobody("", "start the server, or mend --base-url")
        return TemporaryProviderError(f"the connection to {self.endpoint} broke")

    def _nobody(self, why: str, advice: str) -> NobodyAnswersError:
        if self.proxies:
            advice += f", or the proxy that {' and '.join(self.proxies)} name"
            advice += "s" if len(self.proxies) == 1 else ""
        return NobodyAnswersError(f"nobody answers at {self.endpoint}{why}; {advice}")

    def lasting(self, error: SkillWrapperError) -> SkillWrapperError:
        """The same where there never was a server: waiting for one is of no use."""
        return ModelNotFoundError(str(error)) if isinstance(error, NobodyAnswersError) else error


def _causes(error: BaseException) -> Iterator[BaseException]:
    seen: set[int] = set()
    present: BaseException | None = error
    while present is not None and id(present) not in seen:
        seen.add(id(present))
        yield present
        present = present.__cause__ or present.__context__


def _about_certificate(error: ssl.SSLCertVerificationError) -> str:
    trust = "set SSL_CERT_FILE to a file with a certificate that you trust"
    if error.verify_code in _SELF_SIGNED:
        return f"its certificate is self-signed; {trust}"
    if error.verify_code == _EXPIRED:
        return "its certificate has expired; renew it, or mend the clock of this machine"
    if error.verify_code == _OTHER_NAME:
        return "its certificate is for another host; name the host as the certificate does"
    return f"its certificate cannot be trusted ({error.verify_message}); {trust}"


def _what_is_said(body: object) -> str:
    """The words of an error, with its codes and the parameter that it is about."""
    if isinstance(body, list) and len(body) == 1:
        body = body[0]
    if isinstance(body, Mapping):
        inner = body.get("error")
        if isinstance(inner, (Mapping, str)) and inner:
            body = inner
    if isinstance(body, Mapping):
        names = ("message", "msg", "detail", "error", "code", "type", "param", "status", "metadata")
        said = [_plain(body[name]) for name in names if body.get(name)]
        return ", ".join(dict.fromkeys(said)) or _plain(body)
    text = body if isinstance(body, str) else ("" if body is None else _plain(body))
    return "a web page" if text.lstrip()[:9].lower().startswith(_PAGE_STARTS) else text


def _plain(value: object) -> str:
    if isinstance(value, str):
        return value
    try:
        return json.dumps(value, ensure_ascii=False, default=str)
    except (ValueError, RecursionError):
        return type(value).__name__
