"""AMLGym's domains, traces and test states; the baselines that it carries."""

from __future__ import annotations

import importlib
import json
import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from functools import cache
from importlib import resources
from pathlib import Path

from benchmarks.action_models.metrics import TestState
from skillwrapper.action_models.amlgym import SkillWrapper
from skillwrapper.action_models.strips import read_objects

OURS = "ours"
BASELINES = ("sam", "offlam", "nolam", "rosame")
"""Those of AMLGym; ``sam`` leaves negative preconditions out there."""


def root() -> Path:
    """Where AMLGym keeps its data."""
    try:
        return Path(str(resources.files("amlgym.benchmarks")))
    except ModuleNotFoundError as error:
        raise SystemExit(
            "AMLGym is missing; install it: pip install 'skillwrapper[amlgym]'"
        ) from error


def domain_names() -> tuple[str, ...]:
    """The domains that have traces to learn from."""
    folders = (root() / "trajectories" / "learning").iterdir()
    return tuple(sorted(f.name for f in folders if f.is_dir() and not f.name.startswith("_")))


def domain_path(domain: str) -> Path:
    """The true domain."""
    return root() / "domains" / f"{domain}.pddl"


def trace_paths(domain: str) -> list[Path]:
    """The traces to learn from, in order."""
    found = (root() / "trajectories" / "learning" / domain).glob("*_traj")
    return sorted(found, key=lambda path: int(path.name.split("_")[0]))


def problem_paths(domain: str, kind: str = "solving") -> list[Path]:
    """Problems, in order."""
    found = (root() / "problems" / kind / domain).glob("*.pddl")
    return sorted(found, key=lambda path: int(path.name.split("_")[0]))


def test_states(domain: str) -> Iterator[TestState]:
    """The states in which models are compared."""
    path = root() / "states" / "predictive_power_fast" / domain / "test_states.json"
    for problem, states in json.loads(path.read_text()).items():
        objects = read_objects(root() / "problems" / "predictive_power" / domain / problem)
        for entry in states.values():
            yield TestState(
                frozenset(atom[1:-1] for atom in entry["fluents"]),
                objects,
                {
                    name: frozenset(tuple(arguments) for arguments in found)
                    for name, found in entry["applicable_actions"].items()
                },
            )


@cache
def _algorithm(name: str) -> object:
    if name == OURS:
        return SkillWrapper()
    return importlib.import_module("amlgym.algorithms").get_algorithm(name)


def learn(learner: str, domain: Path, traces: Sequence[Path]) -> str:
    """The domain that a learner makes of traces, as PDDL."""
    algorithm = _algorithm(learner)
    with _scratch(), redirect_stdout(Path(os.devnull).open("w")):
        return str(algorithm.learn(str(domain), [str(path) for path in traces]))  # type: ignore[attr-defined]


@contextmanager
def _scratch() -> Iterator[None]:
    """Some baselines write to the present folder."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(before)
