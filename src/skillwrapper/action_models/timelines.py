"""What states that no trace gives must have been, and what that says of the actions between them.

An action changes nothing but what its arguments spell, as everywhere here; and what it does to a
lifted atom is taken to be always the same: it adds it, deletes it, or keeps it. So every ground
atom of a trace is a line of its own, of values with touches between them. What is known before and
after a touch narrows what the action may do, and what it may do tells values that are not known,
forwards and backwards, until nothing new follows. Nothing is guessed: what has two explanations
stays unknown. An atom to which an action does now this, now that, tells nothing of any value.
"""

from __future__ import annotations

import itertools
from bisect import bisect_left
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from skillwrapper.action_models.partial_traces import PartialState, PartialTrace
from skillwrapper.action_models.views import UNKNOWN_BIT, ActionViews, View, ViewTable, some

_ADDS, _DELETES, _KEEPS = 1, 2, 4
_ANYTHING = _ADDS | _DELETES | _KEEPS

_EXPLAINED_BY = {
    (False, True): _ADDS,
    (True, False): _DELETES,
    (True, True): _ADDS | _KEEPS,
    (False, False): _DELETES | _KEEPS,
    (None, True): _ADDS | _KEEPS,
    (None, False): _DELETES | _KEEPS,
}
"""What an action may have done, by an atom's value before and after it."""

Value = bool | None
"""Whether an atom is true; None for unknown."""


@dataclass(frozen=True)
class Filled:
    """What traces show once what follows is filled in.

    Attributes:
        views: of every attempt, by action.
        undecided: the numbers of the atoms of which it is open what an action, by name, does to
            them.
    """

    views: Mapping[str, Sequence[View]]
    undecided: Mapping[str, Sequence[int]]


def fill(
    traces: Sequence[PartialTrace],
    views: Mapping[str, ActionViews],
    tables: Mapping[str, ViewTable],
) -> Filled:
    """Fill in what follows in traces, with what complete steps say of the actions.

    Args:
        traces: the traces.
        views: of every action.
        tables: the views of complete steps.
    """
    fates = _Fates(tables)
    while True:
        lines = [_Lines(trace, views) for trace in traces]
        while _spread_all(lines, fates):
            pass
        if not fates.forget():
            break
    found: dict[str, list[View]] = defaultdict(list)
    for own in lines:
        for name, view in own.views(views):
            found[name].append(view)
    return Filled(found, {name: fates.undecided(name) for name in found})


def _spread_all(lines: Sequence[_Lines], fates: _Fates) -> bool:
    """Once through all lines; whether anything new was found."""
    news = False
    for own in lines:
        for line in own.of_atom.values():
            news |= line.spread(fates)
    return news


class _Fates:
    """What every action may do to every lifted atom, for all that is known.

    Args:
        tables: the views of complete steps, by action.
    """

    def __init__(self, tables: Mapping[str, ViewTable]) -> None:
        self._seen = {name: _seen(table) for name, table in tables.items()}
        self._varies = {(a, n) for a, own in self._seen.items() for n, x in enumerate(own) if not x}
        self._contradicted: set[tuple[str, int]] = set()
        self._left = {name: list(own) for name, own in self._seen.items()}

    def of(self, action: str, number: int) -> int:
        """What is left for an atom."""
        if (action, number) in self._varies:
            return _ANYTHING
        return self._left[action][number]

    def narrow(self, action: str, number: int, explained_by: int) -> bool:
        """Leave only what explains something; whether this is news."""
        before = self._left[action][number]
        after = before & explained_by
        if not after:
            self._contradicted.add((action, number))
        if not after or after == before or (action, number) in self._varies:
            return False
        self._left[action][number] = after
        return True

    def undecided(self, action: str) -> list[int]:
        """The numbers of the atoms for which more than one thing is left."""
        numbers = range(len(self._left[action]))
        return [n for n in numbers if self.of(action, n) not in (_ADDS, _DELETES, _KEEPS)]

    def forget(self) -> bool:
        """Start anew without trust in what turned out to vary; whether there was any."""
        news = self._contradicted - self._varies
        self._varies |= news
        if news:
            self._left = {name: list(own) for name, own in self._seen.items()}
        return bool(news)


def _seen(table: ViewTable) -> list[int]:
    """What views leave for every atom; 0 if it varies."""
    done, alone = table.success, table.alone[table.success]
    before, after = table.before[done] & alone, table.after[done] & alone
    not_before, not_after = table.false_before[done] & alone, table.false_after[done] & alone
    shown = {
        _ADDS: some(not_before & after),
        _DELETES: some(before & not_after),
        _ADDS | _KEEPS: some(after),
        _DELETES | _KEEPS: some(not_after),
    }
    left = [_ANYTHING] * before.shape[1]
    for explained_by, own in shown.items():
        left = [x & explained_by if y else x for x, y in zip(left, own.tolist(), strict=True)]
    return left


@dataclass
class _Line:
    """One ground atom in one trace.

    Attributes:
        values: what it is before the first touch, between touches, and after the last.
        times: the number of the attempt that each touch is.
        touches: the action, and the numbers of its atoms that spell this one.
    """

    values: list[Value] = field(default_factory=lambda: [None])
    times: list[int] = field(default_factory=list)
    touches: list[tuple[str, Sequence[int]]] = field(default_factory=list)

    def touch(self, time: int, action: str, numbers: Sequence[int]) -> None:
        """An attempt touches it."""
        self.values.append(None)
        self.times.append(time)
        self.touches.append((action, numbers))

    def at(self, time: int) -> Value:
        """What it is before an attempt."""
        return self.values[bisect_left(self.times, time)]

    def observe(self, time: int, value: Value) -> None:
        """What it was seen to be before an attempt."""
        if value is not None:
            self.values[bisect_left(self.times, time)] = value

    def spread(self, fates: _Fates) -> bool:
        """Once forwards and once backwards; whether anything new was found."""
        order, news = range(len(self.touches)), False
        for number in itertools.chain(order, reversed(order)):
            news |= self._pass(number, fates)
        return news

    def _pass(self, number: int, fates: _Fates) -> bool:
        action, numbers = self.touches[number]
        before, after = self.values[number : number + 2]
        news = False
        if after is not None and len(numbers) == 1:
            news = fates.narrow(action, numbers[0], _EXPLAINED_BY[before, after])
        left = _together([fates.of(action, n) for n in numbers])
        if after is None:
            self.values[number + 1] = _after(before, left)
        elif before is None:
            self.values[number] = _before(after, left)
        return news or self.values[number : number + 2] != [before, after]


def _together(left: Sequence[int]) -> int:
    """What may become of an atom that several lifted ones spell; an addition counts."""
    if len(left) == 1:
        return left[0]
    found = _ADDS if any(x & _ADDS for x in left) else 0
    if all(x & ~_ADDS for x in left):
        found |= _DELETES if any(x & _DELETES for x in left) else 0
        found |= _KEEPS if all(x & _KEEPS for x in left) else 0
    return found


def _after(before: Value, left: int) -> Value:
    """What an atom is after an action, if only one thing is possible."""
    possible: set[Value] = set()
    possible |= {True} if left & _ADDS else set()
    possible |= {False} if left & _DELETES else set()
    possible |= {before} if left & _KEEPS else set()
    return possible.pop() if len(possible) == 1 else None


def _before(after: bool, left: int) -> Value:
    """What an atom was before an action, if only one thing is possible."""
    if left & (_ADDS if after else _DELETES):
        return None
    return after


class _Lines:
    """The lines of all atoms that the arguments of a trace spell.

    Args:
        trace: the trace.
        views: of every action.

    Attributes:
        of_atom: the lines.
    """

    def __init__(self, trace: PartialTrace, views: Mapping[str, ActionViews]) -> None:
        self._trace = trace
        self.of_atom: dict[str, _Line] = defaultdict(_Line)
        for time, attempt in enumerate(trace.attempts):
            numbers: dict[str, list[int]] = defaultdict(list)
            for number, atom in enumerate(views[attempt.action].spell(attempt.arguments)):
                numbers[atom].append(number)
            for atom, own in numbers.items():
                line = self.of_atom[atom]
                if attempt.success:
                    line.touch(time, attempt.action, own)
        for time, state in enumerate(trace.states):
            self._observe(time, state)

    def _observe(self, time: int, state: PartialState) -> None:
        atoms: Iterable[str] = self.of_atom if state.is_complete else state.atoms
        for atom in atoms:
            if atom in self.of_atom:
                self.of_atom[atom].observe(time, state.holds(atom))

    def views(self, views: Mapping[str, ActionViews]) -> Iterator[tuple[str, View]]:
        """What is known of every attempt, with the name of its action."""
        for time, attempt in enumerate(self._trace.attempts):
            own = views[attempt.action]
            lines = [self.of_atom[atom] for atom in own.spell(attempt.arguments)]
            before = _bits([line.at(time) for line in lines])
            after = _bits([line.at(time + 1) for line in lines]) if attempt.success else before
            yield attempt.action, own.view(attempt.arguments, before, after, attempt.success)


def _bits(values: Iterable[Value]) -> bytes:
    return bytes(UNKNOWN_BIT if value is None else value for value in values)
