"""An episode as a strip of pictures with the truth values below them (the paper's sequences)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from skillwrapper.runs.archive import RecordedLabels
from skillwrapper.world.episode import Episode
from skillwrapper.world.observation import Observation

_COLUMNS = 7


@dataclass(frozen=True)
class Moment:
    """What was seen at one time, and what led there.

    Attributes:
        pictures: SHA-256 of the pictures.
        key: of the observation.
        skill: what was done; empty for the start.
        success: whether that succeeded.
        failed: what was tried in vain since the moment before, and changed nothing.
    """

    pictures: tuple[str, ...]
    key: str
    skill: str
    success: bool
    failed: tuple[str, ...]


@dataclass(frozen=True)
class Cell:
    """A truth value under a picture.

    Attributes:
        value: True, False, or None for unknown; as decoded, where labels are.
        changed: whether it is known and another one than the last known before.
        read: what was read, if decoding overrules it; else None.
        wrong: whether the value is not the truth, where that is known.
    """

    value: bool | None
    changed: bool
    read: bool | None = None
    wrong: bool = False


@dataclass(frozen=True)
class Strip:
    """As many moments as fit side by side.

    Attributes:
        moments: from left to right.
        rows: for every atom that varies in the episode, a cell for every moment.
    """

    moments: tuple[Moment, ...]
    rows: tuple[tuple[str, tuple[Cell, ...]], ...]


@dataclass(frozen=True)
class EpisodeStrips:
    """A whole episode.

    Attributes:
        number: of the episode.
        strips: one under the other.
        changes: how many truth values changed.
        always: atoms that were true all the time.
        never: atoms that were false all the time.
        last_failed: what was tried in vain at the end.
    """

    number: int
    strips: tuple[Strip, ...]
    changes: int
    always: tuple[str, ...]
    never: tuple[str, ...]
    last_failed: tuple[str, ...]

    @property
    def length(self) -> int:
        """How many different moments there are."""
        return sum(len(strip.moments) for strip in self.strips)


@dataclass(frozen=True)
class Beyond:
    """What is known beyond readings.

    Attributes:
        overruled: readings that decoding takes for mistakes: the key of an observation, an atom.
        truth: true labels; None where nobody knows them.
    """

    overruled: frozenset[tuple[str, str]] = frozenset()
    truth: RecordedLabels | None = None


NOTHING = Beyond()


def lay_out(
    number: int, episode: Episode, labels: RecordedLabels, beyond: Beyond = NOTHING
) -> EpisodeStrips:
    """Strips of an episode, with what varies in it, or was read wrongly.

    Args:
        number: of the iteration.
        episode: what was executed.
        labels: what was read.
        beyond: what is known besides.
    """
    moments, last_failed = _moments(episode)
    values = [labels.of(moment.key) for moment in moments]
    atoms = tuple(dict.fromkeys(atom for row in values for atom in row))
    columns = {atom: tuple(row.get(atom) for row in values) for atom in atoms}
    varying = {
        atom: _cells(atom, c, moments, beyond)
        for atom, c in columns.items()
        if len(set(c)) > 1 or None in c
    }
    strips = [
        Strip(
            tuple(moments[start : start + _COLUMNS]),
            tuple((atom, cells[start : start + _COLUMNS]) for atom, cells in varying.items()),
        )
        for start in range(0, len(moments), _COLUMNS)
    ]
    return EpisodeStrips(
        number,
        tuple(strips),
        sum(cell.changed for cells in varying.values() for cell in cells),
        tuple(atom for atom, c in columns.items() if set(c) == {True}),
        tuple(atom for atom, c in columns.items() if set(c) == {False}),
        last_failed,
    )


def _moments(episode: Episode) -> tuple[list[Moment], tuple[str, ...]]:
    """The moments at which something else is seen, and what failed after the last one."""
    if not episode.transitions:
        return [], ()
    start = episode.transitions[0].before
    moments = [Moment(_shas(start), start.key, "", True, ())]
    failed: list[str] = []
    for transition in episode.transitions:
        if not transition.success and transition.after.key == transition.before.key:
            failed.append(str(transition.instance))
            continue
        after, skill = transition.after, str(transition.instance)
        moments.append(Moment(_shas(after), after.key, skill, transition.success, tuple(failed)))
        failed = []
    return moments, tuple(failed)


def _cells(
    atom: str, column: Sequence[bool | None], moments: Sequence[Moment], beyond: Beyond
) -> tuple[Cell, ...]:
    """Cells of one atom; an unknown value is no change, what follows it may be one."""
    cells: list[Cell] = []
    last: bool | None = None
    for read, moment in zip(column, moments, strict=True):
        overruled = read is not None and (moment.key, atom) in beyond.overruled
        value = not read if overruled else read
        true = beyond.truth.of(moment.key).get(atom) if beyond.truth is not None else None
        changed = None not in (value, last) and value is not last
        wrong = None not in (value, true) and value is not true
        cells.append(Cell(value, changed, read if overruled else None, wrong))
        last = last if value is None else value
    return tuple(cells)


def _shas(observation: Observation) -> tuple[str, ...]:
    return tuple(picture.sha256 for picture in observation.pictures)
