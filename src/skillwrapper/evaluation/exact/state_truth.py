"""The truth about predicates: their labels in all states, read without error and only once."""

from __future__ import annotations

import hashlib
import io
from functools import cached_property
from pathlib import Path
from typing import Final

import numpy as np

from skillwrapper.evaluation.exact.plain_sight import PlainSight
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.files.writing import write_atomically
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Predicate
from skillwrapper.world.capabilities import Enumerable, look_at
from skillwrapper.world.observation import Observation

TRUTH_LAYOUT: Final = 999_999_937
"""The seed of the layout in which all states are read; no run and no problem has it."""


class StateTruth:
    """Labels of learned predicates, by default as the embedded model without noise reads them.

    Drawing and reading all pictures of a domain takes half a minute; so the labels of every
    predicate are kept, in memory and in a folder that several processes may share.

    Args:
        environment: of this object alone; its layout must stay as it is.
        folder: where labels are kept; None for in memory only.
        layout: seed of the layout of the pictures.
        sight: reads the pictures; None for the embedded model without noise.

    Attributes:
        sight: labels of single pictures.
    """

    def __init__(
        self,
        environment: Enumerable,
        folder: Path | None = None,
        layout: int = TRUTH_LAYOUT,
        sight: TruthSource | None = None,
    ) -> None:
        environment.reset(seed=layout)
        self.environment = environment
        self.sight: TruthSource = sight or PlainSight()
        self._folder, self._layout = folder, layout
        self._known: dict[tuple[str, ...], Labels] = {}

    @cached_property
    def space(self) -> StateSpace:
        """All states, and what happens in them."""
        return StateSpace.of(self.environment)

    def labels(self, atoms: AtomSpace) -> Labels:
        """Labels of all states (states, atoms)."""
        missing = tuple(p for p in atoms.predicates if self._find(atoms, p) is None)
        if missing:
            self._read(AtomSpace(missing, atoms.objects))
        columns = [self._known[_key(p)] for p in atoms.predicates]
        shape = (len(self.space.states), 0)
        return np.hstack(columns) if columns else np.zeros(shape, dtype=np.int8)

    @cached_property
    def _pictures(self) -> tuple[Observation, ...]:
        return look_at(self.environment, self.space.states)

    def _find(self, atoms: AtomSpace, predicate: Predicate) -> Labels | None:
        """Labels that are known already (states, groundings)."""
        key = _key(predicate)
        path = self._path(predicate)
        if key not in self._known and path is not None and path.exists():
            stored = np.load(path, allow_pickle=False)
            if stored.shape == (len(self.space.states), len(predicate.groundings(atoms.objects))):
                self._known[key] = stored
        return self._known.get(key)

    def _read(self, atoms: AtomSpace) -> None:
        labels, column = self.sight.labels(atoms, self._pictures), 0
        for predicate in atoms.predicates:
            width = len(atoms.atoms_of[predicate.name])
            self._known[_key(predicate)] = labels[:, column : column + width]
            self._store(predicate, labels[:, column : column + width])
            column += width

    def _store(self, predicate: Predicate, labels: Labels) -> None:
        path = self._path(predicate)
        if path is not None:
            data = io.BytesIO()
            np.save(data, labels, allow_pickle=False)
            write_atomically(path, data.getvalue())

    def _path(self, predicate: Predicate) -> Path | None:
        if self._folder is None:
            return None
        parts = (self.environment.domain.name, str(self._layout), *_key(predicate))
        digest = hashlib.sha256("\n".join(parts).encode()).hexdigest()[:24]
        return self._folder / f"{predicate.name[:60]}-{digest}.npy"


def _key(predicate: Predicate) -> tuple[str, ...]:
    """All that decides how a predicate is read."""
    return (predicate.name, predicate.semantics, *predicate.types)
