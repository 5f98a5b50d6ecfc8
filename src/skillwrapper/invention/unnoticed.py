"""Changes that no predicate tells yet (D26): of which successes the model is asked what changed.

First come skills of which all successes seem to change nothing, then what else skills may change.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from skillwrapper.grounding import TRUE, Labels
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.transitions.lifting import LiftedChange
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.transitions.tables import Group
from skillwrapper.world.skills import SkillInstance

_WAIT, _GROWTH, _LATER, _AGAIN = 4 / 3, 1.5, 2.0, 4.0
_Context = tuple[str, LiftedChange, SkillInstance, frozenset[Atom]]
"""A success by its skill, its change, its instance, and what held nearby before."""


class _Success(NamedTuple):
    """A success that may be asked about; of two, the larger one is the better.

    Attributes:
        is_new: whether other things held around it than around those that were asked about.
        is_first: whether it is the first of its instance in an episode, if that counts.
        seldom: how seldom it was shown.
        news: how much was done since the same was last done.
        number: its number, which no other one has.
        state: what it exemplifies if nothing seems to change; else empty.
        change: what it is known to change.
        context: what it was like.
    """

    is_new: bool
    is_first: bool
    seldom: int
    news: int
    number: int
    state: bytes
    change: LiftedChange
    context: _Context


class UnnoticedChanges:
    """Chooses successes to ask about, more rarely the more was executed.

    A skill of which all successes seem to change nothing is asked about again after "nothing", or
    what is of no use, some times in a row, and then as soon as half as much again was executed: in
    another state and with other objects in view, which may be in its arguments or on them. Before
    that, once in an iteration, of a success around which other things held. Of other skills, it is
    asked what else has changed, of any object, for every change that they are known to make, also
    where that is none, until candidates were of no use some times: a machine that comes to a halt
    may have been empty. When twice as much was executed, it is asked again of a success around
    which other things held; of one like those that were asked about, when four times as much was.

    Args:
        most: questions in a row about a skill that seems to change nothing; questions in vain about
            another one.
        everywhere: whether to ask also of skills that are known to change something.
    """

    def __init__(self, most: int, *, everywhere: bool) -> None:
        self._most, self._everywhere = most, everywhere
        self._in_vain: Counter[tuple[str, bool]] = Counter()
        self._next: dict[str, float] = {}
        self._shown: Counter[tuple[int, bool]] = Counter()
        self._last: dict[tuple[str, LiftedChange], int] = {}
        self._asked: Counter[str] = Counter()
        self._times: Counter[tuple[str, LiftedChange]] = Counter()
        self._contexts: set[_Context] = set()
        self._context_of: dict[int, _Context] = {}
        self._settled: set[tuple[str, object, bool]] = set()

    def next(self, fit: Fit, recorded: RecordedTransitions) -> Inconsistency | None:
        """What to ask about next; None if there is nothing.

        Args:
            fit: what is learned.
            recorded: all transitions so far.
        """
        executions, news = len(recorded), _news(recorded)
        silent = [of_skill for of_skill in fit.each() if of_skill.unnoticed is not None]
        others = [s for s in fit.each() if s not in silent] if self._everywhere else []
        for of_skill in (*silent, *others):
            name = of_skill.skill
            is_wide = of_skill in silent and self._in_vain[name, True] > 0
            left = self._open(of_skill, news, is_wide)
            if of_skill not in silent:
                may_ask = self._in_vain[name, False] < self._most
                left = (one for one in left if may_ask and executions >= self._due(name, one))
            elif executions < self._next.get(name, 0):
                may_ask = executions > self._asked[name]
                left = (one for one in left if may_ask and one.is_new)
            found = max(left, default=None)
            if found is not None:
                self._context_of[found.number] = found.context
                return _question(name, found, wide=is_wide or of_skill not in silent)
        return None

    def _due(self, skill: str, success: _Success) -> float:
        """After how many executions it is time to ask about a success of a telling skill."""
        last = self._last.get((skill, success.change), 0)
        return (_LATER if success.is_new else _AGAIN) * last

    def note(
        self, asked: Inconsistency, executions: int, *, nothing: bool, in_vain: bool, silent: bool
    ) -> None:
        """Take note of a question.

        Args:
            asked: what was asked.
            executions: how many there are so far.
            nothing: whether the answer was that nothing has changed.
            in_vain: whether no candidate was of use.
            silent: whether all successes of the skill seemed to change nothing.
        """
        self._shown[asked.culprit, asked.wide] += 1
        self._in_vain[asked.skill, silent] += in_vain and (silent or not nothing)
        if silent and in_vain and self._in_vain[asked.skill, silent] % self._most == 0:
            self._next[asked.skill] = _GROWTH * executions
        (state,), change = asked.identity[2:]
        self._asked[asked.skill] = executions
        self._times[asked.skill, change] += 1
        self._contexts.add(self._context_of[asked.culprit])
        if not silent:
            self._last[asked.skill, change] = executions
        elif nothing:
            self._settled.add((asked.skill, state, asked.wide))

    def _open(
        self, of_skill: SkillFit, news: Mapping[int, _News], wide: bool
    ) -> Iterator[_Success]:
        """Successes that may be asked about, the best the largest.

        Some things change only the first time, others only later: so every other question is
        rather about the first time in an episode.
        """
        silent, name = of_skill.unnoticed is not None, of_skill.skill
        for prediction in of_skill.predictions:
            table = prediction.table
            for group in table.successes:
                change, near = group.lifting.change, _Nearness(group)
                may_be_first = self._times[name, change] % 2 == 0
                for row in group.rows[~table.unchanged[group.rows] & ~table.hanging[group.rows]]:
                    number, before = int(table.ids[row]), table.before[row]
                    state = before.tobytes() if silent else b""
                    if (name, state, wide) not in self._settled:
                        context = name, change, group.instance, near.seen(before)
                        yield _Success(
                            context not in self._contexts,
                            may_be_first and news[number].is_first,
                            -self._shown[number, wide],
                            news[number].successes,
                            number,
                            state,
                            change,
                            context,
                        )


class _News(NamedTuple):
    """What had succeeded in an episode since the same was last done: the more, the more there may
    be for it to change.

    Attributes:
        successes: how many.
        is_first: whether the same was never done before in the episode.
    """

    successes: int
    is_first: bool


def _news(recorded: RecordedTransitions) -> dict[int, _News]:
    """For every success what had succeeded since the same was last done in the episode."""
    news: dict[int, _News] = {}
    last: dict[SkillInstance, int] = {}
    successes, seen = 0, ""
    for number, record in enumerate(recorded.records):
        transition = record.transition
        if transition.before.key != seen:
            last, successes = {}, 0
        seen = transition.after.key
        if transition.success:
            successes += 1
            before = last.get(transition.instance, 0)
            news[number] = _News(successes - before, is_first=before == 0)
            last[transition.instance] = successes
    return news


class _Nearness:
    """What is near the arguments of a skill instance: what stands in a relation with them.

    Args:
        group: transitions of the instance.
    """

    def __init__(self, group: Group) -> None:
        self._space = group.table.space
        arguments = self._space.index.numbers(group.instance.arguments)
        self._own = self._space.mentions[:, arguments].any(axis=1)

    def seen(self, before: Labels) -> frozenset[Atom]:
        """What holds of the arguments, and of what they stand in a relation with (atoms,)."""
        holds = before == TRUE
        near = self._space.mentions[self._own & holds].any(axis=0)
        close = self._own | self._space.mentions[:, near].any(axis=1)
        return frozenset(self._space.atoms[n] for n in np.flatnonzero(close & holds))


def _question(skill: str, success: _Success, *, wide: bool) -> Inconsistency:
    kind, number = InconsistencyKind.UNNOTICED, success.number
    return Inconsistency(
        kind,
        skill,
        first=number,
        second=None,
        culprit=number,
        identity=(skill, kind, (success.state,), success.change),
        wide=wide,
    )


class Shelf:
    """Candidates for unnoticed changes that tell no pictures apart which look alike so far.

    Each is looked at again when a third more was executed.
    """

    def __init__(self) -> None:
        self._kept: dict[Predicate, tuple[Inconsistency, float]] = {}

    def put(self, predicate: Predicate, asked: Inconsistency, executions: int) -> None:
        """Keep a candidate for later."""
        self._kept[predicate] = asked, _WAIT * executions

    def take(self, executions: int) -> list[tuple[Predicate, Inconsistency]]:
        """Those for which it is time; they are kept no more."""
        due = [(p, asked) for p, (asked, when) in self._kept.items() if executions >= when]
        for predicate, _ in due:
            del self._kept[predicate]
        return due
