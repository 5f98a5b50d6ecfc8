"""Secrets are kept out of everything that is written: files, messages, logs.

Two nets: secrets that are known, because the process was given them (``Redactor``), and text that
has the form of one, whoever's it is (``redact``). All patterns take time linear in the text.
"""

from __future__ import annotations

import base64
import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated
from urllib.parse import quote, unquote, urlsplit

from pydantic import PlainSerializer

MARK = "[key]"
"""What stands where a secret stood."""
_SHORTEST = 6
"""Shorter values are replaced nowhere: they would be found in ordinary words."""
_NO_SECRETS = frozenset({"dummy", "empty", "local", "none", "none-needed", "not-needed", "ollama"})
"""What people set where a key is wanted and none is needed."""

_USER_INFO = re.compile(
    r"(?<![\w+.-])([A-Za-z][A-Za-z0-9+.-]{0,30}:/(?:/|(?=[^\s/?#\"'<>:]{1,200}:)))"
    r"[^\s/?#\"'<>]{1,1000}@"  # of two slashes paths lose one
)
_QUERY = re.compile(
    r"([?&](?:access[_-]?token|api[_-]?key|auth|key|password|secret|sig|signature|token)=)"
    r"[^&#\s\"'<>]+",
    re.IGNORECASE,
)
_AFTER_A_NAME = re.compile(
    r"""((?<![A-Za-z/])(?:(?:proxy-)?authorization|x-(?:goog-)?api-key|api[_-]?key|apikey|passw(?:or)?d
    |client[_-]?secret|(?:access|auth|api|refresh|session)[_-]?token)["']?\s{0,3}[:=]\s{0,3}["']?)
    (?:(?:bearer|basic|token|digest|negotiate)\s{1,3})?[^\s"',;&{}<>]{4,}""",
    re.IGNORECASE | re.VERBOSE,
)
_AFTER_AN_OPTION = re.compile(
    r"((?<![\w-])--?(?:[a-z]{1,20}-){0,3}(?:key|token|passw(?:or)?d|secret|credentials?)"
    r"[\"']?(?:=|,?\s{1,3})[\"']?)(?![-\"'\s])[^\s\"'<>]{4,}",
    re.IGNORECASE,
)
_AFTER_A_SCHEME = re.compile(
    r"\b([Bb]earer\s{1,3}|[Bb]asic\s{1,3}(?=[A-Za-z+/]{0,200}[\d=]))[A-Za-z0-9._~+/*=-]{8,}"
)
_FORMS = re.compile(
    r"""(?<![A-Za-z0-9])(?:
      (?:sk|pk|rk)(?:-|_(?:live|test)_)[\w*.-]{6,}  # OpenAI, Anthropic, OpenRouter, Stripe, ...
    | AIza[\w-]{10,} | ya29\.[\w.-]{10,}       # Google
    | (?:gsk|hf|r8|fw|tgp|csk|glpat|nvapi|xai|pplx|github_pat|ghp|gho|ghs|npm|pypi|dapi|voy)
      [-_](?=[A-Za-z_-]{0,200}[\d*])[\w*-]{10,}   # Groq, Hugging Face, Replicate, NVIDIA, xAI, ...
    | xox[abeoprs]-[\w-]{10,}                  # Slack
    | A(?:KI|SI)A[A-Z0-9]{12,}                 # AWS
    | eyJ[\w-]{8,}\.[\w-]{4,}(?:\.[\w-]*)?     # JSON web tokens
    )""",
    re.VERBOSE,
)
_PRIVATE_KEY = re.compile(r"(-----BEGIN [A-Z ]{0,40}PRIVATE KEY-----)[^-]*")
_SECRET_NAME = re.compile(
    r"(?:^|_)(?:API_?KEY|KEY|TOKEN|SECRET|PASSWORD|PASSWD|PASS|CREDENTIALS?|PAT)(?:_\d+)?$",
    re.IGNORECASE,
)
_PROXY_NAME = re.compile(r"(?:^|_)(?:PROXY|URL|URI|DSN|ENDPOINT)$", re.IGNORECASE)


def redact(text: str) -> str:
    """The text with a mark in the place of everything that has the form of a secret.

    Credentials in front of a URL's host are left out without a mark.
    """
    text = strip_user_info(text)
    text = _QUERY.sub(rf"\g<1>{MARK}", text)
    text = _AFTER_A_NAME.sub(rf"\g<1>{MARK}", text)
    text = _AFTER_AN_OPTION.sub(rf"\g<1>{MARK}", text)
    text = _AFTER_A_SCHEME.sub(rf"\g<1>{MARK}", text)
    text = _PRIVATE_KEY.sub(rf"\g<1>{MARK}", text)
    return _FORMS.sub(MARK, text)


def without_secrets(text: str) -> str:
    """The text without what this process was given as secrets, and what has the form of one.

    For what robots, people and libraries say: they may know the environment, too.
    """
    return _knowing_all(tuple(os.environ.items())).redact(text) if text else text


def strip_user_info(text: str) -> str:
    """A URL, or a text with URLs, without the credentials in front of the hosts."""
    return _USER_INFO.sub(r"\1", text) if ":/" in text else text


def safe_address(address: str) -> str:
    """An address as a user gave it, perhaps without a scheme, without all that may be secret."""
    scheme, separator, rest = address.rpartition("://")
    host, slash, path = rest.partition("/")
    return redact(f"{scheme}{separator}{host.rpartition('@')[2]}{slash}{path}")


SafeUrl = Annotated[str, PlainSerializer(safe_address)]
"""The type of an address in settings: whole in memory, without credentials wherever it goes."""


@dataclass(frozen=True)
class Redactor:
    """Takes known secrets out of text, and all that has the form of one.

    Attributes:
        secrets: the values, longest first; in no representation of this object.
    """

    secrets: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"Redactor({len(self.secrets)} secrets)"

    @classmethod
    def knowing(cls, values: Iterable[str], environment: Mapping[str, str]) -> Redactor:
        """One that knows some values, and those in an environment that are secrets by their name.

        Args:
            values: keys, and URLs that may hold credentials.
            environment: the variables of the process.
        """
        named = [value for name, value in environment.items() if _SECRET_NAME.search(name)]
        addresses = [value for name, value in environment.items() if _PROXY_NAME.search(name)]
        found = {form for value in (*values, *named) for form in _forms(value.strip())}
        found |= {form for address in addresses for form in _forms_of_login(address.strip())}
        return cls(tuple(sorted(filter(_is_secret, found), key=lambda form: (-len(form), form))))

    def redact(self, text: str) -> str:
        """The text without secrets."""
        for secret in self.secrets:
            if secret in text:
                text = text.replace(secret, MARK)
        return redact(text)


@lru_cache(maxsize=1)
def _knowing_all(variables: tuple[tuple[str, str], ...]) -> Redactor:
    return Redactor.knowing((), dict(variables))


def _forms(value: str) -> Iterator[str]:
    """The forms in which a secret may come back: as it is, in a URL, in JSON, as basic login."""
    if "://" in value:
        yield from _forms_of_login(value)
    else:
        yield from (value, quote(value, safe=""), json.dumps(value)[1:-1])


def _forms_of_login(address: str) -> Iterator[str]:
    """The same for the credentials in an address."""
    try:
        parts = urlsplit(address if "://" in address else f"http://{address}")
        user, password = parts.username or "", parts.password or ""
    except ValueError:
        return
    if password:
        plain = unquote(password)
        yield from (password, plain, quote(plain, safe=""), json.dumps(plain)[1:-1])
        login = f"{unquote(user)}:{plain}"
        yield from (login, base64.b64encode(login.encode()).decode("ascii"))
    elif user:
        yield user


def _is_secret(form: str) -> bool:
    return len(form) >= _SHORTEST and form.lower() not in _NO_SECRETS
