"""Deciding what a proposed predicate means by looking at many states."""

from __future__ import annotations

import random
from typing import Any

import numpy as np

from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.study.meaning import (
    Columns,
    Meaning,
    compare_meaning,
    target_columns,
)
from skillwrapper.grounding import AtomSpace
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.capabilities import Enumerable, look_at, require

_LAYOUT = 424_242
"""Seed of the arrangement in which states are drawn; no run resets to it."""


class MeaningJudge:
    """Compares proposals with targets over states.

    Targets are true by the simulator, proposals by what is read without error; what the embedded
    model does not understand stays undecided, and is for people to judge.

    Args:
        package: the domain.
        states: how many states are sampled; None for all.
        seed: of the sample.

    Raises:
        ConfigurationError: if its states cannot be listed, or it has no expert.

    Attributes:
        environment: draws the states.
        expert: the model of which targets are predicates.
        states: the states in which truth is compared.
    """

    def __init__(self, package: DomainPackage, states: int | None, seed: int) -> None:
        environment = require(package.make_environment(), Enumerable, "judging meanings")
        expert = package.expert
        environment.reset(seed=_LAYOUT)
        chosen = list(environment.reachable_states())
        if states is not None and states < len(chosen):
            chosen = random.Random(f"invention study {seed}").sample(chosen, states)
        self.environment = environment
        self.expert = expert.model
        self.states: tuple[Any, ...] = tuple(chosen)
        self._true = [frozenset(expert.atoms(state)) for state in chosen]
        self._pictures = look_at(environment, chosen)
        self._reader = ExactReader.required(package, "judging meanings")
        self._read: dict[Predicate, Columns] = {}

    def judge(self, proposed: Predicate, target: Atom) -> Meaning:
        """What a proposed predicate is to a target of a contrastive pair."""
        predicate = self.expert.predicate_by_name[target.predicate]
        wanted = target_columns(target, self._true_columns(predicate))
        objects = self.environment.scene.objects
        return compare_meaning(proposed, self._read_columns(proposed), wanted, objects)

    def _true_columns(self, predicate: Predicate) -> Columns:
        atoms = predicate.groundings(self.environment.scene.objects)
        return {
            atom.terms: np.array([atom in true for true in self._true], dtype=np.int8)
            for atom in atoms
        }

    def _read_columns(self, predicate: Predicate) -> Columns:
        if predicate not in self._read:
            space = AtomSpace((predicate,), self.environment.scene.objects)
            labels = self._reader.labels(space, self._pictures)
            self._read[predicate] = {a.terms: labels[:, i] for i, a in enumerate(space.atoms)}
        return self._read[predicate]
