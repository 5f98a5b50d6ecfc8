"""How often a domain is learned exactly, from an empty vocabulary, by how many executions.

Exact is a model with precision, effect accuracy and every skill's recall 1 over all states of all
scenes, by labels without error. Run: ``python -m benchmarks.exactness [DOMAIN] [--seeds A-B]
[--at 75 150] [--set NAME=VALUE ...]``.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Sequence
from dataclasses import dataclass

from benchmarks.worlds.measure import least_recall, settings_of
from skillwrapper.domains.discovery import find_domain
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.exact.exact_states import scene_states
from skillwrapper.evaluation.exact.labelled_states import TRUTH_LAYOUT, LabelledStates
from skillwrapper.evaluation.exact.state_readers import PictureReader
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.runs.events import IterationFinished, RunEvent
from skillwrapper.runs.launch import learn
from skillwrapper.runs.models import open_model
from skillwrapper.runs.results import LearningResult
from skillwrapper.vlm.limits import CallBudget, LimitedModel


@dataclass(frozen=True)
class Stage:
    """What was learned from so many executions.

    Attributes:
        executions: so many.
        calls: of the model, so far.
        result: of all iterations so far.
        found: the truth about the model.
    """

    executions: int
    calls: int
    result: LearningResult
    found: Verification

    @property
    def least(self) -> float:
        """The least recall of a skill."""
        return least_recall(self.found)

    @property
    def is_exact(self) -> bool:
        """Whether the model is right everywhere, for every skill."""
        found = self.found
        return found.precision == found.effect_accuracy == self.least == 1

    def __str__(self) -> str:
        figures = self.result.figures
        return (
            f"{self.executions:4d}: {'exact' if self.is_exact else '-----'} "
            f"P {self.found.precision or 0:.3f} least recall {self.least:.3f} "
            f"E {self.found.effect_accuracy or 0:.3f}, {figures.operators:2d} operators, "
            f"{figures.unresolved:2d} left, {self.calls:4d} calls"
        )  # fmt: skip


class Stages:
    """Judges a run after certain numbers of executions; watches it."""

    def __init__(
        self, at: Sequence[int], scenes: Sequence[LabelledStates], budget: CallBudget
    ) -> None:
        self._open, self._scenes, self._budget = sorted(at), scenes, budget
        self.found: list[Stage] = []

    def __call__(self, event: RunEvent) -> None:
        """Judge what an iteration ends with, if it is time."""
        if not isinstance(event, IterationFinished):
            return
        executions = event.result.figures.executions
        if self._open and executions >= self._open[0]:
            self._open = [n for n in self._open if n > executions]
            found = verify(self._scenes, event.result.model)
            self.found.append(Stage(executions, self._budget.calls, event.result, found))


def judge(domain: str) -> list[LabelledStates]:
    """All states of all scenes of a domain, read without error."""
    package = find_domain(domain)
    reader = ExactReader.of(package)
    if reader is None:
        raise SystemExit(f"{domain}: nobody reads its predicates without error")
    states = scene_states(package, (), TRUTH_LAYOUT)
    return [LabelledStates(scene, PictureReader(reader)) for scene in states]


def measure(
    domain: str, seed: int, at: Sequence[int], scenes: Sequence[LabelledStates],
    assigned: Sequence[str],
) -> list[Stage]:  # fmt: skip
    """Learn with one seed, and judge on the way."""
    run = settings_of(assigned, domain=domain, seed=seed)
    run = run.model_copy(update={"iterations": -(-max(at) // run.exploration.budget)})
    budget = CallBudget()
    watch = Stages(at, scenes, budget)
    asked = open_model(run.model.name, run.model, seed, domain)
    learn(run, model=LimitedModel(asked, budget), observers=[watch])
    return watch.found


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a line for each seed and number of executions, and the shares."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("domain", nargs="?", default="burger")
    parser.add_argument("--seeds", default="0-3", metavar="A-B")
    parser.add_argument("--at", nargs="+", type=int, default=[75, 150])
    parser.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE")
    given = parser.parse_args(arguments)
    first, _, last = given.seeds.partition("-")
    scenes = judge(given.domain)
    found: list[list[Stage]] = []
    for seed in range(int(first), int(last or first) + 1):
        started = time.process_time()
        found.append(measure(given.domain, seed, given.at, scenes, given.set))
        for stage in found[-1]:
            print(f"seed {seed:2d} {stage}", flush=True)
        print(f"        {time.process_time() - started:.0f} CPU-seconds", flush=True)
    for stages in zip(*found, strict=True):
        calls = statistics.median(stage.calls for stage in stages)
        exact = sum(stage.is_exact for stage in stages)
        print(
            f"{stages[0].executions} executions: exact on {exact} of {len(stages)} seeds, "
            f"{calls:g} calls in the median"
        )


if __name__ == "__main__":
    main()
