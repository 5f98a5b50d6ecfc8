"""A robot in another process that does not do its part is named, with the call, and ended."""

from __future__ import annotations

import io
import json
import shlex
import sys
import time

import pytest
from lamp_environment import LampEnvironment

from skillwrapper.errors import ConfigurationError, RobotError
from skillwrapper.robots.process import ProcessRobot
from skillwrapper.robots.serving import serve

HELLO = "import sys, time\nsys.stdin.readline()\nprint('{}', flush=True)\n"
NEXT = "sys.stdin.readline()\n"


def robot(code: str, limit: float = 5.0) -> ProcessRobot:
    return ProcessRobot(f"{sys.executable} -c {shlex.quote(code)}", "lamps", limit)


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("print('Starting up', flush=True)", "got 'Starting up'; other things go to"),
        ("print('[1, 2]', flush=True)", "expected one JSON object in a line, got '[1, 2]'"),
        ('print(\'{"success": "yes"}\', flush=True)', "'success': expected true or false"),
        ("print('{}', flush=True)", "expected 'success', got none"),
        ("print('{\"sucess\": true}', flush=True)", "did you mean 'success'?"),
        ('print(\'{"error": "arm is hot"}\', flush=True)', "arm is hot"),
        ('print(\'{"error": ""}\', flush=True)', "no reason"),
        ("sys.exit(3)", "ended with exit code 3"),
        ("import os; os.kill(os.getpid(), 9)", "killed by signal 9"),
        ("import os; os.write(1, b'\\xff\\xfe\\n')", "expected one JSON object"),
        ("print('[' * 100000, flush=True)", "expected one JSON object"),
    ],
)
def test_wrong_answers_are_named_with_the_call(code: str, said: str) -> None:
    wrong = robot(f"{HELLO}{NEXT}{code}\n{NEXT}")
    with pytest.raises(RobotError) as caught:
        wrong.run("Press", "lamp")
    assert said in str(caught.value)
    assert "run Press(lamp): " in str(caught.value)
    assert "\n" not in str(caught.value)
    wrong._process.close()


def test_a_robot_that_hangs_is_ended_in_time() -> None:
    hanging = robot(f"{HELLO}{NEXT}time.sleep(60)", limit=0.3)
    began = time.monotonic()
    with pytest.raises(RobotError, match=r"within 0.3 s, got none"):
        hanging.run("Press", "lamp")
    assert time.monotonic() - began < 10
    with pytest.raises(RobotError, match="killed by signal 9"):
        hanging.look()
    hanging._process.close()


@pytest.mark.parametrize("deaf", ["", "import signal; signal.signal(15, signal.SIG_IGN)\n"])
def test_a_robot_that_hangs_is_ended_soon_where_we_are_stopped(deaf: str) -> None:
    """Ctrl-C once waited three seconds for it, and three more."""
    hanging = robot(f"{deaf}{HELLO}time.sleep(60)")
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt), hanging:
        raise KeyboardInterrupt
    assert time.monotonic() - began < 2.5
    assert hanging._process._process.returncode is not None


@pytest.mark.parametrize(
    ("command", "said"),
    [("", "got nothing"), ("no-such-robot", "cannot be started"), ("'a", "No closing quotation")],
)
def test_what_is_no_command_is_said(command: str, said: str) -> None:
    with pytest.raises(ConfigurationError, match=said):
        ProcessRobot(command, "lamps")


def test_another_protocol_is_refused() -> None:
    with pytest.raises(RobotError, match="expected protocol 1, got 2"):
        robot(f"import sys\n{NEXT}print('{{\"protocol\": 2}}', flush=True)")


def test_a_server_answers_nonsense_with_an_error() -> None:
    answers = io.StringIO()
    serve(LampEnvironment(), ["nonsense\n", "[]\n", '{"call": "dance"}\n'], answers)
    assert all("expected" in json.loads(line)["error"] for line in answers.getvalue().splitlines())
    assert len(answers.getvalue().splitlines()) == 3
