"""AMLGym's domains, traces and test states; the baselines that it carries."""

from __future__ import annotations

import importlib
import json
import logging
import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from functools import cache, partial
from importlib import resources
from pathlib import Path
from typing import Any

from benchmarks.action_models.metrics import TestState
from skillwrapper.action_models.amlgym import SkillWrapper
from skillwrapper.action_models.strips import read_objects

OURS = "ours"
POSITIVE_SAM = "sam-nonneg"
"""SAM that learns no negative preconditions, which loses fewer states and is as sound here."""

BASELINES = ("sam", POSITIVE_SAM, "offlam", "nolam", "rosame")
"""The learners that AMLGym carries."""


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
def _algorithm(name: str) -> Any:
    if name == OURS:
        return SkillWrapper()
    logging.disable(logging.WARNING)
    algorithms = importlib.import_module("amlgym.algorithms")
    if name == POSITIVE_SAM:
        policy = importlib.import_module("utilities").NegativePreconditionPolicy.hard
        module = importlib.import_module("amlgym.algorithms.SAM")
        return _Patched(algorithms.get_algorithm("sam"), module, "SAMLearner", policy)
    return algorithms.get_algorithm(name)


@dataclass(frozen=True)
class _Patched:
    """SAM with the policy on negative preconditions that AMLGym's adapter does not pass on."""

    algorithm: Any
    module: Any
    name: str
    policy: Any

    def learn(self, *arguments: object) -> str:
        plain = getattr(self.module, self.name)
        patched = partial(plain, negative_preconditions_policy=self.policy)
        setattr(self.module, self.name, patched)
        try:
            return str(self.algorithm.learn(*arguments))
        finally:
            setattr(self.module, self.name, plain)


def load(learner: str) -> None:
    """Have a learner ready, so that what it imports counts for no domain."""
    _algorithm(learner)


def learn(learner: str, domain: Path, traces: Sequence[Path]) -> str:
    """The domain that a learner makes of traces, as PDDL."""
    algorithm = _algorithm(learner)
    with _scratch(), Path(os.devnull).open("w") as nowhere, redirect_stdout(nowhere):
        return str(algorithm.learn(str(domain), [str(path) for path in traces]))


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
