"""Labels as the embedded model without noise reads them, without the way over prompts and replies.

Exact figures rest on thousands of pictures. What the embedded model would say of each is known
from what it sees and what it takes a predicate to mean; writing prompts and parsing replies would
only take time. That both give the same labels is tested.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from skillwrapper.embedded.lexicon import Understanding, understand
from skillwrapper.embedded.sight import Eye, Sight
from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.observation import Observation

_CODES = {True: TRUE, False: FALSE, None: UNKNOWN}


class PlainSight:
    """Reads pictures without error (``perception.labelling.TruthSource``)."""

    def __init__(self) -> None:
        self._eye = Eye()

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        """Nothing to do: looking costs nothing."""

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        """Labels (observations, atoms): TRUE, FALSE or UNKNOWN."""
        labels = np.full((len(observations), len(space.atoms)), UNKNOWN, dtype=np.int8)
        for row, observation in enumerate(observations):
            sight = self._look(observation)
            if sight is not None:
                labels[row] = [
                    code
                    for predicate in space.predicates
                    for code in _codes(predicate, space.atoms_of[predicate.name], sight)
                ]
        return labels

    def _look(self, observation: Observation) -> Sight | None:
        """What is seen in the first picture that shows anything."""
        sights = (self._eye.look(p.png, p.sha256) for p in observation.pictures)
        return next((sight for sight in sights if sight is not None), None)


def _codes(predicate: Predicate, atoms: Sequence[Atom], sight: Sight) -> list[int]:
    meaning = _meaning(predicate, atoms, sight)
    if meaning is None:
        return [UNKNOWN] * len(atoms)
    truth = meaning.concept.truth
    return [_CODES[truth(sight, meaning.arranged(atom.terms))] for atom in atoms]


def _meaning(predicate: Predicate, atoms: Sequence[Atom], sight: Sight) -> Understanding | None:
    """What a predicate is taken to mean of the things that are seen."""
    scene = sight.scene
    seen = (a.terms for a in atoms if all(name in scene for name in a.terms))
    terms = next(seen, None)
    if terms is None:
        return None
    kinds = tuple(scene.kind(name) for name in terms)
    semantics = predicate.semantics.partition("\n")[0]
    return understand(predicate.name, kinds, semantics, scene.names("station"))
