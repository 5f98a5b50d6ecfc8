"""Ctrl-C, SIGTERM and limits end commands within two seconds, whatever they wait for."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from multiprocessing.process import BaseProcess
from pathlib import Path

import pytest
from command_line import begun
from seen_kitchen import embedded_model

from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FaultPlan

WITHIN = 12.0
"""Seconds; two are promised, on a machine with nothing else to do. What waits takes a minute."""


@pytest.fixture(autouse=True)
def _no_proxies(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in os.environ if name.lower().endswith("_proxy")]:
        monkeypatch.delenv(name)


def start(folder: Path, server: VlmServer, *more: str) -> BaseProcess:
    """Learning in ``run``, of which all that it says goes into ``said``."""
    line = ["learn", "burger", "--out", str(folder / "run"), "--model", "openai:embedded"]
    line += ["--base-url", server.url, "--parallel", "8", "--votes", "8", *more]
    return begun(line, folder / "said")


def waiting(server: VlmServer) -> None:
    """Until eight calls are in flight, or wait for a retry."""
    latest = time.monotonic() + 20
    while server.calls < 2 + 8 and time.monotonic() < latest:
        time.sleep(0.05)
    time.sleep(0.3)


def ended(process: BaseProcess, within: float = WITHIN) -> int | None:
    """The exit code; that of being killed if it takes too long."""
    process.join(within)
    process.kill()
    process.join()
    return process.exitcode


def busy_for(seconds: float, kind: str) -> VlmServer:
    """A server that answers a few calls, then lets all others wait."""
    plan = FaultPlan(1.0, (kind,), retry_after=seconds, slowness=seconds, after=2)
    return VlmServer(embedded_model(0), ServerSettings(faults=plan))


@pytest.mark.parametrize(
    ("number", "code", "kind"),
    [(signal.SIGINT, 130, "rate-limit"), (signal.SIGTERM, 143, "slow")],
)
def test_signals(number: signal.Signals, code: int, kind: str, tmp_path: Path) -> None:
    with busy_for(60, kind) as server:
        process = start(tmp_path, server)
        waiting(server)
        os.kill(process.pid or 0, number)
        assert ended(process) == code
    said = (tmp_path / "said").read_text()
    assert "run the same command again to go on" in " ".join(said.split())
    assert "Traceback" not in said
    assert not [p for p in (tmp_path / "run").rglob("*") if "tmp" in p.suffix]


def test_a_signal_while_everything_is_still_being_loaded(tmp_path: Path) -> None:
    """The first second of a command once ended in a traceback."""
    code = "import sys, skillwrapper.__main__ as m; print(flush=True); sys.argv[1:] = ['--help']; "
    process = subprocess.Popen(
        [sys.executable, "-c", code + "m.main()"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=WITHIN)
    assert (process.returncode, "Traceback" in said) == (130, False)


EXECUTED = """\
from skillwrapper.cli.stopping import stoppable
text = "import os, signal, time; os.kill(os.getpid(), signal.SIGTERM); time.sleep(9)"
stoppable(lambda: exec(text))
"""


def test_a_signal_while_text_is_executed(tmp_path: Path) -> None:
    """While dataclasses were made, SIGTERM once ended ``python -m`` as if by Ctrl-C."""
    (tmp_path / "executing.py").write_text(EXECUTED)
    command = [sys.executable, "-m", "executing"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert (done.returncode, "to go on" in done.stderr) == (143, True)


@pytest.mark.parametrize("kind", ["rate-limit", "slow"])
def test_a_limit_on_time(kind: str, tmp_path: Path) -> None:
    with busy_for(60, kind) as server:
        process = start(tmp_path, server, "--max-seconds", "4")
        waiting(server)
        assert ended(process, 4 + WITHIN) == 3
    assert "limit reached: 4 seconds" in (tmp_path / "said").read_text()
