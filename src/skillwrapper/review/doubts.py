"""Which labels of a run are in doubt, and why; pictures with most doubt come first."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.archive import ArchivedIteration
from skillwrapper.runs.corrections import Corrections
from skillwrapper.symbols.predicates import parse_atom
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation

_WEIGHTS = {
    "what came before and after speaks against it": 4,
    "it changed while nothing touched it": 3,
    "it takes part in something inconsistent": 2,
    "it could not be told": 1,
}
"""Reasons for doubt, and what they weigh against each other."""
OVERRULED, UNTOUCHED, INCONSISTENT, UNKNOWN = _WEIGHTS


@dataclass(frozen=True)
class ReviewedPicture:
    """What was seen at one moment, and how it was labelled.

    Attributes:
        observation: the pictures.
        caption: when it was seen first, for people.
        labels: by ground atom; None is unknown.
        doubts: the reason for every label in doubt.
        corrected: the labels that a person has given.
    """

    observation: Observation
    caption: str
    labels: Mapping[str, bool | None]
    doubts: Mapping[str, str] = field(default_factory=dict)
    corrected: frozenset[str] = frozenset()

    @property
    def weight(self) -> int:
        """How much doubt there is."""
        return sum(_WEIGHTS[reason] for reason in self.doubts.values())


def review_pictures(archive: RunArchive) -> list[ReviewedPicture]:
    """All pictures of a run, those with most doubt first, and then in order of time.

    Raises:
        UserError: if no iteration is finished, or a file is damaged.
    """
    latest, episodes = archive.latest(), archive.episodes()
    corrected: dict[str, set[str]] = defaultdict(set)
    for key, atom in Corrections.of(archive.corrections()).labels:
        corrected[key].add(str(atom))
    doubts = _doubts(latest, episodes)
    pictures = [
        ReviewedPicture(
            observation,
            caption,
            latest.labels.of(observation.key),
            {
                a: r
                for a, r in doubts[observation.key].items()
                if a not in corrected[observation.key]
            },
            frozenset(corrected[observation.key]),
        )
        for observation, caption in _moments(episodes).items()
    ]
    return sorted(pictures, key=lambda picture: -picture.weight)


def _moments(episodes: tuple[Episode, ...]) -> dict[Observation, str]:
    """Every observation once, with when it was seen first."""
    moments: dict[Observation, str] = {}
    for number, episode in enumerate(episodes, start=1):
        for step, done in enumerate(episode.transitions, start=1):
            begins = f"episode {number}, at the start" if step == 1 else f"before {done.instance}"
            moments.setdefault(done.before, begins)
            how = "succeeded" if done.success else "failed"
            moments.setdefault(done.after, f"episode {number}, after {done.instance} {how}")
    return moments


def _doubts(
    latest: ArchivedIteration, episodes: tuple[Episode, ...]
) -> defaultdict[str, dict[str, str]]:
    """Reasons by observation and atom, the weightiest for each."""
    transitions = [done for episode in episodes for done in episode.transitions]
    found: defaultdict[str, dict[str, str]] = defaultdict(dict)
    for key, atom, reason in (
        *_overruled(latest, transitions),
        *_untouched(latest, transitions),
        *_inconsistent(latest, transitions),
        *_unknown(latest),
    ):
        found[key].setdefault(atom, reason)
    return found


Doubts = Iterator[tuple[str, str, str]]
"""An observation's key, an atom, and why its label is in doubt."""


def _overruled(latest: ArchivedIteration, transitions: list[Transition]) -> Doubts:
    keys = {
        tuple(picture.sha256 for picture in seen.pictures): seen.key
        for done in transitions
        for seen in (done.before, done.after)
    }
    for one in latest.decoding.overruled if latest.decoding else ():
        if one.pictures in keys:
            yield keys[one.pictures], one.atom, OVERRULED


def _untouched(latest: ArchivedIteration, transitions: list[Transition]) -> Doubts:
    for done in transitions:
        before, after = (latest.labels.of(seen.key) for seen in (done.before, done.after))
        for atom, value in before.items():
            changed = {value, after.get(atom)} == {True, False}
            if changed and not set(parse_atom(atom).terms) & set(done.instance.arguments):
                yield done.before.key, atom, UNTOUCHED
                yield done.after.key, atom, UNTOUCHED


def _inconsistent(latest: ArchivedIteration, transitions: list[Transition]) -> Doubts:
    broken = {v.transition for v in latest.certificate.violations}
    broken |= {v.partner for v in latest.certificate.violations if v.partner is not None}
    broken |= {w.transition for one in latest.unresolved for w in one.witnesses}
    for done in (transitions[number] for number in sorted(broken) if number < len(transitions)):
        for seen in (done.before, done.after):
            for atom in latest.labels.of(seen.key):
                terms = parse_atom(atom).terms
                if set(terms) <= set(done.instance.arguments):
                    yield seen.key, atom, INCONSISTENT


def _unknown(latest: ArchivedIteration) -> Doubts:
    for key, labels in latest.labels.rows.items():
        for atom, value in labels.items():
            if value is None:
                yield key, atom, UNKNOWN
