"""What readings of one picture are worth: how likely each is, by what is true in the picture."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.decoding.readings import ErrorRates
from skillwrapper.symbols import Atom

_MOST = 0.45
"""A reading is worth something: it is rather right than wrong."""
_LEAST = 1e-3
"""No reading is beyond doubt, however rightly others were read."""
_CLEAN = 0.1
"""Clean pictures have fewer errors than pictures at large by an order of magnitude."""


@dataclass(frozen=True)
class KnownErrors:
    """How often a model misreads, as far as it is known of its readings.

    Attributes:
        rates: error rates of predicates, by name; others err as is believed beforehand.
        dirty: the share of pictures in which something is misread.
    """

    rates: Mapping[str, ErrorRates]
    dirty: float = 0.5


NOTHING_KNOWN = KnownErrors({})


@dataclass(frozen=True, eq=False)
class ReadingModel:
    """How readings of a picture come about.

    A picture is clean, then hardly anything is misread, or dirty; besides, two things that are
    alike may be taken for each other, and all that is said of the one is then said of the other.

    Attributes:
        false_positive: for every atom (atoms,) how often it is read as true in dirty pictures
            where it is false.
        false_negative: likewise, as false where it is true.
        clean: how often an atom is misread in clean pictures.
        dirty: the share of dirty pictures.
        exchanges: for every pair of things that are alike the atom (pairs, atoms) that stands in
            the place of each.
        exchanged: the share of pictures in which two things are taken for each other.
    """

    false_positive: Floats
    false_negative: Floats
    clean: float
    dirty: float
    exchanges: NDArray[np.intp]
    exchanged: float

    @classmethod
    def of(
        cls, space: AtomSpace, priors: Priors | None = None, known: KnownErrors = NOTHING_KNOWN
    ) -> ReadingModel:
        """The model of the readings of a scene.

        Args:
            space: the ground atoms.
            priors: what is believed of readings beforehand.
            known: what is known of them.
        """
        prior = (priors or Priors()).misread
        usual = ErrorRates(prior, prior, 0.0, 0.0)
        dirty = min(1 - _LEAST, max(_LEAST, known.dirty))
        own = [known.rates.get(atom.predicate, usual) for atom in space.atoms]
        positive, negative = (
            np.clip(np.array(rates, dtype=np.float64) / dirty, _LEAST, _MOST)
            for rates in ([r.false_positive for r in own], [r.false_negative for r in own])
        )
        exchanges = np.array(list(_exchanges(space)), dtype=np.intp).reshape(-1, len(space.atoms))
        return cls(positive, negative, _CLEAN * prior, dirty, exchanges, prior)

    def log_likelihood(self, states: Labels, read: Labels) -> Floats:
        """How likely a picture is read so (states,), in nats, in each of some states.

        Args:
            states: abstract states (states, atoms) of TRUE and FALSE only.
            read: what was read (atoms,); what is UNKNOWN tells nothing.
        """
        as_it_is = self._of_facts(states, read)
        if not len(self.exchanges):
            return as_it_is
        likely = math.log1p(-self.exchanged) + as_it_is
        each = math.log(self.exchanged / len(self.exchanges))
        for places in self.exchanges:
            likely = np.logaddexp(likely, each + self._of_facts(states, read[places]))
        return likely

    def _of_facts(self, states: Labels, read: Labels) -> Floats:
        """Likewise, if nothing is taken for something else."""
        dirty = self._by_rates(states, read, self.false_positive, self.false_negative)
        always = np.full(len(read), self.clean)
        clean = self._by_rates(states, read, always, always)
        likely: Floats = np.logaddexp(math.log(self.dirty) + dirty, math.log1p(-self.dirty) + clean)
        return likely

    def _by_rates(
        self, states: Labels, read: Labels, false_positive: Floats, false_negative: Floats
    ) -> Floats:
        says, known = read == TRUE, read != UNKNOWN
        true = np.log(np.where(says, 1 - false_negative, false_negative)) * known
        false = np.log(np.where(says, false_positive, 1 - false_positive)) * known
        likely: Floats = false.sum() + (states == TRUE) @ (true - false)
        return likely


def _exchanges(space: AtomSpace) -> Iterator[list[int]]:
    """For every pair of objects of the same types the columns of the atoms with them exchanged."""
    for one, other in itertools.combinations(space.objects, 2):
        if one.types == other.types:
            swap = {one.name: other.name, other.name: one.name}
            yield [
                space.column[Atom(atom.predicate, tuple(swap.get(t, t) for t in atom.terms))]
                for atom in space.atoms
            ]
