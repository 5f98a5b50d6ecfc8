"""What happens in a run, as values for those who watch it: an archive, a display, a notebook."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from skillwrapper.exploration.explorer import SequenceChoice
from skillwrapper.runs.decisions import PredicateDecision
from skillwrapper.runs.model_sessions import CallCounter
from skillwrapper.runs.results import LearningResult, SceneLabels
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True)
class RunEvent:
    """Something that happened.

    Attributes:
        iteration: in which iteration, from 1.
    """

    iteration: int


@dataclass(frozen=True)
class RunStarted(RunEvent):
    """The models are ready; told before the first iteration, with the number 0.

    Attributes:
        calls: counts how often models are asked; goes on counting.
    """

    calls: CallCounter


@dataclass(frozen=True)
class IterationStarted(RunEvent):
    """An iteration begins.

    Attributes:
        iterations: how many are wanted in all.
        budget: how many skills may be run in this one.
    """

    iterations: int
    budget: int


@dataclass(frozen=True)
class StartSeen(RunEvent):
    """A start was looked at before anything was executed; of iteration 0, in a resumed run too.

    Attributes:
        scene: the objects that are present.
        seed: that of the reset.
        start: what is seen.
    """

    scene: Scene
    seed: int
    start: Observation


@dataclass(frozen=True)
class EpisodeStarted(RunEvent):
    """The environment was reset, and the first skill chosen; not told of what was recorded before.

    Attributes:
        episode: its number in the run, from 1.
        scene: the objects that are present.
        seed: that of the reset.
        start: what is seen.
    """

    episode: int
    scene: Scene
    seed: int
    start: Observation


@dataclass(frozen=True)
class SequenceChosen(RunEvent):
    """A whole sequence of skills was chosen.

    Attributes:
        choice: the sequence, and how it was chosen.
    """

    choice: SequenceChoice


@dataclass(frozen=True)
class SkillExecuted(RunEvent):
    """A skill was run to its end; not told of what was recorded before.

    Attributes:
        episode: number of the episode in the run, from 1.
        transition: what came of it.
        message: why it failed, for people.
        reason: why it was run, for people.
    """

    episode: int
    transition: Transition
    message: str = ""
    reason: str = ""


@dataclass(frozen=True)
class SkillRecalled(RunEvent):
    """An execution that was recorded before has become part of the run.

    Attributes:
        transition: what came of it.
        reason: why it was run, for people.
    """

    transition: Transition
    reason: str = ""


@dataclass(frozen=True)
class PredicateDecided(RunEvent):
    """It was decided on a predicate."""

    decision: PredicateDecision


@dataclass(frozen=True)
class IterationFinished(RunEvent):
    """An iteration ends.

    Attributes:
        result: of all iterations so far.
        labels: of all observations so far, scene by scene.
    """

    result: LearningResult
    labels: tuple[SceneLabels, ...] = field(repr=False)


@dataclass(frozen=True)
class RunFinished(RunEvent):
    """The run ends.

    Attributes:
        result: of the whole run.
    """

    result: LearningResult


@dataclass(frozen=True)
class ImportedModelTried(RunEvent):
    """Operators that a person has imported were put to all that is recorded, after the run.

    Attributes:
        outcome: whether the run goes by them, or why not, for people.
    """

    outcome: str


Observer = Callable[[RunEvent], None]
"""Told of every event, in order, before the run goes on."""
