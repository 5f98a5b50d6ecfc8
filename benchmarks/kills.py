"""Killing a command at every change that it makes to its files, and going on.

Run: ``python -m benchmarks.kills [EVERY [COMMAND]]`` (every change of both commands by default; 10
takes every tenth).

``learn`` and ``experiment run`` work on the greenhouse of ``examples/``. A first, whole run counts
the changes: files opened for writing, synced, renamed and removed, folders made, model calls kept.
Then, for each change, a new process is killed (SIGKILL) right before it; before a sync also with
half of the file written. The same command goes on in what is left, and must end with the same
files, byte for byte, except for times; nothing temporary may be left.
"""

from __future__ import annotations

import itertools
import json
import os
import re
import shutil
import signal
import sqlite3
import stat
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment, ProblemChoice
from skillwrapper.evaluation.benchmark.running import OwnProcess, run_experiment
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.files.writing import is_leftover
from skillwrapper.runs.launch import learn

GREENHOUSE = Path(__file__).parents[1] / "examples" / "greenhouse"

Command = Callable[[Path], object]
"""Works in a folder, which it makes."""

_TIMES = re.compile(rb'"(?:time|seconds|[a-z_]*_seconds)": ?-?[\d.e+-]+')
_CODE = re.compile(rb"^ *(?:commit|changed): .*$", re.MULTILINE)
_OFTEN = frozenset({"runs.jsonl"})
"""Tell of every command, so also of the one that went on."""


@dataclass
class Killer:
    """Counts the changes that this process makes below a folder, and kills it at one of them.

    Attributes:
        folder: what is changed elsewhere does not count.
        at: number of the change, from 1; 0 for never.
        torn: whether to lose half of what was written to a file that is about to be synced.
        kinds: of the changes that were made, in order.
    """

    folder: Path
    at: int = 0
    torn: bool = False
    kinds: list[str] = field(default_factory=list)

    def watch(self) -> None:
        """Begin; there is no end, so this is for processes that end themselves."""
        sys.addaudithook(self._hear)
        sync, connect = os.fsync, sqlite3.connect

        def noted_sync(handle: int) -> None:
            if stat.S_ISREG(os.fstat(handle).st_mode):
                self._note("sync", os.readlink(f"/proc/self/fd/{handle}"), handle)
            sync(handle)

        def noted_connect(path: str, **options: Any) -> sqlite3.Connection:
            connection = connect(path, **options)
            connection.set_trace_callback(self._hear_statement)
            return connection

        os.fsync, sqlite3.connect = noted_sync, noted_connect  # type: ignore[assignment]

    def _hear(self, event: str, args: tuple[object, ...]) -> None:
        if event == "open":
            path, _, flags = args
            if isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR):
                self._note("open", path)
        elif event == "os.mkdir" and not Path(str(args[0])).exists():
            self._note("mkdir", args[0])
        elif event in {"os.rename", "os.remove", "os.rmdir", "os.truncate"}:
            self._note(event.removeprefix("os."), args[0])

    def _hear_statement(self, statement: str) -> None:
        if statement.startswith("COMMIT"):
            self._note("commit", self.folder / "store")

    def _note(self, kind: str, path: object, handle: int | None = None) -> None:
        if not f"{path}/".startswith(f"{self.folder}/"):
            return
        self.kinds.append(kind)
        if len(self.kinds) != self.at:
            return
        if self.torn and handle is not None:
            os.ftruncate(handle, _middle_of_last_write(Path(str(path))))
        os.kill(os.getpid(), signal.SIGKILL)


def _middle_of_last_write(path: Path) -> int:
    """Where a file ends of whose last line, or of which as a whole, half was written."""
    data = path.read_bytes()
    start = data[:-1].rfind(b"\n") + 1 if path.suffix == ".jsonl" else 0
    return (start + len(data)) // 2


def in_a_process(work: Callable[[], object]) -> tuple[int, bytes]:
    """Do something in a copy of this process; returns how it ended, and what it returned as JSON.

    A copy, because everything is imported and computed there already.
    """
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        code = 1
        try:
            os.write(writing, json.dumps(work()).encode())
            code = 0
        except Exception:
            traceback.print_exc()
        finally:
            os._exit(code)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        said = pipe.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), said


def contents(folder: Path) -> dict[str, bytes]:
    """All files of a folder without times; of a call store its calls."""
    files = (path for path in sorted(folder.rglob("*")) if path.is_file())
    return {
        str(path.relative_to(folder)): _content(path)
        for path in files
        if path.name not in _OFTEN and not path.name.endswith(("-wal", "-shm"))
    }


def _content(path: Path) -> bytes:
    if path.suffix != ".sqlite":
        return _CODE.sub(b"", _TIMES.sub(b"", path.read_bytes()))
    connection = sqlite3.connect(path)
    try:
        kept = "key, status, role, iteration, system, prompt, pictures, reply, input_tokens"
        return repr(
            connection.execute(f"SELECT {kept} FROM calls ORDER BY number").fetchall()
        ).encode()
    finally:
        connection.close()


@dataclass(frozen=True)
class Outcome:
    """What came of killing a command once.

    Attributes:
        at: number of the change before which it was killed.
        torn: whether half of a file was lost.
        wrong: what was not as it should be; empty if all was.
    """

    at: int
    torn: bool
    wrong: str


@dataclass(frozen=True)
class Sweep:
    """Kills of one command.

    Attributes:
        command: what is killed.
        changes: that a whole run makes, by their kinds, in order.
        whole: what it leaves.
    """

    command: Command
    changes: tuple[str, ...]
    whole: dict[str, bytes]

    @classmethod
    def of(cls, command: Command, folder: Path) -> Sweep:
        """Run a command once to its end."""

        def count() -> list[str]:
            killer = Killer(folder)
            killer.watch()
            command(folder)
            return killer.kinds

        code, said = in_a_process(count)
        if code:
            raise RuntimeError(f"expected the command to end well, got exit code {code}")
        return cls(command, tuple(json.loads(said)), contents(folder))

    def kills(self, place: Path, every: int = 1) -> Iterator[Outcome]:
        """Kill it before every so-many-th change, in folders below a place."""
        for at, kind in list(enumerate(self.changes, start=1))[::every]:
            yield self._kill(place / "run", at, torn=False)
            if kind == "sync":
                yield self._kill(place / "run", at, torn=True)

    def _kill(self, folder: Path, at: int, *, torn: bool) -> Outcome:
        shutil.rmtree(folder, ignore_errors=True)
        killer = Killer(folder, at, torn)

        def work() -> None:
            killer.watch()
            self.command(folder)

        code, _ = in_a_process(work)
        if code != -signal.SIGKILL:
            return Outcome(at, torn, f"ended with {code} before change {at}")
        code, _ = in_a_process(partial(_silently, self.command, folder))
        if code:
            return Outcome(at, torn, f"going on ended with {code}")
        return Outcome(at, torn, self._difference(folder))

    def _difference(self, folder: Path) -> str:
        leftovers = [path for path in folder.rglob("*") if is_leftover(path)]
        if leftovers:
            return f"left: {leftovers[0].name}"
        found = contents(folder)
        names = itertools.chain(self.whole, found)
        other = [name for name in names if self.whole.get(name) != found.get(name)]
        return f"other content: {other[0]}" if other else ""


def _silently(command: Command, folder: Path) -> None:
    command(folder)


def learn_in(domain: str, iterations: int, budget: int, folder: Path) -> None:
    """``learn`` for so long."""
    learn({"domain": domain, "iterations": iterations, "exploration.budget": budget}, folder)


def learn_greenhouse(folder: Path) -> None:
    """``learn`` in two scenes."""
    learn_in(str(GREENHOUSE), 2, 8, folder)


def compare_in_greenhouse(folder: Path) -> None:
    """``experiment run`` with all methods that differ in what they write."""
    experiment = Experiment(
        name="kills",
        methods=("ours", "vila"),
        domains=(str(GREENHOUSE),),
        seeds=(0,),
        settings=ExperimentSettings(iterations=1, exploration=ExplorationSettings(budget=6)),
        problems=ProblemChoice(easy=1, hard=0, impossible=1),
    )
    made = ExperimentFolder.create_or_resume(folder, experiment)
    with made.reserved():
        made.note_run("kills")
        failed = [o.error for o in run_experiment(made, OwnProcess(folder)) if o.error]
    if failed:
        raise RuntimeError(failed[0])


COMMANDS = {"learn": learn_greenhouse, "experiment": compare_in_greenhouse}


def main(every: int = 1, *names: str) -> None:
    """Print what is changed, what was killed, and what came of it."""
    for name in names or COMMANDS:
        command = COMMANDS[name]
        began = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            command(Path(folder) / "first")  # what is computed once is then there for all
            sweep = Sweep.of(command, Path(folder) / "whole")
            counted = ", ".join(f"{n} {kind}" for kind, n in Counter(sweep.changes).most_common())
            print(f"{name}: {len(sweep.changes)} changes: {counted}", flush=True)
            outcomes = list(sweep.kills(Path(folder), every))
        wrong = [outcome for outcome in outcomes if outcome.wrong]
        torn = sum(outcome.torn for outcome in outcomes)
        print(
            f"  {len(outcomes)} kills, {torn} of them with half a file: {len(wrong)} not as it "
            f"should be, {time.monotonic() - began:.0f} s"
        )
        for outcome in wrong[:20]:
            print(f"  at change {outcome.at}{' (torn)' * outcome.torn}: {outcome.wrong}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:2]), *sys.argv[2:])
