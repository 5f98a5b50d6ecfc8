"""What is said of malformed domain files, recordings, replies of robots, and edited models.

Run: ``python -m benchmarks.malformed [COUNT [SEED]]`` (2,000 and 0 by default; each kind in turn).
The files of a small run in the project of ``skillwrapper new`` are damaged in the ways of
``benchmarks.damage``, and their structure is: values are replaced, keys left out. What is read must
be read well, or end in one sentence that names the file, or the robot and its call; of an import
that fails nothing may be left.
"""

from __future__ import annotations

import json
import random
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from benchmarks.damage import damage
from benchmarks.kills import contents
from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.domains.starting import start_project
from skillwrapper.errors import SkillWrapperError
from skillwrapper.robots.process import ProcessRobot
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn
from skillwrapper.runs.model_import import import_model
from skillwrapper.runs.recordings import import_recording
from skillwrapper.symbols.files import read_model, read_predicates
from skillwrapper.world.robot import RobotEnvironment

_REPLIER = """\
exec 3<"$1"
while read -r call; do IFS= read -r answer <&3 || exit 3; printf '%s\\n' "$answer"; done
"""
"""A robot that answers each call with the next line of a file, and ends after the last."""
_PATIENCE = 5.0
GOOD = ("read well", "one sentence")


@dataclass(frozen=True)
class Outcome:
    """What came of one malformed thing.

    Attributes:
        thing: what it was.
        kind: ``read well``, ``one sentence``, or what is wrong.
        said: the sentence, or the end of the traceback.
    """

    thing: str
    kind: str
    said: str = ""


class Malformed:
    """Things that are read, and copies of them that are damaged.

    Args:
        place: a folder to work in.
    """

    def __init__(self, place: Path) -> None:
        self._place, self._whole = place, place / "whole"
        start_project(self._whole)
        run = place / "run"
        learn({"domain": str(self._whole), "iterations": 2, "exploration.budget": 6}, run)
        self._package = find_domain(str(self._whole))
        self._record(RunArchive.open(run))
        for name in ("model.json", "predicates.yaml", "domain.pddl"):
            shutil.copy(run / "model" / name, self._whole)
        self._run = RunArchive.open(run)
        self._before = contents(run)
        (self._whole / "replier.sh").write_text(_REPLIER)
        self._things: dict[str, Callable[[Path], object]] = {
            "domain.yaml": lambda file: _read_domain(file.parent),
            "log.csv": self._import,
            "log.jsonl": self._import,
            "replies.jsonl": self._listen,
            "model.json": lambda file: read_model(file, self._package.domain),
            "predicates.yaml": lambda file: read_predicates(file, self._package.domain),
            "domain.pddl": lambda file: import_model(self._run, file),
        }

    def try_one(self, seed: int) -> Outcome:
        """Damage a thing and read it; which one, the seed says."""
        chance = random.Random(seed)
        name = list(self._things)[seed % len(self._things)]
        folder = self._place / "copy"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self._whole, folder)
        file = folder / name
        if name.endswith(".yaml") and chance.random() < 0.6:
            _damage_structure(file, chance)
        else:
            damage(file, chance)
        try:
            self._things[name](file)
        except Exception as error:
            return Outcome(name, *self._judge(error, file))
        if name == "domain.pddl":
            self._before = contents(self._run.path)
        return Outcome(name, "read well")

    def _judge(self, error: Exception, file: Path) -> tuple[str, str]:
        said = str(error)
        if not isinstance(error, SkillWrapperError):
            last = traceback.extract_tb(error.__traceback__)[-1]
            where = f"{Path(last.filename).name}:{last.lineno}"
            return "a traceback", f"{type(error).__name__}: {said[:200]} ({where})"
        if "\n" in said:
            return "several lines", said
        if file.name.startswith("replies"):
            named = said.startswith(("robot ", "look(): ", "run(", "scene(): "))
            return ("one sentence" if named else "names no call"), said
        left = (file.parent / "imported").exists() or list(file.parent.glob(".*.tmp"))
        if left or contents(self._run.path) != self._before:
            return "half imported", said
        return ("one sentence" if file.name in said else "names no file"), said

    def _import(self, file: Path) -> object:
        return import_recording(self._package, file, file.parent / "imported")

    def _listen(self, file: Path) -> None:
        command = f"sh {self._whole / 'replier.sh'} {file}"
        robot = ProcessRobot(command, self._package.domain.name, _PATIENCE)
        with closing(RobotEnvironment(robot, self._package.domain)) as environment:
            environment.reset(seed=0)
            for instance in self._package.domain.skill_instances[:2]:
                environment.execute(instance)

    def _record(self, archive: RunArchive) -> None:
        """Write recordings of a run, and what a robot would have answered meanwhile."""
        rows: list[dict[str, str]] = []
        pictures: list[str] = []
        for number, episode in enumerate(archive.episodes(), start=1):
            for done in episode.transitions:
                files = {}
                for when, seen in (("before", done.before), ("after", done.after)):
                    (picture,) = seen.pictures
                    files[when] = f"{picture.sha256}.png"
                    (self._whole / files[when]).write_bytes(picture.png)
                pictures.append(str(self._whole / files["before"]))
                row = {"episode": str(number), "skill": done.instance.skill, **files}
                row |= {"arguments": " ".join(done.instance.arguments)}
                rows.append({**row, "success": str(done.success)})
        look = {"pictures": {"main": pictures[0]}}
        replies: list[dict[str, Any]] = [{"protocol": 1}, {}, look]
        replies += [{"success": True, "message": "done"}, look, {"success": False}, look, {}]
        for name, entries in (("log.jsonl", rows), ("replies.jsonl", replies)):
            text = "".join(json.dumps(entry) + "\n" for entry in entries)
            (self._whole / name).write_text(text)
        lines = [",".join(rows[0]), *(",".join(row.values()) for row in rows)]
        (self._whole / "log.csv").write_text("\n".join(lines) + "\n")


def _read_domain(folder: Path) -> DomainPackage:
    package = find_domain(str(folder))
    package.make_environment().close()
    return package


def _damage_structure(file: Path, chance: random.Random) -> None:
    """Damage what a YAML file holds."""
    as_json = file.with_suffix(".json.tmp.json")
    as_json.write_text(json.dumps(yaml.safe_load(file.read_text())))
    damage(as_json, chance)
    try:
        text = yaml.safe_dump(json.loads(as_json.read_text()), sort_keys=False)
    except (OSError, ValueError):
        text = as_json.read_text(errors="replace") if as_json.exists() else ""
    as_json.unlink(missing_ok=True)
    file.write_text(text)


def outcomes(count: int, first: int = 0) -> Iterator[Outcome]:
    """Read so many malformed things, one after the other."""
    with tempfile.TemporaryDirectory() as place:
        yield from map(Malformed(Path(place)).try_one, range(first, first + count))


def main(count: int = 2000, first: int = 0) -> None:
    """Print how often each outcome came, and what is not as it should be."""
    began, found = time.process_time(), list(outcomes(count, first))
    for (thing, kind), times in sorted(Counter((one.thing, one.kind) for one in found).items()):
        print(f"{times:6} {thing}: {kind}")
    print(f"{len(found)} malformed things, {time.process_time() - began:.0f} CPU s")
    for one in found:
        if one.kind not in GOOD:
            print(f"  {one.thing}: {one.kind}: {one.said}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
