"""Learning in a world, and judging by its true states what came of it."""

from __future__ import annotations

import random
import resource
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from benchmarks.worlds.reader import CarefulReader
from benchmarks.worlds.world import World
from skillwrapper.embedded.prompt_text import WrittenCall
from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.state_readers import PictureReader, Situation
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.evaluation.problems.solving import ModelSolver
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.planning.planner import Planner
from skillwrapper.runs.events import IterationFinished, PredicateDecided, RunEvent, SkillExecuted
from skillwrapper.runs.launch import learn
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings
from skillwrapper.runs.settings_layers import SettingsLayers
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet


def least_recall(found: Verification) -> float:
    """The least recall of a skill; 0 if none is defined."""
    recalls = (tally.recall for tally in found.by_skill.values())
    return min((recall for recall in recalls if recall is not None), default=0.0)


@dataclass(frozen=True)
class Outcome:
    """What was learned from one run.

    Attributes:
        result: of the run.
        results: of all problems.
        found: the truth about the model.
        seconds: of every iteration.
        steps: of every choice of a skill, with what was invented before it.
        reader: the model that was asked.
    """

    result: LearningResult
    results: Sequence[ProblemResult]
    found: Verification
    seconds: Sequence[float]
    steps: Sequence[float]
    reader: CarefulReader

    @property
    def solved(self) -> tuple[int, int]:
        """Of the problems that have a solution, how many were solved, and how many there are."""
        own = [r for r in self.results if r.kind is not ProblemClass.IMPOSSIBLE]
        return sum(r.solved for r in own), len(own)

    def __str__(self) -> str:
        solved, solvable = self.solved
        found, figures = self.found, self.result.figures
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        return (
            f"solved {solved:2d}/{solvable}  P {found.precision or 0:.3f} R {found.recall or 0:.3f}"
            f" least {least_recall(found):.2f} E {found.effect_accuracy or 0:.3f}  calls "
            f"{sum(self.reader.asked.values()):5d}  left {figures.unresolved:2d}  predicates "
            f"{figures.predicates:2d} operators {figures.operators:2d}  iteration "
            f"{max(self.seconds):5.1f} s at most  step {np.median(self.steps):.2f}/"
            f"{max(self.steps):.1f} s  {memory:.0f} MB"
        )


@dataclass
class _Watch:
    """Measures iterations and steps in processor time."""

    told: bool = False
    iterations: list[float] = field(default_factory=list)
    steps: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._iteration = self._step = time.process_time()

    def __call__(self, event: RunEvent) -> None:
        now = time.process_time()
        if isinstance(event, SkillExecuted):
            self.steps.append(now - self._step)
            if self.told:
                t = event.transition
                print(f"{len(self.steps):3d} {t.instance!s:34} {t.success!s:5} {event.reason}")
        if isinstance(event, PredicateDecided) and self.told:
            decision = event.decision
            print(f"        {decision.verdict} {decision.predicate.signature}: {decision.reason}")
        if isinstance(event, IterationFinished):
            self.iterations.append(now - self._iteration)
            self._iteration = now
        self._step = now


class TrueReader:
    """Labels states as the careful reader would, without a picture or a question."""

    def __init__(self, reader: CarefulReader, world: World) -> None:
        self._reader, self._world = reader, world

    def read(self, space: AtomSpace, situations: Sequence[Situation]) -> Labels:
        """Labels (situations, atoms)."""
        columns = []
        for atom in space.atoms:
            idea = self._reader.understand(WrittenCall(atom.predicate, atom.terms))
            columns.append([
                idea is not None
                and idea.holds(s.state | {("picture", "0")}, self._world, atom.terms)
                for s in situations
            ])  # fmt: skip
        return np.array(columns, dtype=np.int8).reshape(len(space.atoms), len(situations)).T


def measure(
    kind: type[World], seed: int, executions: int, style: str, assigned: Sequence[str],
    *, told: bool = False,
) -> Outcome:  # fmt: skip
    """Learn in a world with a reader in some style, and try all problems."""
    world = kind()
    reader, watch = CarefulReader(world, style, seed), _Watch(told)
    budget = 15
    run = settings_of(
        assigned, domain=world.domain.name, seed=seed, iterations=-(-executions // budget),
        exploration={"budget": budget},
    )  # fmt: skip
    result = learn(run, environment=world, model=reader, observers=[watch])
    solver = ModelSolver(
        world=ProblemWorld(world),
        model=result.model,
        reader=PictureReader(TruthTable(world.domain, Assistant(ModelSet.of(reader)))),
        planner=Planner(),
        truth=(truth := _truth(kind, reader, world)),
    )
    calls = sum(reader.asked.values())
    results = [solver.solve(p) for name in truth for p in problems(truth[name].states, seed)]
    del calls
    return Outcome(
        result, results, verify(list(truth.values()), result.model), watch.iterations, watch.steps,
        reader,
    )  # fmt: skip


def settings_of(assigned: Sequence[str], **given: object) -> RunSettings:
    """Settings by name, and over them what is given as NAME=VALUE."""
    layers = SettingsLayers(RunSettings)
    for name, value in given.items():
        layers.add_any(name, value)
    for text in assigned:
        layers.assign(text)
    return layers.build()


def _truth(kind: type[World], reader: CarefulReader, world: World) -> dict[str, LabelledStates]:
    found = {}
    for name in world.domain.scenes:
        states = SceneStates(kind(), name)
        found[name] = LabelledStates(states, TrueReader(reader, world))
    return found


def problems(
    states: SceneStates, seed: int, solvable: int = 12, impossible: int = 3
) -> list[Problem]:
    """Problems of a scene, near and far, half of them from its start."""
    space, chance = states.space, random.Random(f"problems {seed} {states.scene.name}")
    found: list[Problem] = []
    for number in range(solvable + impossible):
        start = 0 if number % 2 == 0 else chance.randrange(len(space.states))
        distance = space.distances_from(start)
        is_solvable = number < solvable
        lengths = sorted({int(d) for d in distance if (d > 0 if is_solvable else d < 0)})
        if not lengths:
            continue
        length = lengths[(number + 1) * len(lengths) // solvable - 1] if is_solvable else -1
        goal = chance.choice(np.flatnonzero(distance == length).tolist())
        long = ProblemClass.EASY if length < 8 else ProblemClass.HARD
        found.append(Problem(
            name=f"{states.scene.name}-{number}",
            kind=long if is_solvable else ProblemClass.IMPOSSIBLE,
            layout=1000 + number,
            initial=states.environment.state_to_data(space.states[start]),
            goal=states.environment.state_to_data(space.states[goal]),
            length=length if is_solvable else None,
            scene=states.scene.name,
        ))  # fmt: skip
    return found
