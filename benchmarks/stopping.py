"""Stopping every command while it is at work: how long it takes, and what is left.

Run: ``python -m benchmarks.stopping [NAME ...]`` (all by default). Each command gets Ctrl-C in one
trial and SIGTERM in another, a while after it began: among them eight calls that wait for another
attempt, a server that does not answer, a planner whose own child holds its output, workers of an
experiment. It must end within two seconds with exit code 130 or 143 and a sentence on how to go on;
no process that it started, no temporary file and no half-written file may be left. The signal goes
to the process alone, as ``kill`` sends it, not to its group.
"""

from __future__ import annotations

import contextlib
import os
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import RATE_LIMIT, SLOW, FaultPlan
from skillwrapper.files.writing import is_leftover
from skillwrapper.runs.launch import learn
from skillwrapper.runs.models import open_model
from skillwrapper.runs.settings import ModelSettings

WITHIN = 2.0
_PATIENCE = 30.0
_MARK = "SKILLWRAPPER_TRIAL"

_PLANNER = """\
#!/bin/sh
sleep 600 &
sleep 600
"""
"""A planner that hangs, with a child that holds its standard output."""

_ROBOT = """\
import signal, sys, time
signal.signal(signal.SIGTERM, signal.SIG_IGN)
sys.stdin.readline()
print('{}', flush=True)
time.sleep(600)
"""
"""A robot that says hello, then nothing, and does not end when it is told."""

_EXPERIMENT = """\
name: stopping
methods: [ours, expert, vila]
domains: [burger]
seeds: [0, 1]
settings:
  iterations: 5
  model: {{name: {model}{url}, asking: {{parallel: 8, votes: 8}}}}
problems: {{easy: 1, hard: 0, impossible: 0}}
"""


@dataclass(frozen=True)
class Trial:
    """A command that is stopped.

    Attributes:
        name: of the trial.
        line: the command without the program; ``{out}``, ``{url}``, ``{run}``, ``{picture}``,
            ``{robot}``, ``{experiment}`` and ``{slow_experiment}`` are filled in.
        after: seconds until the signal.
        fault: what the server does from the third call on.
        hanging_planner: whether the planner hangs.
    """

    name: str
    line: str
    after: float = 5.0
    fault: str = SLOW
    hanging_planner: bool = False


_SERVED = "--model openai:embedded --base-url {url}"
TRIALS = (
    Trial("learn, computing", "learn burger --out {out} --iterations 20 --budget 60", 6.0),
    Trial(
        "learn, 8 waits for a retry",
        f"learn burger --out {{out}} {_SERVED} --parallel 8 --votes 8",
        fault=RATE_LIMIT,
    ),
    Trial("learn, 8 calls", f"learn burger --out {{out}} {_SERVED} --parallel 8 --votes 8"),
    Trial("learn, 1 call", f"learn burger --out {{out}} {_SERVED}"),
    Trial(
        "learn, a robot that hangs",
        f"learn burger --out {{out}} --robot '{sys.executable} {{robot}}'",
        4.0,
    ),
    Trial("verify, computing", "verify {run}", 3.0),
    Trial("verify, labels of a model", "verify {run} --labels model", 3.0),
    Trial("doctor", f"doctor {_SERVED}", 4.0),
    Trial("doctor, a wait for a retry", f"doctor {_SERVED}", 4.0, fault=RATE_LIMIT),
    Trial("plan", "plan {run} --init {picture} --goal {picture2} --time-limit 60",
          hanging_planner=True),
    Trial("solve", "solve {run} --goal {picture2} --time-limit 60", hanging_planner=True),
    Trial("experiment run", "experiment run {experiment} --out {out}", 8.0),
    Trial("experiment run, 2 workers", "experiment run {experiment} --out {out} --workers 2", 10.0),
    Trial(
        "experiment run, 2 workers, 8 calls each",
        "experiment run {slow_experiment} --out {out} --workers 2",
        12.0,
    ),
    Trial(
        "experiment run, 2 workers, 8 waits for a retry each",
        "experiment run {slow_experiment} --out {out} --workers 2",
        12.0,
        fault=RATE_LIMIT,
    ),
    Trial("experiment run, Ray", "experiment run {experiment} --out {out} --ray local", 15.0),
    Trial("vlm-server", "vlm-server --port 0", 4.0),
    Trial("problems", "problems burger --out {out}.yaml", 1.5),
    Trial("study perception", "study perception burger --model openai:embedded"),
    Trial("study invention", "study invention burger --model openai:embedded"),
)  # fmt: skip


def main(names: tuple[str, ...] = ()) -> None:
    """Print how each trial went."""
    # A shell that began this in the background ignores Ctrl-C, and so would all that we start.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    trials = [trial for trial in TRIALS if not names or trial.name in names]
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "run"
        learn({"domain": "burger", "iterations": 2, "exploration.budget": 10}, run)
        for trial in trials:
            for number in (signal.SIGINT, signal.SIGTERM):
                with tempfile.TemporaryDirectory() as place:
                    said = _try(trial, number, Path(place), run)
                print(f"{trial.name:40} {number.name:8} {said}", flush=True)


def _try(trial: Trial, number: signal.Signals, place: Path, run: Path) -> str:
    plan = FaultPlan(1.0, (trial.fault,), retry_after=60.0, slowness=60.0, after=2)
    mark = uuid.uuid4().hex
    with VlmServer(
        open_model("embedded", ModelSettings(), 0, "burger"), ServerSettings(faults=plan)
    ) as server:
        line = trial.line.format(**_names(place, run, server.url))
        process = _start(
            shlex.split(line), trial, place, {_MARK: mark, "OPENAI_BASE_URL": server.url}
        )
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(trial.after)
            return f"ended by itself with {process.returncode}: {_end(place)}"
        process.send_signal(number)
        began = time.monotonic()
        try:
            process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        seconds = time.monotonic() - began
    wrong = _wrong(process.returncode, number, seconds, place, mark)
    return f"{seconds:5.2f} s  {'; '.join(wrong) or 'good'}"


def _names(place: Path, run: Path, url: str) -> dict[str, object]:
    files = {
        "experiment": ("embedded", ""),
        "slow_experiment": ("openai:embedded", f", base_url: '{url}'"),
    }
    for name, (model, address) in files.items():
        (place / f"{name}.yaml").write_text(_EXPERIMENT.format(model=model, url=address))
    (place / "robot.py").write_text(_ROBOT)
    pictures = sorted((run / "images").iterdir())
    return {
        "out": place / "out",
        "url": url,
        "run": run,
        "picture": pictures[0],
        "picture2": pictures[-1],
        "robot": place / "robot.py",
        **{name: place / f"{name}.yaml" for name in files},
    }


def _start(
    line: list[str], trial: Trial, place: Path, variables: Mapping[str, str]
) -> subprocess.Popen[bytes]:
    (place / "tmp").mkdir()
    kept = {k: v for k, v in os.environ.items() if not k.lower().endswith("_proxy")}
    environment = {**kept, **variables, "TMPDIR": str(place / "tmp"), "RAY_TMPDIR": "/tmp"}
    if trial.hanging_planner:
        program = place / "kstar_planner" / "builds" / "release" / "bin" / "downward"
        program.parent.mkdir(parents=True)
        program.write_text(_PLANNER)
        program.chmod(0o755)
        (place / "kstar_planner" / "__init__.py").touch()
        environment["PYTHONPATH"] = f"{place}:{kept.get('PYTHONPATH', '')}"
    with (place / "said.txt").open("wb") as said:
        return subprocess.Popen(
            [sys.executable, "-m", "skillwrapper", *line],
            stdout=said,
            stderr=said,
            env=environment,
            cwd=place,
        )


def _wrong(
    code: int, number: signal.Signals, seconds: float, place: Path, mark: str
) -> Iterator[str]:
    """What is not as it should be."""
    if seconds > WITHIN:
        yield "too slow"
    if code != 128 + number:
        yield f"exit code {code}"
    said = (place / "said.txt").read_text(errors="replace")
    if "Traceback" in said:
        yield "a traceback"
    if "go on" not in " ".join(said.split()):
        yield f"no word on how to go on: {_end(place)}"
    if any(_processes(mark)):
        yield f"{len(list(_processes(mark)))} processes left"
    left = [path for path in place.rglob("*") if is_leftover(path)]
    left += [path for path in (place / "tmp").rglob("*") if path.is_file()]
    if left:
        yield f"left: {left[0].relative_to(place)}"


def _processes(mark: str) -> Iterator[int]:
    """The processes whose environment has a mark."""
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError):
            state = (
                (entry / "stat").read_text().rpartition(")")[2].split()[0]
                if entry.name.isdigit()
                else "Z"
            )
            if state != "Z" and f"{_MARK}={mark}".encode() in (entry / "environ").read_bytes():
                yield int(entry.name)


def _end(place: Path) -> str:
    return " ".join((place / "said.txt").read_text(errors="replace").split())[-200:]


if __name__ == "__main__":
    main(tuple(sys.argv[1:]))
