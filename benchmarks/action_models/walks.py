"""Random walks in AMLGym's learning problems, with failed attempts if wanted."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from benchmarks.action_models import gym
from skillwrapper.action_models.lisp import read_form
from skillwrapper.action_models.steps import State, Step
from skillwrapper.action_models.strips import Strips, read_objects


class Walker:
    """Walks in the problems of a domain, one problem after the other.

    Args:
        domain: name of the domain.
        true: the domain.
        seed: decides what is tried.
    """

    def __init__(self, domain: str, true: Strips, seed: int) -> None:
        self._true = true
        self._chance = np.random.default_rng(seed)
        self._problems = [
            (_initial(path), read_objects(path))
            for path in gym.problem_paths(domain, "learning")
            if path.stat().st_size  # AMLGym 1.0.13 ships seven empty files of visitall
        ]

    def walk(self, number: int, steps: int, failing: float = 0.0) -> Iterator[Step]:
        """The steps of one walk; it ends where nothing applies.

        Args:
            number: which walk; chooses the problem.
            steps: at most so many.
            failing: the share of attempts that are drawn from everything, whatever applies.
        """
        state, objects = self._problems[number % len(self._problems)]
        for _ in range(steps):
            good = sorted(self._true.applicable(state, objects))
            if not good:
                return
            chosen = good[int(self._chance.integers(len(good)))]
            if self._chance.random() < failing:
                chosen = self._anything(objects)
            name, arguments = chosen
            done = chosen in good
            after = self._true.actions[name].apply(state, arguments) if done else state
            yield Step(name, arguments, done, state, after)
            state = after

    def _anything(self, objects: dict[str, str]) -> tuple[str, tuple[str, ...]]:
        """An action with objects of the right types, drawn at random."""
        skeleton = self._true.skeleton
        names = list(skeleton.actions)
        action = skeleton.actions[names[int(self._chance.integers(len(names)))]]
        choices = [
            [n for n, kind in objects.items() if skeleton.accepts(kind, parameter)]
            for parameter in action.parameters
        ]
        return action.name, tuple(c[int(self._chance.integers(len(c)))] for c in choices)


def _initial(path: Path) -> State:
    for form in read_form(path.read_text(encoding="utf-8"), str(path)).forms:
        if form.head == ":init":
            return frozenset(" ".join(atom.words) for atom in form.forms)
    return frozenset()
