"""Secrets planted wherever one can come in are in no file, message or picture that is written."""

from __future__ import annotations

import json
import os
import shutil
import sys
from base64 import b64encode
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

import pytest
from command_line import commands_apart
from seen_kitchen import embedded_model

from skillwrapper.embedded import server_faults as faults
from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FaultPlan
from skillwrapper.redaction import MARK, Redactor, redact

CUPS = Path(__file__).parents[1] / "support" / "cup_world"
KEY = "planted-key-4711"  # has no known form: only knowing it helps
PASSWORD = "planted-pass-0815"
PROXY = "planted-proxy-2342"
TOKEN = "planted-token-1701"
LOGIN = b64encode(f"robin:{PASSWORD}".encode()).decode()
SECRETS = (KEY, PASSWORD, PROXY, TOKEN, LOGIN)


def run(where: Path, *lines: Sequence[str]) -> str:
    """All that commands say, in one process; logs of the client as loud as they go."""
    kept = {k: v for k, v in os.environ.items() if not k.lower().endswith("_proxy")}
    environment = {
        **kept,
        "OPENAI_API_KEY": KEY,
        "HF_TOKEN": TOKEN,
        "HTTPS_PROXY": f"http://robin:{PROXY}@127.0.0.1:1",
        "OPENAI_LOG": "debug",
        "HOME": str(where),
    }
    return commands_apart(lines, environment, where)


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


def test_a_run_against_a_server_that_repeats_the_key(tmp_path: Path) -> None:
    with serving(faults.KEY_IN_REPLY) as server:
        for name, url in (("run", with_login(server.url)), ("other", server.url)):
            size = ("--seed", "1", "--iterations", "1", "--budget", "4")
            served = ("--model", "openai:embedded", "--base-url", url)
            said = run(
                tmp_path,
                ("learn", "burger", "--out", name, *size, *served),
                ("calls", name, "--full", "--last", "0"),
                ("show", name, "--json"),
                ("report", name),
            )
            assert MARK in said  # the key came back, and was taken out
            assert "Authorization" in said
            assert (tmp_path / name / "config.yaml").exists()
            assert_clean(said, tmp_path)


def test_a_doctor_at_a_server_that_repeats_the_key(tmp_path: Path) -> None:
    kinds = (faults.KEY_IN_ERROR, faults.KEY_IN_REPLY, "wrong-key", faults.CUT, "web-page")
    with ExitStack() as stack:
        urls = [stack.enter_context(serving(kind)).url for kind in kinds]
        both = [url for plain in urls for url in (with_login(plain), plain)]
        line = ("doctor", "--model", "openai:embedded", "--json", "--base-url")
        said = run(tmp_path, *((*line, url) for url in both))
    assert said.count('"healthy"') == len(both)
    assert_clean(said, tmp_path)


ADDRESSES = (
    f"http://robin:{PASSWORD}@127.0.0.1:9/v1",
    f"https://robin:{PASSWORD}@models.example.invalid/v1",
    f"http://robin:{PASSWORD}@127.0.0.1:9o/v1",
    f"robin:{PASSWORD}@127.0.0.1:9/v1",
    f"http://127.0.0.1:9/v1?api_key={TOKEN}",
)


def test_addresses_with_secrets(tmp_path: Path) -> None:
    places = [("--model", "openai:m", "--base-url", url) for url in ADDRESSES]
    lines = [("doctor", *place) for place in places]
    lines += [("learn", "burger", "--out", "run", *place) for place in places]
    assert_clean(run(tmp_path, *lines), tmp_path)


LEAKY = """
    def obstacle(self, state, instance):
        if pathlib.Path("broken").exists():
            raise ValueError(dict(os.environ))
        if pathlib.Path("jammed").exists():
            return f"jammed: {dict(os.environ)}"
"""
"""A robot that tells its environment when it fails."""


def test_a_robot_that_tells_its_environment(tmp_path: Path) -> None:
    shutil.copytree(CUPS, tmp_path / "cups", ignore=shutil.ignore_patterns("__pycache__"))
    robot = tmp_path / "cups" / "robot.py"
    text = robot.read_text().replace("\n    def obstacle(self, state, instance):\n", LEAKY)
    text = text.replace('"nothing to do"', 'f"nothing to do: {dict(os.environ)}"')
    robot.write_text(f"import os\nimport pathlib\n\n{text}")
    wanted = ("--goal", "top=full.png", "--scene", "desk")
    said = run(
        tmp_path,
        ("learn", "cups", "--out", "run", "--iterations", "3", "--budget", "8"),
        ("render", "cups", "--scene", "desk", "--do", "Fill(hand, mug)", "--out", "full.png"),
    )
    assert "nothing to do" in "".join(
        path.read_text() for path in (tmp_path / "run" / "episodes").iterdir()
    )
    for state in ("jammed", "broken"):
        (tmp_path / state).touch()
        said += run(
            tmp_path,
            ("execute", "run", "--yes", "--replan", *wanted),
            ("solve", "run", *wanted),
            ("learn", "cups", "--out", f"{state}-run", "--iterations", "1", "--budget", "4"),
            ("check", "cups", "--steps", "3"),
            ("report", "run"),
        )
    assert "jammed" in said
    assert MARK in said
    assert_clean(said, tmp_path)


ON_THE_LINE = "planted-line-6174"
"""Stands on a command line only: nobody knows that it is a secret, but for its option."""
STARTED = """\
import os
import sys

print("started", sys.argv, dict(os.environ), file=sys.stderr, flush=True)
if "ends" in sys.argv:
    sys.exit(3)
if "shouts" in sys.argv:
    print(dict(os.environ), flush=True)
sys.argv[1:] = ["serve-robot", "cups"]
from skillwrapper.cli.main import run
run()
"""


def test_a_robot_process_that_repeats_all_that_it_was_given(tmp_path: Path) -> None:
    shutil.copytree(CUPS, tmp_path / "cups", ignore=shutil.ignore_patterns("__pycache__"))
    robot = tmp_path / "cups" / "robot.py"
    text = robot.read_text().replace('"nothing to do"', 'f"nothing to do: {dict(os.environ)}"')
    robot.write_text(f"import os\n{text}")
    (tmp_path / "start.py").write_text(STARTED)
    line = f"{sys.executable} start.py --token {ON_THE_LINE} --api-key={KEY}"
    learn = ("learn", "cups", "--iterations", "1", "--budget", "4")
    said = run(
        tmp_path,
        (*learn, "--out", "run", "--robot", line),
        (*learn, "--out", "ended", "--robot", f"{line} ends"),
        (*learn, "--out", "shouted", "--robot", f"{line} shouts"),
        (*learn, "--out", "absent", "--robot", f"no-such-robot --password {ON_THE_LINE}"),
        ("report", "run"),
    )
    assert "started" in said
    assert "ended with exit code 3" in said
    assert "other things go to standard error" in " ".join(said.split())
    assert ON_THE_LINE not in said
    assert_clean(said, tmp_path)


def test_values_of_a_domain(tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere" / "cups"
    shutil.copytree(CUPS, folder, ignore=shutil.ignore_patterns("__pycache__"))
    text = (folder / "domain.yaml").read_text()
    planted = f"{KEY} Bearer {TOKEN} token={TOKEN} http://robin:{PASSWORD}@host"
    for old in ("A hand", "Cups", "something to drink", "a red cup", "The hand fills", "the cup"):
        assert old in text
        text = text.replace(old, f"{old} ({planted})")
    (folder / "domain.yaml").write_text(text)
    domain = "elsewhere/cups"
    said = run(
        tmp_path,
        ("domain", domain),
        ("domain", domain, "--json"),
        ("learn", domain, "--out", "run", "--iterations", "1", "--budget", "4"),
        ("learn", domain, "--out", "run", "--iterations", "2", "--budget", "4"),
        ("learn", domain, "--out", "set", "--set", f"predicates=['full(?cup): {planted}']"),
        ("show", "run"),
        ("calls", "run", "--full", "--last", "0"),
        ("report", "run"),
        ("problems", domain, "--out", "problems.yaml"),
    )
    (folder / "domain.yaml").write_text(f"{text}\nrobt: [1, 2, 3, 4, 5, 6, '{KEY}', '{TOKEN}']\n")
    said += run(tmp_path, ("domain", domain))
    (folder / "domain.yaml").write_text(
        text.replace("name: cups", f"name: [1, '{'x' * 30} {KEY}']")
    )
    said += run(tmp_path, ("domain", domain))
    assert MARK in said
    shutil.rmtree(folder)
    assert MARK in (tmp_path / "run" / "domain.yaml").read_text()
    assert_clean(said, tmp_path)


def test_recordings_and_their_paths(tmp_path: Path) -> None:
    shutil.copytree(CUPS, tmp_path / "cups", ignore=shutil.ignore_patterns("__pycache__"))
    columns = "episode,skill,arguments,success,before,after"
    recordings = {
        "column": f"{columns},{KEY}\n1,Fill,hand mug,true,a.png,b.png,x\n",
        "path": f"{columns}\n1,Fill,hand mug,true,http://robin:{PASSWORD}@h/a.png,b.png\n",
        "query": f"{columns}\n1,Fill,hand mug,true,a.png?token={TOKEN},b.png\n",
        "skill": f"{columns}\n1,{KEY},hand mug,true,a.png,b.png\n",
        "argument": f"{columns}\n1,Fill,hand {TOKEN},true,a.png,b.png\n",
        "truth": f"{columns}\n1,Fill,hand mug,{'x' * 40}{KEY},a.png,b.png\n",
    }
    lines = []
    for name, text in recordings.items():
        (tmp_path / "cups" / f"{name}.csv").write_text(text)
        lines.append(("import", "cups", f"cups/{name}.csv", "--out", f"{name}-run"))
    said = run(tmp_path, *lines)
    shutil.rmtree(tmp_path / "cups")
    assert said.count("error:") == len(lines)
    assert_clean(said, tmp_path)


ROS = """
import os
from skillwrapper.robots.rosbridge_robot import RosbridgeRobot, RosService

def robot():
    skill = RosService(os.environ["WAY"], "x/srv/X", lambda hand, cup: {"lamp": cup})
    return RosbridgeRobot.connect(
        {"Fill": skill, "Empty": skill},
        {"top": "/camera"},
        host=os.environ["ADDRESS"],
        port=None,
        connecting=2.0,
    )
"""


def test_a_robot_behind_rosbridge(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("roslibpy", reason="the extra ros is not installed")
    from rosbridge import LampServer  # noqa: PLC0415

    shutil.copytree(CUPS, tmp_path / "cups", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "cups" / "robot.py").write_text(ROS)
    domain = tmp_path / "cups" / "domain.yaml"
    domain.write_text(domain.read_text().replace("robot.py:CupWorld", "robot.py:robot"))
    learn = ("learn", "cups", "--iterations", "1", "--budget", "3", "--set", "scenes=[desk]")
    said = ""
    with LampServer(secret=f" {KEY} http://robin:{PASSWORD}@h/?token={TOKEN}") as server:
        ways = {"broken": server.port, "put_out": server.port, "nowhere": 1}
        for way, port in ways.items():
            monkeypatch.setenv("WAY", f"/{way}")
            monkeypatch.setenv("ADDRESS", f"ws://robin:{PASSWORD}@127.0.0.1:{port}/?token={TOKEN}")
            said += run(tmp_path, (*learn, "--out", way))
    assert "no such service" in said
    assert "expected a connection" in said
    assert "dark" in (tmp_path / "put_out" / "episodes" / "001.jsonl").read_text()
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
        "pictures/http:/u:{}@h/a.png",
        "robot --token {} -v",
        "robot --api-key={}",
        "['robot', '--password', '{}']",
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
        "a low-key place; - key: none; one--token board; --keep closed",
        "see:/kitchen/a@b",
    ],
)
def test_what_models_write_is_left_alone(text: str) -> None:
    redactor = Redactor.knowing(("ollama", "EMPTY"), {"API_KEY": "none", "SSH_TOKEN": "x"})
    assert redactor.redact(text) == text
