"""Labels as the embedded model without noise reads them, without the way over prompts and replies.

Exact figures rest on thousands of pictures. What the embedded model would say of each is known
from what it sees and what it takes a predicate to mean; writing prompts and parsing replies would
only take time. That both give the same labels is tested.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from skillwrapper.domains.eyesight import Eyesight
from skillwrapper.domains.package import DomainPackage
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.sight import Eye, Sight, first_sight
from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.observation import Observation

_CODES = {True: TRUE, False: FALSE, None: UNKNOWN}


class ExactReader:
    """Reads pictures without error (``perception.labelling.TruthSource``).

    Args:
        eyes: readers and words of the domain.
    """

    def __init__(self, eyes: Eyesight) -> None:
        self._eye, self._lexicon = Eye(eyes.readers), Lexicon(eyes.words)

    @classmethod
    def of(cls, package: DomainPackage) -> ExactReader | None:
        """The reader of a domain; None if it has no scene reader."""
        return cls(Eyesight.for_packages([package])) if package.has("scene_reader") else None

    @classmethod
    def required(cls, package: DomainPackage, purpose: str) -> ExactReader:
        """The reader of a domain.

        Raises:
            ConfigurationError: if it has no scene reader; names the purpose.
        """
        package.require("scene_reader", purpose)
        return cls(Eyesight.for_packages([package]))

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
                    for code in self._codes(predicate, space.atoms_of[predicate.name], sight)
                ]
        return labels

    def _look(self, observation: Observation) -> Sight | None:
        """What is seen in the first picture that shows anything."""
        return first_sight([self._eye.look(p.png, p.sha256) for p in observation.pictures])

    def _codes(self, predicate: Predicate, atoms: Sequence[Atom], sight: Sight) -> list[int]:
        semantics = predicate.semantics.partition("\n")[0]
        said_of = [atom.terms for atom in atoms]
        meaning = self._lexicon.meaning(predicate.name, semantics, said_of, sight.graph)
        if meaning is None:
            return [UNKNOWN] * len(atoms)
        truth = meaning.concept.truth
        return [_CODES[truth(sight, meaning.arranged(terms))] for terms in said_of]
