"""Who is asked: address, key, proxies and certificates of an endpoint, checked.

All that comes from the environment is checked here, before the first call, so that a variable of
somebody else's making is named instead of ending in the HTTP library.
"""

from __future__ import annotations

import ipaddress
import os
import re
import ssl
from collections.abc import Mapping
from dataclasses import dataclass, field
from urllib.parse import SplitResult, unquote, urlsplit

from skillwrapper.errors import AuthenticationError, ConfigurationError, MissingDependencyError
from skillwrapper.redaction import Redactor, redact, safe_address, strip_user_info

KEY_VARIABLE = "OPENAI_API_KEY"
"""The environment variable that holds the key; the key is never taken from anywhere else."""
URL_VARIABLE = "OPENAI_BASE_URL"
OWN_ENDPOINT = "https://api.openai.com/v1"
"""The address that is asked where none is named."""
_OWN_HOST = "api.openai.com"
_NO_KEY = "none-needed"
_PROXY_VARIABLES = ("ALL_PROXY", "HTTPS_PROXY", "HTTP_PROXY")
_PROXY_SCHEMES = frozenset({"http", "https", "socks5", "socks5h"})
_SENT_IN_HEADERS = ("OPENAI_ORG_ID", "OPENAI_PROJECT_ID")


@dataclass(frozen=True)
class Endpoint:
    """Who is asked.

    Attributes:
        url: the address, without credentials.
        key: sent as a bearer token.
        login: user and password of an address that holds them; sent instead of the key.
        is_local: whether it is on this machine; then no proxy is used.
        proxies: the variables that name proxies on the way there.
        redactor: knows everything that must not be written.
    """

    url: str
    key: str = field(repr=False)
    login: tuple[str, str] | None = field(default=None, repr=False)
    is_local: bool = False
    proxies: tuple[str, ...] = ()
    redactor: Redactor = field(default_factory=Redactor)

    @classmethod
    def find(
        cls, model: str, base_url: str | None, environment: Mapping[str, str] | None = None
    ) -> Endpoint:
        """The endpoint of a model.

        Args:
            model: for messages.
            base_url: the address that the user names; None for that of the environment, or
                OpenAI's own.
            environment: the variables; those of this process by default.

        Raises:
            ConfigurationError: if an address, key, proxy or certificate cannot be used.
            AuthenticationError: if a key is needed and there is none.
            MissingDependencyError: if a proxy needs a package that is not installed.
        """
        variables = os.environ if environment is None else environment
        named = endpoint_address(base_url, variables)
        parts = _checked_address(named, "base-url" if base_url else URL_VARIABLE)
        login = (unquote(parts.username or ""), unquote(parts.password or ""))
        is_local = _is_local(parts.hostname or "")
        key = _checked_key(model, variables, needed=parts.hostname == _OWN_HOST)
        proxies = () if is_local else _checked_proxies(variables)
        if parts.scheme == "https" or not is_local:
            _check_certificates(variables)
        _check_headers(variables)
        redactor = Redactor.knowing((key, named), variables)
        told = login if any(login) else None
        return cls(strip_user_info(named), key, told, is_local, proxies, redactor)


def endpoint_address(base_url: str | None, environment: Mapping[str, str] | None = None) -> str:
    """The address that is asked: the user's, that of the environment, or OpenAI's own."""
    variables = os.environ if environment is None else environment
    return base_url or variables.get(URL_VARIABLE, "").strip() or OWN_ENDPOINT


def _checked_address(url: str, source: str) -> SplitResult:
    got = as_shown(safe_address(url))
    shown = f"'{source}': expected an address like http://localhost:8000/v1, got '{got}'"
    if not url.isascii() or re.search(r"[\s\"'<>\\^`{|}]|[\x00-\x1f]", url):
        raise ConfigurationError(f"{shown}; it holds a blank, a quote or another odd character")
    try:
        parts = urlsplit(url)
        port, host = parts.port, parts.hostname
    except ValueError as error:
        raise ConfigurationError(f"{shown}; {as_shown(str(error))}") from None
    if parts.scheme not in {"http", "https"} or not host or port == 0:
        raise ConfigurationError(shown)
    if parts.query or parts.fragment:
        raise ConfigurationError(f"{shown}; leave out what follows '?' or '#', and set the key in "
                                 f"the environment variable {KEY_VARIABLE}")  # fmt: skip
    return parts


def as_shown(text: str) -> str:
    """A text for a message: without secrets, on one line."""
    plain = "".join(sign if sign.isprintable() else " " for sign in redact(text))
    return " ".join(plain.split())


def _is_local(host: str) -> bool:
    if host == "localhost" or host.endswith(".localhost"):
        return True
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return False
    return address.is_loopback or address.is_unspecified


def _checked_key(model: str, variables: Mapping[str, str], *, needed: bool) -> str:
    """The key from the environment; endpoints of one's own usually need none."""
    key = variables.get(KEY_VARIABLE, "").strip()
    if not key:
        if needed:
            raise AuthenticationError(
                f"no key for openai:{model}; set the environment variable {KEY_VARIABLE}, or "
                "name the address of an endpoint that needs none with --base-url"
            )
        return _NO_KEY
    for number, character in enumerate(key, start=1):
        if not (character.isascii() and character.isprintable()) or character in "\"'` ":
            raise ConfigurationError(
                f"{KEY_VARIABLE}: character {number} of {len(key)} is one that no key has "
                f"({_named(character)}); copy the key again, without quotes and blanks"
            )
    return key


def _named(character: str) -> str:
    """A character for a message; never one that a key may have."""
    if character.isspace():
        return "a blank or line end"
    if not character.isprintable():
        return "a control character"
    return f"'{character}'"


def _checked_proxies(variables: Mapping[str, str]) -> tuple[str, ...]:
    """The variables that name a proxy."""
    names = [name for upper in _PROXY_VARIABLES for name in (upper, upper.lower())]
    used = tuple(name for name in names if variables.get(name, "").strip())
    for name in used:
        _check_proxy(name, variables[name].strip())
    return used


def _check_proxy(name: str, value: str) -> None:
    got = as_shown(safe_address(value))
    shown = f"{name}: expected a proxy like http://proxy:3128, got '{got}'"
    unset = f"mend it, or unset {name}"
    try:
        parts = urlsplit(value if "://" in value else f"http://{value}")
        scheme, host = parts.scheme, parts.hostname if parts.port != 0 else None
    except ValueError as error:
        raise ConfigurationError(f"{shown} ({as_shown(str(error))}); {unset}") from None
    if scheme not in _PROXY_SCHEMES or not host or re.search(r"[\s\x00-\x1f\x7f]", value):
        raise ConfigurationError(f"{shown}; {unset}")
    if scheme.startswith("socks"):
        try:
            import socksio  # type: ignore[import-not-found,unused-ignore] # noqa: F401, PLC0415
        except ImportError:
            raise MissingDependencyError(
                f"socksio, which the SOCKS proxy in {name} needs,",
                f"pip install socksio, or {unset}",
            ) from None


def _check_certificates(variables: Mapping[str, str]) -> None:
    for name, exists, what in (
        ("SSL_CERT_FILE", os.path.isfile, "a file with certificates"),
        ("SSL_CERT_DIR", os.path.isdir, "a folder with certificates"),
    ):
        value = variables.get(name, "")
        if value and not exists(value):
            raise ConfigurationError(
                f"{name}: expected {what}, got '{as_shown(value)}', which is none; mend or unset it"
            )
    file = variables.get("SSL_CERT_FILE", "")
    if file and not _holds_certificates(file):
        raise ConfigurationError(
            f"SSL_CERT_FILE: expected a file with certificates, got '{as_shown(file)}', "
            "which holds none; mend or unset it"
        )


def _holds_certificates(file: str) -> bool:
    try:
        ssl.create_default_context(cafile=file)
    except (ssl.SSLError, OSError):
        return False
    return True


def _check_headers(variables: Mapping[str, str]) -> None:
    for name in _SENT_IN_HEADERS:
        value = variables.get(name, "")
        if not (value.isascii() and value.isprintable()):
            raise ConfigurationError(
                f"{name}: it holds a character that cannot be sent; mend or unset it"
            )
