"""What a few pictures show, by those around them: enough to overrule a reading at little cost."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.perception.decoding.chains import Chain, StepKind
from skillwrapper.perception.decoding.decoder import Decoding
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

_REACH = 3
"""Pictures so many skills away are read too: most of what a skill does not touch is seen in so many
before and after, and one of them misread is outvoted."""


class Surroundings:
    """Labels of the pictures of some transitions, decoded with the pictures around them.

    Args:
        recorded: all transitions.
        truth: the readings of their pictures.
        chains: which pictures follow each other, one chain a scene.
        numbers: of the transitions.
        decode: decodes a predicate, from what was read (nodes, atoms) of every chain.
    """

    def __init__(
        self,
        recorded: RecordedTransitions,
        truth: TruthSource,
        chains: Sequence[Chain],
        numbers: Sequence[int],
        decode: Callable[[Predicate, Sequence[Labels]], Decoding],
    ) -> None:
        self._recorded, self._truth, self._chains, self._decode = recorded, truth, chains, decode
        self._rows = [self._near(chain, numbers) for chain in chains]
        self._known: dict[Predicate, Decoding] = {}

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Have the pictures read that are needed, for all predicates together."""
        predicates = tuple(dict.fromkeys(p for space, _ in wanted for p in space.predicates))
        self._truth.prefetch(
            (AtomSpace((predicate,), chain.scene.objects), self._pictures(chain.scene, rows))
            for chain, rows in zip(self._chains, self._rows, strict=True)
            for predicate in predicates
        )

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms) of pictures of the transitions."""
        columns = [self._labels_of(space, p, observations) for p in space.predicates]
        empty = np.zeros((len(observations), 0), dtype=np.int8)
        return np.hstack(columns) if columns else empty

    def _labels_of(
        self, space: AtomSpace, predicate: Predicate, observations: Sequence[Observation]
    ) -> Labels:
        if predicate not in self._known:
            parts = zip(self._chains, self._rows, strict=True)
            read = [self._read(predicate, chain, rows) for chain, rows in parts]
            self._known[predicate] = self._decode(predicate, read)
        number, rows = self._place(space, observations)
        believed = self._known[predicate].posterior[number][predicate][rows]
        return np.where(believed > 0.5, TRUE, FALSE).astype(np.int8)

    def _place(
        self, space: AtomSpace, observations: Sequence[Observation]
    ) -> tuple[int, list[int]]:
        """The chain that has all the pictures, and their nodes."""
        for number, chain in enumerate(self._chains):
            nodes = [self._recorded.number_of(chain.scene, one) for one in observations]
            if chain.scene.objects == space.objects and None not in nodes:
                return number, [node for node in nodes if node is not None]
        raise KeyError("no chain has these pictures")

    def _read(self, predicate: Predicate, chain: Chain, rows: Sequence[int]) -> Labels:
        space = AtomSpace((predicate,), chain.scene.objects)
        read = np.full((chain.nodes, len(space.atoms)), UNKNOWN, dtype=np.int8)
        if rows:
            read[rows] = self._truth.labels(space, self._pictures(chain.scene, rows))
        return read

    def _pictures(self, scene: Scene, rows: Sequence[int]) -> list[Observation]:
        seen = self._recorded.observations(scene)
        return [seen[row] for row in rows]

    def _near(self, chain: Chain, numbers: Sequence[int]) -> list[int]:
        """The pictures (nodes) of a chain within reach of those of the transitions."""
        records = [self._recorded.records[number] for number in numbers]
        own = [record for record in records if record.scene == chain.scene]
        near = np.zeros(chain.nodes, dtype=bool)
        near[[node for record in own for node in (record.before, record.after)]] = True
        done = [n for n, step in enumerate(chain.steps) if step.kind is not StepKind.SAME]
        edges = np.flatnonzero(np.isin(chain.which, done))
        before, after = chain.before[edges], chain.after[edges]
        for _ in range(_REACH if own else 0):
            ahead, back = after[near[before]], before[near[after]]
            near[ahead] = near[back] = True
        return [int(node) for node in np.flatnonzero(near)]
