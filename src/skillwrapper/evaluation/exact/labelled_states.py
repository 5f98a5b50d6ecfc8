"""All states of a scene: what happens in them, what is true in them, and how they are labelled."""

from __future__ import annotations

import hashlib
import io
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Final

import numpy as np

from skillwrapper.evaluation.exact.state_readers import Situation, StateReader
from skillwrapper.evaluation.exact.state_space import StateSpace
from skillwrapper.files.writing import write_atomically
from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.capabilities import Enumerable, Truthful, require, supports
from skillwrapper.world.scenes import Scene

TRUTH_LAYOUT: Final = 999_999_937
"""The seed of the layout in which all states are read; no run and no problem has it."""


class SceneStates:
    """All states of one scene.

    Args:
        environment: of this object alone; its scene and layout must stay as they are.
        scene: name of the scene; None for the domain's first.
        layout: seed of the layout of the pictures.

    Attributes:
        environment: puts states on display.
        scene: the objects that are present.
        layout: as given.
    """

    def __init__(
        self, environment: Enumerable, scene: str | None = None, layout: int = TRUTH_LAYOUT
    ) -> None:
        self.scene: Scene = environment.domain.scene(scene)
        environment.reset(seed=layout, scene=self.scene.name)
        self.environment, self.layout = environment, layout

    @cached_property
    def space(self) -> StateSpace:
        """All states, and what happens in them."""
        return StateSpace.of(self.environment)

    @cached_property
    def situations(self) -> tuple[Situation, ...]:
        """All states with their pictures, each of which is drawn once."""
        show = self.environment.set_state
        return tuple(Situation(cache(partial(show, state)), state) for state in self.space.states)

    @cached_property
    def facts(self) -> tuple[frozenset[Atom], ...] | None:
        """What the simulator says is true in every state; None if it says nothing."""
        if not supports(self.environment, Truthful):
            return None
        truthful = require(self.environment, Truthful, "comparing with true facts")
        return tuple(
            frozenset(Atom(*pair) for pair in truthful.true_atoms(state))
            for state in self.space.states
        )


class LabelledStates:
    """Labels of predicates in all states of a scene, each read only once.

    Drawing and reading all pictures of a domain takes half a minute; so the labels of every
    predicate are kept, in memory and in a folder that several processes may share.

    Args:
        states: the states.
        reader: labels them.
        folder: where labels are kept; None for in memory only.

    Attributes:
        states: as given.
        reader: as given.
    """

    def __init__(
        self, states: SceneStates, reader: StateReader, folder: Path | None = None
    ) -> None:
        self.states, self.reader, self._folder = states, reader, folder
        self._known: dict[Predicate, Labels] = {}

    def labels(self, atoms: AtomSpace) -> Labels:
        """Labels of all states (states, atoms)."""
        missing = tuple(p for p in atoms.predicates if self._find(atoms, p) is None)
        if missing:
            self._read(AtomSpace(missing, atoms.objects))
        columns = [self._known[p] for p in atoms.predicates]
        shape = (len(self.states.space.states), 0)
        return np.hstack(columns) if columns else np.zeros(shape, dtype=np.int8)

    def _find(self, atoms: AtomSpace, predicate: Predicate) -> Labels | None:
        """Labels that are known already (states, groundings)."""
        path = self._path(predicate)
        if predicate not in self._known and path is not None and path.exists():
            stored = np.load(path, allow_pickle=False)
            states = len(self.states.space.states)
            if stored.shape == (states, len(predicate.groundings(atoms.objects))):
                self._known[predicate] = stored
        return self._known.get(predicate)

    def _read(self, atoms: AtomSpace) -> None:
        labels, column = self.reader.read(atoms, self.states.situations), 0
        for predicate in atoms.predicates:
            width = len(atoms.atoms_of[predicate.name])
            self._known[predicate] = labels[:, column : column + width]
            self._store(predicate, labels[:, column : column + width])
            column += width

    def _store(self, predicate: Predicate, labels: Labels) -> None:
        path = self._path(predicate)
        if path is not None:
            data = io.BytesIO()
            np.save(data, labels, allow_pickle=False)
            write_atomically(path, data.getvalue())

    def _path(self, predicate: Predicate) -> Path | None:
        """A file whose name tells all that decides how the predicate is read."""
        if self._folder is None:
            return None
        states = self.states
        where = (states.environment.domain.name, str(states.layout), *states.scene.names)
        what = (predicate.name, predicate.semantics, *predicate.types)
        digest = hashlib.sha256("\n".join((*where, *what)).encode()).hexdigest()[:24]
        return self._folder / f"{predicate.name[:60]}-{digest}.npy"
