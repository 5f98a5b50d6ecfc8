"""What commands make of runs and experiments of which a file is damaged.

Run: ``python -m benchmarks.damaged_runs [COUNT [SEED]]`` (2,000 and 0 by default). Each time one
file of a finished run in the greenhouse of ``examples/``, or of an experiment there, is damaged in
one of the ways of ``benchmarks.damage``, and one command reads it: it must end well or with one
sentence that names the file. ``learn`` must, where it ends well, have mended the folder; left out
of that are ``calls.sqlite``, as a reply that reads otherwise is one, and what lines of the log tell
of events that happened. ``experiment run`` does not look into cells that are finished.
"""

from __future__ import annotations

import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from typer.testing import CliRunner

from benchmarks.damage import damage
from benchmarks.kills import GREENHOUSE, compare_in_greenhouse, contents, learn_greenhouse
from skillwrapper.cli.main import app
from skillwrapper.errors import SkillWrapperError

READERS = {
    "run": (
        "show {0}", "show {0} --json", "show {0} --pddl", "calls {0}", "calls {0} --full --json",
        "report {0} --out {1}/page.html", "verify {0}", "verify {0} --curve --json",
        "plan {0} --init {2} --goal {2} --time-limit 2", "solve {0} --goal {2} --time-limit 2",
        "learn {3} --out {0} --iterations 2 --budget 8",
        "learn {3} --out {1}/replay --iterations 2 --budget 8 --model recorded:{0}",
    ),
    "experiment": (
        "experiment table {0}", "experiment table {0} --format json", "experiment plot {0}",
        "report {0} --out {1}/page.html", "experiment run {4} --out {0}",
    ),
}  # fmt: skip
"""Commands, by what they read: {0} is its folder, {1} a free one, {2} a picture of a run."""
_LONGEST = 60


@dataclass(frozen=True)
class Outcome:
    """What came of one damaged file.

    Attributes:
        command: that read it, without its folders.
        file: which one, within the folder.
        kind: ``ended well``, ``mended``, ``a sentence``, or what is wrong.
        said: the sentence, or the end of the traceback.
    """

    command: str
    file: str
    kind: str
    said: str = ""


GOOD = ("ended well", "mended", "one sentence with file and line", "one sentence with the file")


class Damaged:
    """A finished run and a finished experiment, of which copies are damaged.

    Args:
        place: a folder to work in.
    """

    def __init__(self, place: Path) -> None:
        self._place = place
        self._originals = {"run": place / "whole-run", "experiment": place / "whole-experiment"}
        self._experiment_file = place / "kills.yaml"
        learn_greenhouse(self._originals["run"])
        compare_in_greenhouse(self._originals["experiment"])
        self._picture = min(self._originals["run"].glob("images/*.png"))
        self._whole = {kind: contents(path) for kind, path in self._originals.items()}
        self._experiment_file.write_text(_EXPERIMENT)

    def try_one(self, seed: int) -> Outcome:
        """Damage a file and let a command read it; both are chosen by a seed."""
        chance = random.Random(seed)
        kind = chance.choices(("run", "experiment"), (4, 1))[0]
        command = chance.choice(READERS[kind])
        folder = self._place / "copy"
        for left in (folder, self._place / "free"):
            shutil.rmtree(left, ignore_errors=True)
        shutil.copytree(self._originals[kind], folder)
        (self._place / "free").mkdir()
        file = _choose(folder, chance)
        damage(file, chance)
        names = (folder, self._place / "free", self._picture, GREENHOUSE, self._experiment_file)
        name = str(file.relative_to(folder))
        said = _run([part.format(*names) for part in command.split()])
        if said is not None:
            return Outcome(command, name, *_judge(said, file))
        if not command.startswith("learn") or "replay" in command:
            return Outcome(command, name, "ended well")
        other = _difference(self._whole[kind], contents(folder))
        is_mended = not other or name.endswith((".sqlite", "events.jsonl"))
        return Outcome(command, name, "mended" if is_mended else "not mended", other)


def _choose(folder: Path, chance: random.Random) -> Path:
    """A file; all folders are equally likely."""
    folders = sorted({file.parent for file in folder.rglob("*") if file.is_file()})
    return chance.choice(sorted(f for f in chance.choice(folders).iterdir() if f.is_file()))


def _run(line: list[str]) -> BaseException | None:
    """What a command ended with; None if it ended well."""

    def stop(number: int, frame: object) -> None:
        raise TimeoutError(f"longer than {_LONGEST} s")

    signal.signal(signal.SIGALRM, stop)
    signal.alarm(_LONGEST)
    try:
        done = CliRunner().invoke(app, line)
    finally:
        signal.alarm(0)
    if done.exit_code and isinstance(done.exception, SystemExit):
        return SkillWrapperError(done.output.strip().splitlines()[-1] if done.output else "")
    return done.exception if done.exit_code else None


def _judge(error: BaseException, file: Path) -> tuple[str, str]:
    said = str(error)
    if not isinstance(error, SkillWrapperError):
        frames = traceback.extract_tb(error.__traceback__)
        where = f"{Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else ""
        return "a traceback", f"{type(error).__name__}: {said[:200]} ({where})"
    if "\n" in said:
        return "several lines", said
    if file.name not in said and "iteration" not in said:
        return "a sentence without the file", said
    with_line = f"{file.name}:" in said
    return f"one sentence with {'file and line' if with_line else 'the file'}", said


def _difference(whole: dict[str, bytes], found: dict[str, bytes]) -> str:
    names = sorted({*whole, *found})
    return next((name for name in names if whole.get(name) != found.get(name)), "")


_EXPERIMENT = f"""\
name: kills
methods: [ours, vila]
domains: [{GREENHOUSE}]
settings: {{iterations: 1, exploration: {{budget: 6}}}}
problems: {{easy: 1, hard: 0, impossible: 1}}
"""


def outcomes(count: int, first: int = 0) -> Iterator[Outcome]:
    """Damage so many files, one after the other."""
    with tempfile.TemporaryDirectory() as place:
        damaged = Damaged(Path(place))
        yield from map(damaged.try_one, range(first, first + count))


def main(count: int = 2000, first: int = 0) -> None:
    """Print how often each outcome came, and what is not as it should be."""
    began, found = time.monotonic(), list(outcomes(count, first))
    for kind, times in Counter(one.kind for one in found).most_common():
        print(f"{times:6} {kind}")
    print(f"{len(found)} damaged files, {time.monotonic() - began:.0f} s")
    for one in found:
        if one.kind not in GOOD:
            print(f"  {one.file}, {one.command.split(' --')[0]}: {one.kind}: {one.said}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
