"""What is known of recorded pictures beyond their readings: what is overruled, and the truth."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import UserError
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.grounding import FALSE, TRUE, AtomSpace
from skillwrapper.report.strips import Beyond
from skillwrapper.runs.archive import ArchivedIteration, RecordedLabels
from skillwrapper.runs.archive.records import DecodingRecord
from skillwrapper.symbols import Predicate
from skillwrapper.world.episode import Episode
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene

_VALUES: Mapping[int, bool | None] = {TRUE: True, FALSE: False}
_Seen = Mapping[Scene, Mapping[str, Observation]]


def beyond_readings(domain: str, latest: ArchivedIteration, episodes: Iterable[Episode]) -> Beyond:
    """What is known of the pictures of some episodes; nothing where labels were not decoded.

    The truth is known where the domain has a scene reader: simulated pictures are read without
    error (docs/semantics.md D25).

    Args:
        domain: reference to the domain of the run.
        latest: what was learned.
        episodes: what was executed.
    """
    if latest.decoding is None:
        return Beyond()
    seen: dict[Scene, dict[str, Observation]] = {}
    for episode in episodes:
        for transition in episode.transitions:
            for observation in (transition.before, transition.after):
                seen.setdefault(episode.scene, {})[observation.key] = observation
    overruled = frozenset(_overruled(latest.decoding, seen))
    return Beyond(overruled, _truth(domain, latest.model.predicates, seen))


def _overruled(decoding: DecodingRecord, seen: _Seen) -> Iterator[tuple[str, str]]:
    """The keys of pictures with the atoms that decoding takes for misread in them."""
    keys = {
        tuple(picture.sha256 for picture in observation.pictures): key
        for of_scene in seen.values()
        for key, observation in of_scene.items()
    }
    for one in decoding.overruled:
        if one.pictures in keys:
            yield keys[one.pictures], one.atom


def _truth(domain: str, words: tuple[Predicate, ...], seen: _Seen) -> RecordedLabels | None:
    """True labels of all pictures; None if the domain is gone, or has no reader."""
    try:
        reader = ExactReader.of(find_domain(domain))
    except UserError:
        return None
    if reader is None:
        return None
    rows: dict[str, dict[str, bool | None]] = {}
    for scene, observations in seen.items():
        space = AtomSpace(words, scene.objects)
        names = [str(atom) for atom in space.atoms]
        labels = reader.labels(space, list(observations.values()))
        for key, row in zip(observations, labels.tolist(), strict=True):
            rows[key] = dict(zip(names, map(_VALUES.get, row), strict=True))
    return RecordedLabels(rows)
