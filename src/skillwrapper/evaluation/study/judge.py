"""Deciding what a proposed predicate means by looking at many states."""

from __future__ import annotations

import random
from typing import Any

import numpy as np

from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.study.meaning import (
    Columns,
    Meaning,
    compare_meaning,
    target_columns,
)
from skillwrapper.evaluation.study.models import truthful_assistant
from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.capabilities import Enumerable, look_at, require

_LAYOUT = 424_242
"""Seed of the arrangement in which states are drawn; no run resets to it."""


class MeaningJudge:
    """Compares proposals with targets over states.

    Targets are true by the simulator, proposals by what the embedded model reads without noise;
    what that model does not understand stays undecided, and is for people to judge.

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
        chosen = list(environment.reachable_states())
        if states is not None and states < len(chosen):
            chosen = random.Random(f"invention study {seed}").sample(chosen, states)
        environment.reset(seed=_LAYOUT)
        self.environment = environment
        self.expert = expert.model
        self.states: tuple[Any, ...] = tuple(chosen)
        self._true = [frozenset(expert.atoms(state)) for state in chosen]
        self._pictures = look_at(environment, chosen)
        self._assistant = truthful_assistant()
        self._read: dict[tuple[Predicate, str], Columns] = {}

    def judge(self, proposed: Predicate, target: Atom) -> Meaning:
        """What a proposed predicate is to a target of a contrastive pair."""
        predicate = self.expert.predicate_by_name[target.predicate]
        wanted = target_columns(target, self._true_columns(predicate))
        objects = self.environment.domain.objects
        return compare_meaning(proposed, self._read_columns(proposed), wanted, objects)

    def _true_columns(self, predicate: Predicate) -> Columns:
        atoms = predicate.groundings(self.environment.domain.objects)
        return {
            atom.terms: np.array([atom in true for true in self._true], dtype=np.int8)
            for atom in atoms
        }

    def _read_columns(self, predicate: Predicate) -> Columns:
        """Predicates are equal whatever they mean, so the meaning is part of the key."""
        key = (predicate, predicate.semantics)
        if key not in self._read:
            space = AtomSpace((predicate,), self.environment.domain.objects)
            # A table of its own: tables, too, take predicates of one name for the same.
            table = TruthTable(self.environment.domain, self._assistant)
            labels = table.labels(space, self._pictures)
            self._read[key] = {a.terms: labels[:, i] for i, a in enumerate(space.atoms)}
        return self._read[key]
