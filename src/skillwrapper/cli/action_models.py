"""``learn-operators`` with a PDDL domain: action models from symbolic traces."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.models import ActionModel, DomainModel
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.reading import read_steps
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton_files import read_skeleton
from skillwrapper.cli.output import print_json, results
from skillwrapper.errors import FileError
from skillwrapper.files.writing import write_atomically, write_json


class Negatives(StrEnum):
    """Which negative preconditions are learned (``ActionModelSettings.negatives``)."""

    NONE = "none"
    REASONED = "reasoned"
    DECLARED = "declared"
    ALL = "all"


class Effects(StrEnum):
    """How effects that depend on context are printed (``ActionModelSettings.effects``)."""

    CONDITIONAL = "conditional"
    SEPARATE = "separate"


@dataclass(frozen=True)
class TraceOptions:
    """What may be said of traces for a PDDL domain.

    Attributes:
        failures: whether what leaves the state as it was failed.
        partial: whether states say all that is known, not all that is true.
        problems: what plans start from and lead to.
        cautious: whether what no state shows counts as a precondition.
        negatives: which negative preconditions; None for the default.
        effects: how effects that depend on context are printed; None for the default.
    """

    failures: bool = False
    partial: bool = False
    problems: tuple[Path, ...] = ()
    cautious: bool = False
    negatives: Negatives | None = None
    effects: Effects | None = None

    def settings(self) -> ActionModelSettings:
        """What models may say."""
        given = {"negatives": self.negatives, "effects": self.effects}
        named = {key: value.value for key, value in given.items() if value is not None}
        return ActionModelSettings.model_validate({**named, "cautious": self.cautious})


def learn_from_traces(
    traces: Sequence[Path], domain: Path, out: Path, options: TraceOptions, *, as_json: bool
) -> None:
    """Learn a PDDL domain from traces, under its own names of actions and parameters."""
    settings = options.settings()
    skeleton = read_skeleton(domain)
    steps = read_steps(
        traces,
        skeleton,
        failures=options.failures,
        partial=options.partial,
        problems=options.problems,
    )
    first = next(steps, None)
    if first is None:
        raise FileError(f"{traces[0]}: expected at least one action between two states, got none")
    model = learn_action_models(skeleton, itertools.chain([first], steps), settings)
    write_atomically(out / "domain.pddl", print_model(model, settings.effects))
    write_json(out / "action_models.json", _figures(model))
    if as_json:
        print_json(_figures(model))
    else:
        _print(model, out)


def _figures(model: DomainModel) -> dict[str, Any]:
    return {
        "actions": {name: _figures_of(action) for name, action in model.actions.items()},
        "never_seen_to_work": _unseen(model),
    }


def _figures_of(model: ActionModel) -> dict[str, Any]:
    return {
        "transitions": model.steps,
        "preconditions": [str(c) for c in model.preconditions],
        "refuted": [str(c) for c in model.refuted],
        "effects": [
            {"change": str(e.change), "when": [str(c) for c in e.when]} for e in model.effects
        ],
        "unexplained": model.unexplained,
        "undecided": [str(atom) for atom in model.undecided],
        "unseen": [str(atom) for atom in model.unseen],
    }


def _unseen(model: DomainModel) -> list[str]:
    return [name for name in model.skeleton.actions if name not in model.actions]


def _print(model: DomainModel, out: Path) -> None:
    console = results()
    for name, action in model.actions.items():
        console.print(
            f"{name}: {action.steps} transitions, {len(action.preconditions)} preconditions, "
            f"{len(action.effects)} effects"
        )
        if action.unexplained:
            console.print(f"  {action.unexplained} of them follow from nothing about its arguments")
        if action.undecided:
            atoms = " ".join(map(str, action.undecided))
            console.print(f"  no state shows whether it changes {atoms}")
        if action.unseen:
            atoms = " ".join(map(str, action.unseen))
            console.print(f"  no state shows whether it needs {atoms}")
    for name in _unseen(model):
        console.print(f"{name}: never seen to work, left out")
    console.print(f"written: {out / 'domain.pddl'} and what belongs to it")
