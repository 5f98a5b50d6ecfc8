"""Secrets planted wherever one can come in are in no file, message or picture that is written."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from base64 import b64encode
from pathlib import Path

import pytest
from seen_kitchen import embedded_model

from skillwrapper.embedded import server_faults as faults
from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FaultPlan
from skillwrapper.redaction import MARK, Redactor, redact

KEY = "planted-key-4711"  # has no known form: only knowing it helps
PASSWORD = "planted-pass-0815"
PROXY = "planted-proxy-2342"
TOKEN = "planted-token-1701"
LOGIN = b64encode(f"robin:{PASSWORD}".encode()).decode()
SECRETS = (KEY, PASSWORD, PROXY, TOKEN, LOGIN)


def run(where: Path, *line: str) -> str:
    """All that a command says; logs of the client as loud as they go."""
    kept = {k: v for k, v in os.environ.items() if not k.lower().endswith("_proxy")}
    environment = {
        **kept,
        "OPENAI_API_KEY": KEY,
        "HF_TOKEN": TOKEN,
        "HTTPS_PROXY": f"http://robin:{PROXY}@127.0.0.1:1",
        "OPENAI_LOG": "debug",
        "HOME": str(where),
    }
    done = subprocess.run(
        [sys.executable, "-m", "skillwrapper", *line],
        capture_output=True,
        text=True,
        check=False,
        env=environment,
        cwd=where,
        timeout=120,
    )
    assert "Traceback" not in done.stderr
    return done.stdout + done.stderr


def assert_clean(said: str, folder: Path) -> None:
    written = b"".join(path.read_bytes() for path in folder.rglob("*") if path.is_file())
    for secret in SECRETS:
        assert secret not in said
        assert secret.encode() not in written


def serving(*kinds: str, after: int = 0) -> VlmServer:
    plan = FaultPlan(1.0 if kinds else 0.0, kinds or faults.PASSING, after=after)
    return VlmServer(embedded_model(), ServerSettings(faults=plan))


def with_login(url: str) -> str:
    return url.replace("http://", f"http://robin:{PASSWORD}@")


@pytest.mark.parametrize("login", [False, True])
def test_a_run_against_a_server_that_repeats_the_key(login: bool, tmp_path: Path) -> None:
    with serving(faults.KEY_IN_REPLY) as server:
        url = with_login(server.url) if login else server.url
        size = ("--seed", "1", "--iterations", "1", "--budget", "6", "--model", "openai:embedded")
        said = run(tmp_path, "learn", "burger", "--out", "run", *size, "--base-url", url)
        said += run(tmp_path, "calls", "run", "--full", "--last", "0")
        said += run(tmp_path, "show", "run", "--json") + run(tmp_path, "report", "run")
    assert MARK in said  # the key came back, and was taken out
    assert "Authorization" in said
    assert (tmp_path / "run" / "config.yaml").exists()
    assert_clean(said, tmp_path)


@pytest.mark.parametrize(
    "kind", [faults.KEY_IN_ERROR, faults.KEY_IN_REPLY, "wrong-key", faults.CUT, "web-page"]
)
def test_a_doctor_at_a_server_that_repeats_the_key(kind: str, tmp_path: Path) -> None:
    with serving(kind) as server:
        line = ("doctor", "--model", "openai:embedded", "--json", "--base-url")
        said = run(tmp_path, *line, with_login(server.url)) + run(tmp_path, *line, server.url)
    assert_clean(said, tmp_path)


@pytest.mark.parametrize(
    "url",
    [
        f"http://robin:{PASSWORD}@127.0.0.1:9/v1",
        f"https://robin:{PASSWORD}@models.example.invalid/v1",
        f"http://robin:{PASSWORD}@127.0.0.1:9o/v1",
        f"robin:{PASSWORD}@127.0.0.1:9/v1",
        f"http://127.0.0.1:9/v1?api_key={TOKEN}",
    ],
)
def test_addresses_with_secrets(url: str, tmp_path: Path) -> None:
    line = ("--model", "openai:m", "--base-url", url)
    said = run(tmp_path, "doctor", *line)
    said += run(tmp_path, "learn", "burger", "--out", "run", *line)
    assert_clean(said, tmp_path)


FORMS = [
    "sk-abcdefghijklmnop",
    "sk-proj-ab***********yz12",
    "sk-ant-api03-abc_def-123456",
    "sk-or-v1-0123456789abcdef",
    "AIzaSyA0123456789abcdefghij",
    "gsk_0123456789abcdef",
    "hf_abcdefGHIJ0123456789",
    "xai-0123456789abcdef",
    "nvapi-0123456789-abcdef",
    "ghp_0123456789abcdefABCDEF",
    "AKIA0123456789ABCDEF",
    "xoxb-123456789012-abc",
    "eyJhbGciOiJIUzI1NiJ9.eyJzdWIiOiIxIn0.c2lnbmF0dXJl",
]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    "around",
    [
        "{}",
        "key {}.",
        "'Authorization': 'Bearer {}'",
        "http://u:{}@h/v1",
        "?key={}&b=1",
        "x-api-key: {}",
    ],
)
def test_forms_of_secrets(form: str, around: str) -> None:
    assert form not in redact(around.format(form))
    assert "***" not in redact(around.format(form))


def test_secrets_are_found_in_every_form_in_which_they_come_back() -> None:
    redactor = Redactor.knowing(
        (), {"HTTPS_PROXY": "http://robin:p%40ss wörd@h:1", "MY_KEY": 'a"b\\cdef'}
    )
    for form in ("p@ss wörd", "p%40ss%20w%C3%B6rd", json.dumps('a"b\\cdef'), "a%22b%5Ccdef"):
        assert redactor.redact(f"say {form}!") in {f"say {MARK}!", f'say "{MARK}"!'}
    assert "ss w" not in repr(redactor)


@pytest.mark.parametrize(
    "text",
    [
        "holding(robot, patty): true",
        "The token lies on the board; no key is needed.",
        "Basic skills: Pick(robot, lettuce), Place(robot, lettuce, board)",
        "See https://example.org/a@b and task-holding or disk-123456789",
        "key: the robot holds the bread",
        "authentication of the bearer",
    ],
)
def test_what_models_write_is_left_alone(text: str) -> None:
    redactor = Redactor.knowing(("ollama", "EMPTY"), {"API_KEY": "none", "SSH_TOKEN": "x"})
    assert redactor.redact(text) == text
