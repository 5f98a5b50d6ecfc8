"""Exact verification: a model against every state and every skill instance of its domain."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import Any

from skillwrapper.evaluation.exact.labelled_states import LabelledStates, SceneStates
from skillwrapper.evaluation.exact.predictions import predict_all
from skillwrapper.evaluation.exact.tallies import Tally, tally_by_skill
from skillwrapper.evaluation.exact.verdicts import Refutation, Verdict, Verdicts, judge
from skillwrapper.evaluation.exact.vocabulary import Vocabulary, vocabulary_of
from skillwrapper.grounding import GroundModel
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.world.observation import Observation
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class Counterexample:
    """A shortest way to see that a definition does not hold.

    Attributes:
        verdict: the definition: ``"sound"``, ``"complete"`` or ``"suitable"``.
        reason: what is wrong.
        scene: name of the scene.
        path: skill instances from the scene's start to the state in question.
        instance: the skill instance that is predicted wrongly there.
        difference: atoms that are predicted otherwise than they are read.
        before: what is seen in the state.
        after: what is seen after running the instance.
    """

    verdict: str
    reason: str
    scene: str
    path: tuple[SkillInstance, ...]
    instance: SkillInstance
    difference: tuple[str, ...]
    before: Observation
    after: Observation

    def to_json(self) -> dict[str, Any]:
        """Plain data, pictures by their keys."""
        return {
            "verdict": self.verdict,
            "reason": self.reason,
            "scene": self.scene,
            "path": [str(instance) for instance in self.path],
            "instance": str(self.instance),
            "difference": list(self.difference),
            "before": self.before.key,
            "after": self.after.key,
        }


@dataclass(frozen=True)
class Verification:
    """The truth about a model in one scene or in several; what is undefined is None, never 1.

    Attributes:
        scenes: names of the scenes.
        states: number of reachable states.
        pairs: number of states times skill instances.
        undecided: pairs whose prediction rests on an atom that was read as unknown.
        by_skill: what was predicted of every skill, and how often rightly.
        vocabulary: what the labels determine of the true facts; None where nobody tells these.
        verdicts: whether the model is sound, complete and suitable (the paper's definitions).
        counterexamples: one for each definition that does not hold.
        seconds: wall-clock time, of reading and checking.
        parts: the verification in each scene, if there are several.
    """

    scenes: tuple[str, ...]
    states: int
    pairs: int
    undecided: int
    by_skill: dict[str, Tally]
    vocabulary: Vocabulary | None
    verdicts: Verdicts
    counterexamples: tuple[Counterexample, ...]
    seconds: float
    parts: tuple[Verification, ...] = ()

    @property
    def total(self) -> Tally:
        """The counts of all skills together."""
        return sum(self.by_skill.values(), Tally())

    @property
    def precision(self) -> float | None:
        """Of the pairs predicted to succeed, the share that does."""
        return self.total.precision

    @property
    def recall(self) -> float | None:
        """Of the pairs that succeed, the share predicted to."""
        return self.total.recall

    @property
    def effect_accuracy(self) -> float | None:
        """Of the changes predicted for successes, the share that is read afterwards."""
        return self.total.effect_accuracy

    def to_json(self) -> dict[str, Any]:
        """Plain data; null for what is undefined, and for a verdict that is open."""
        total, skills = self.total, self.by_skill.items()
        data = {
            "states": self.states,
            "pairs": self.pairs,
            "successes": total.successes,
            "undecided": self.undecided,
            "precision": total.precision,
            "recall": total.recall,
            "effect_accuracy": total.effect_accuracy,
            "precision_by_skill": {name: tally.precision for name, tally in skills},
            "recall_by_skill": {name: tally.recall for name, tally in skills},
            "effect_accuracy_by_skill": {name: tally.effect_accuracy for name, tally in skills},
            "vocabulary": self.vocabulary.to_json() if self.vocabulary else None,
            "sound": self.verdicts.sound.known,
            "complete": self.verdicts.complete.known,
            "suitable": self.verdicts.suitable.known,
            "counterexamples": [example.to_json() for example in self.counterexamples],
            "seconds": self.seconds,
        }
        if not self.parts:
            return {"scene": self.scenes[0], **data}
        return {**data, "scenes": {part.scenes[0]: part.to_json() for part in self.parts}}


def verify(scenes: Sequence[LabelledStates], model: AbstractModel) -> Verification:
    """Compare predictions with what happens, in every state of every scene.

    Args:
        scenes: the states of at least one scene with their labels.
        model: the model to check.
    """
    parts = tuple(_verify_scene(labelled, model) for labelled in scenes)
    return parts[0] if len(parts) == 1 else _together(parts)


def _verify_scene(labelled: LabelledStates, model: AbstractModel) -> Verification:
    started = time.monotonic()
    states = labelled.states
    ground = GroundModel.of(model, states.scene.objects)
    labels = labelled.labels(ground.space)
    predictions = predict_all(ground, states.space, labels)
    verdicts = judge(ground, predictions)
    return Verification(
        scenes=(states.scene.name,),
        states=len(states.space.states),
        pairs=int(states.space.success.size),
        undecided=int(predictions.undecided.sum()),
        by_skill=tally_by_skill(predictions),
        vocabulary=vocabulary_of(states.facts, labels) if states.facts is not None else None,
        verdicts=verdicts,
        counterexamples=tuple(_counterexample(states, found) for found in verdicts.refutations),
        seconds=time.monotonic() - started,
    )


def _together(parts: tuple[Verification, ...]) -> Verification:
    """The verification of several scenes; of counterexamples the nearest ones."""
    skills = dict.fromkeys(name for part in parts for name in part.by_skill)
    vocabularies = [part.vocabulary for part in parts if part.vocabulary is not None]
    verdicts = [part.verdicts for part in parts]
    examples: dict[str, Counterexample] = {}
    for example in sorted((e for p in parts for e in p.counterexamples), key=_path_length):
        examples.setdefault(example.verdict, example)
    return Verification(
        scenes=tuple(name for part in parts for name in part.scenes),
        states=sum(part.states for part in parts),
        pairs=sum(part.pairs for part in parts),
        undecided=sum(part.undecided for part in parts),
        by_skill={
            name: sum((part.by_skill.get(name, Tally()) for part in parts), Tally())
            for name in skills
        },
        vocabulary=reduce(add, vocabularies) if vocabularies else None,
        verdicts=Verdicts(
            sound=Verdict.together(found.sound for found in verdicts),
            complete=Verdict.together(found.complete for found in verdicts),
            suitable=Verdict.together(found.suitable for found in verdicts),
        ),
        counterexamples=tuple(examples.values()),
        seconds=sum(part.seconds for part in parts),
        parts=parts,
    )


def _path_length(example: Counterexample) -> int:
    return len(example.path)


def _counterexample(states: SceneStates, found: Refutation) -> Counterexample:
    space = states.space
    following = int(space.following[found.state, found.instance])
    return Counterexample(
        verdict=found.verdict,
        reason=found.reason,
        scene=states.scene.name,
        path=space.path_to(found.state),
        instance=space.instances[found.instance],
        difference=found.difference,
        before=states.situations[found.state].look(),
        after=states.situations[following].look(),
    )
