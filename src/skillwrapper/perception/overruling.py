"""What decoding made of readings: which it overrules, and how often each predicate is misread."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillwrapper.grounding import TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.decoding.decoder import Decoding
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.decoding.readings import ErrorRates
from skillwrapper.perception.labelling import TruthSource
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True)
class OverruledReading:
    """A reading that is taken for a mistake.

    Attributes:
        scene: where.
        observation: the picture.
        atom: what was read.
        read: what it was read as.
        posterior: the probability that it is true all the same.
    """

    scene: Scene
    observation: Observation
    atom: Atom
    read: bool
    posterior: float


@dataclass(frozen=True)
class DecodingCertificate:
    """What decoding made of the readings of a vocabulary.

    Attributes:
        readings: how many atoms were read.
        overruled: the readings that are taken for mistakes.
        in_doubt: how many atoms are neither surely true nor surely false.
        dirty: the expected share of pictures in which something is misread.
        rates: how often each predicate is misread.
    """

    readings: int
    overruled: tuple[OverruledReading, ...]
    in_doubt: int
    dirty: float
    rates: Mapping[Predicate, ErrorRates]


@dataclass(frozen=True)
class OverrulingCheck:
    """How often decoding was right, where the truth is known.

    Attributes:
        overruled: how many readings were overruled.
        right: how many of them were mistakes.
        misread: how many readings were mistakes.
    """

    overruled: int
    right: int
    misread: int


def certify_decoding(labeller: DecodedLabeller, sure: float) -> DecodingCertificate:
    """What decoding makes of the readings of the vocabulary in use.

    Args:
        labeller: has decoded them.
        sure: what is less probable, either way, is in doubt.
    """
    decoding, readings, doubts = labeller.decoding, 0, 0
    for place, scene in enumerate(labeller.recorded.scenes):
        believed = decoding.beliefs(place)
        readings += int((labeller.readings(scene, decoding.predicates) != UNKNOWN).sum())
        doubts += int((np.maximum(believed, 1 - believed) < sure).sum())
    return DecodingCertificate(
        readings,
        tuple(_overruled(labeller, decoding)),
        doubts,
        decoding.dirty,
        decoding.rates,
    )


def check_overruling(labeller: DecodedLabeller, truth: TruthSource) -> OverrulingCheck:
    """How often decoding was right.

    Args:
        labeller: has decoded readings.
        truth: reads without error.
    """
    overruled = right = misread = 0
    predicates = labeller.decoding.predicates
    for place, scene in enumerate(labeller.recorded.scenes):
        space = AtomSpace(predicates, scene.objects)
        true = truth.labels(space, labeller.recorded.observations(scene))
        read = labeller.readings(scene, predicates)
        against = _against(read, labeller.decoding.beliefs(place))
        wrong = (read != true) & (read != UNKNOWN) & (true != UNKNOWN)
        overruled += int(against.sum())
        right += int((against & wrong).sum())
        misread += int(wrong.sum())
    return OverrulingCheck(overruled, right, misread)


def _overruled(labeller: DecodedLabeller, decoding: Decoding) -> Iterator[OverruledReading]:
    for place, scene in enumerate(labeller.recorded.scenes):
        atoms = AtomSpace(decoding.predicates, scene.objects).atoms
        seen = labeller.recorded.observations(scene)
        believed = decoding.beliefs(place)
        read = labeller.readings(scene, decoding.predicates)
        for node, atom in np.argwhere(_against(read, believed)).tolist():
            yield OverruledReading(
                scene,
                seen[node],
                atoms[atom],
                bool(read[node, atom] == TRUE),
                float(believed[node, atom]),
            )


def _against(read: Labels, believed: Floats) -> NDArray[np.bool_]:
    """Which readings (nodes, atoms) are overruled."""
    against: NDArray[np.bool_] = (read != UNKNOWN) & ((believed > 0.5) != (read == TRUE))
    return against
