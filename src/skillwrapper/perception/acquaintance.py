"""What was learned of a model's eyes and of a world's states, for use on pictures yet to come."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import FALSE, TRUE, AtomSpace, Labels
from skillwrapper.perception.decoding.chains import Chain, chain_of_starts, chains_of
from skillwrapper.perception.decoding.decoder import Decoding, decode
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.perception.reading_model import NOTHING_KNOWN, KnownErrors
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

_OPEN = 6
"""Up to so many atoms of a state may be in doubt, for both to be taken into account."""
_SURE = 0.999
"""What is less probable is in doubt: if it is wrong, all that it leads to is wrong too."""

_Seen = Callable[[Scene], Sequence[Observation]]


@dataclass(frozen=True, eq=False)
class FamiliarStates:
    """States that occur in a scene, the surest first.

    Attributes:
        labels: the abstract states (n, atoms), of TRUE and FALSE only.
        nats: how surely each (n,) occurs: the logarithm of a probability.
    """

    labels: Labels
    nats: Floats

    @classmethod
    def certain(cls, labels: Labels) -> FamiliarStates:
        """States (n, atoms) that occur for certain."""
        return cls(labels, np.zeros(len(labels)))


@dataclass(frozen=True)
class Acquaintance:
    """What is known before a picture is read.

    Attributes:
        errors: how often the model misreads.
        familiar: the states that are known to occur, by scene.
    """

    errors: KnownErrors = NOTHING_KNOWN
    familiar: Mapping[Scene, FamiliarStates] = field(default_factory=dict)

    @classmethod
    def from_record(
        cls,
        recorded: RecordedTransitions,
        truth: TruthSource,
        predicates: Sequence[Predicate],
        priors: Priors | None = None,
    ) -> Acquaintance:
        """From what was executed; pictures that were never read are read."""
        chains = chains_of(recorded)
        decoding = _decoded(chains, recorded.observations, truth, predicates, priors)
        rates = {predicate.name: rates for predicate, rates in decoding.rates.items()}
        errors = KnownErrors(rates, decoding.dirty) if rates else NOTHING_KNOWN
        return cls(errors, _familiar(chains, decoding))

    @classmethod
    def from_starts(
        cls,
        starts: Mapping[Scene, Sequence[Observation]],
        truth: TruthSource,
        predicates: Sequence[Predicate],
        *,
        restored: bool,
        priors: Priors | None = None,
    ) -> Acquaintance:
        """From what is seen after resets, several for each scene.

        Of errors that tells too little: what is never true there, is never missed.

        Args:
            starts: what is seen.
            truth: reads it.
            predicates: the vocabulary.
            restored: whether a reset brings the same state back (D8).
            priors: what is believed of readings beforehand.
        """
        chains = tuple(chain_of_starts(s, len(o), restored=restored) for s, o in starts.items())
        decoding = _decoded(chains, lambda scene: starts[scene], truth, predicates, priors)
        return cls(familiar=_familiar(chains, decoding))


def _decoded(
    chains: Sequence[Chain],
    seen: _Seen,
    truth: TruthSource,
    predicates: Sequence[Predicate],
    priors: Priors | None,
) -> Decoding:
    vocabulary = tuple(predicates)
    read = [
        truth.labels(AtomSpace(vocabulary, chain.scene.objects), seen(chain.scene))
        for chain in chains
    ]
    return decode(chains, vocabulary, read, priors)


def _familiar(chains: Sequence[Chain], decoding: Decoding) -> Mapping[Scene, FamiliarStates]:
    return {
        chain.scene: _familiar_states(decoding.beliefs(place)) for place, chain in enumerate(chains)
    }


def _familiar_states(believed: Floats) -> FamiliarStates:
    """The states of the pictures of which least is in doubt; what is in doubt is taken both ways.

    Args:
        believed: the probability (pictures, atoms) that an atom is true.
    """
    doubts = np.maximum(believed, 1 - believed) < _SURE
    count = doubts.sum(axis=1)
    rows = np.flatnonzero(count == count.min(initial=_OPEN))
    found: dict[bytes, tuple[float, Labels]] = {}
    for row in rows[: 1 if count[rows].any() else None]:
        for state in _both_ways(believed[row], doubts[row]):
            right = np.where(state == TRUE, believed[row], 1 - believed[row])
            nats = float(np.log(np.maximum(right, 1e-12)).sum())
            found.setdefault(state.tobytes(), (nats, state))
    ordered = sorted(found.values(), key=lambda pair: -pair[0])
    labels = np.array([state for _, state in ordered], dtype=np.int8)
    sureness = np.array([nats for nats, _ in ordered], dtype=np.float64)
    return FamiliarStates(labels.reshape(-1, believed.shape[1]), sureness)


def _both_ways(believed: Floats, doubts: NDArray[np.bool_]) -> Iterator[Labels]:
    """What is believed (atoms,), with what is in doubt (atoms,) in every combination."""
    certain = np.where(believed > 0.5, TRUE, FALSE).astype(np.int8)
    for values in itertools.product((FALSE, TRUE), repeat=int(doubts.sum())):
        state = certain.copy()
        state[doubts] = values
        yield state
