"""Changes that no predicate tells yet (D26): of which successes the model is asked what changed.

First come skills of which all successes seem to change nothing, then what else skills may change.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np

from skillwrapper.grounding import UNKNOWN, AtomSpace
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.lifting import LiftedChange
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.transitions.tables import SkillTable
from skillwrapper.world.skills import SkillInstance

_GROWTH, _LATER, _AGAIN = 1.5, 2.0, 4.0
_ALIKE = 4
"""So many pictures that look alike to the vocabulary are compared with one another."""

_Key = tuple[bytes, LiftedChange]
_Context = tuple[str, LiftedChange, SkillInstance, bytes]
"""A success by its skill, its change, and what held of its arguments before."""


_Success = tuple[bool, bool, int, int, int, _Key]
"""Whether other things held around it than around those that were asked about; whether it is the
first of its episode, if that counts; how seldom it was shown; how much was done since the same was
last done; its number; what it exemplifies: the state if nothing seems to change, else the change.
"""


class UnnoticedChanges:
    """Chooses successes to ask about, more rarely the more was executed.

    A skill of which all successes seem to change nothing is asked about again after "nothing", or
    what is of no use, some times in a row, and then as soon as half as much again was executed: in
    another state and with other objects in view, which may be in its arguments or on them. Of other
    skills, it is asked what else has changed, of any object, for every change that they are known
    to make, until candidates were of no use some times: a machine that comes to a halt may have
    been empty. When twice as much was executed, it is asked again of a success around which other
    things held; of one like those that were asked about, when four times as much was.

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
        executions, news, first = len(recorded), _news(recorded), _first(recorded)
        silent = [of_skill for of_skill in fit.each() if of_skill.unnoticed is not None]
        others = [s for s in fit.each() if s not in silent] if self._everywhere else []
        for of_skill in (*silent, *others):
            name = of_skill.skill
            if executions >= self._next.get(name, 0):
                is_wide = of_skill in silent and self._in_vain[name, True] > 0
                left = self._open(of_skill, news, first, is_wide)
                if of_skill not in silent:
                    if self._in_vain[name, False] >= self._most:
                        continue
                    left = (one for one in left if executions >= self._due(name, one))
                found = max(left, default=None)
                if found is not None:
                    is_wide = is_wide or of_skill not in silent
                    return _question(name, found[4], found[5], wide=is_wide)
        return None

    def _due(self, skill: str, success: _Success) -> float:
        """After how many executions it is time to ask about a success of a telling skill."""
        is_new, change = success[0], success[5][1]
        return (_LATER if is_new else _AGAIN) * self._last.get((skill, change), 0)

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
        if not silent:
            self._last[asked.skill, change] = executions
            self._times[asked.skill, change] += 1
            self._contexts.add(self._context_of[asked.culprit])
        elif nothing:
            self._settled.add((asked.skill, state, asked.wide))

    def _open(
        self, of_skill: SkillFit, news: Mapping[int, int], first: Collection[int], wide: bool
    ) -> Iterator[_Success]:
        """Successes that may be asked about, the best the largest.

        Some things change only the first time, others only later: so every other question is
        rather about the first time in an episode.
        """
        silent = of_skill.unnoticed is not None
        for prediction in of_skill.predictions:
            table = prediction.table
            for group in table.successes:
                change = group.lifting.change
                for row in group.rows[~table.unchanged[group.rows] & ~table.hanging[group.rows]]:
                    number, state = int(table.ids[row]), table.before[row].tobytes()
                    example = (state, change) if silent else (b"", change)
                    changes = silent or table.change[row].any()
                    if changes and (of_skill.skill, example[0], wide) not in self._settled:
                        context = _context(table, int(row), change)
                        self._context_of[number] = context
                        yield (
                            context not in self._contexts,
                            number in first and self._times[of_skill.skill, change] % 2 == 0,
                            -self._shown[number, wide],
                            news[number],
                            number,
                            example,
                        )


def _news(recorded: RecordedTransitions) -> dict[int, int]:
    """For every success what had succeeded since the same was last done in the episode.

    The more, the more there may be for it to change.
    """
    news: dict[int, int] = {}
    last: dict[SkillInstance, int] = {}
    successes, seen = 0, ""
    for number, record in enumerate(recorded.records):
        transition = record.transition
        if transition.before.key != seen:
            last, successes = {}, 0
        seen = transition.after.key
        if transition.success:
            successes += 1
            news[number] = successes - last.get(transition.instance, 0)
            last[transition.instance] = successes
    return news


def _first(recorded: RecordedTransitions) -> frozenset[int]:
    """The successes that were the first of their instance in an episode."""
    found: set[int] = set()
    done: set[SkillInstance] = set()
    seen = ""
    for number, record in enumerate(recorded.records):
        transition = record.transition
        if transition.before.key != seen:
            done.clear()
        seen = transition.after.key
        if transition.success and transition.instance not in done:
            done.add(transition.instance)
            found.add(number)
    return frozenset(found)


def _context(table: SkillTable, row: int, change: LiftedChange) -> _Context:
    instance = table.instances[table.which[row]]
    own = [not {*instance.arguments}.isdisjoint(atom.terms) for atom in table.space.atoms]
    return instance.skill, change, instance, table.before[row][np.array(own, dtype=bool)].tobytes()


def _question(skill: str, number: int, example: _Key, *, wide: bool) -> Inconsistency:
    kind = InconsistencyKind.UNNOTICED
    return Inconsistency(
        kind,
        skill,
        first=number,
        second=None,
        culprit=number,
        identity=(skill, kind, (example[0],), example[1]),
        wide=wide,
    )


class Shelf:
    """Candidates for unnoticed changes that tell no pictures apart which look alike so far.

    Each is looked at again when twice as much was executed.
    """

    def __init__(self) -> None:
        self._kept: dict[Predicate, tuple[Inconsistency, int]] = {}

    def put(self, predicate: Predicate, asked: Inconsistency, executions: int) -> None:
        """Keep a candidate for later."""
        self._kept[predicate] = asked, 2 * executions

    def take(self, executions: int) -> list[tuple[Predicate, Inconsistency]]:
        """Those for which it is time; they are kept no more."""
        due = [(p, asked) for p, (asked, when) in self._kept.items() if executions >= when]
        for predicate, _ in due:
            del self._kept[predicate]
        return due


def tells_more(
    labeller: Labeller,
    vocabulary: Sequence[Predicate],
    asked: Inconsistency,
    candidates: Sequence[Predicate],
) -> set[Predicate]:
    """The candidates that tell pictures apart which are alike to the vocabulary.

    They are looked for among those that look like the ones before and after the success.
    """
    record = labeller.recorded.records[asked.culprit]
    scene = record.scene
    observations = labeller.recorded.observations(scene)
    states = labeller.values(scene, vocabulary)
    alike = []
    for place in dict.fromkeys((record.before, record.after)):
        same = np.flatnonzero((states == states[place]).all(axis=1))
        nearest = [n for n in same.tolist() if n != place][-_ALIKE:]
        alike.append([observations[n] for n in (place, *nearest)])
    seen = [o for group in alike for o in group]
    labeller.truth.prefetch((AtomSpace((p,), scene.objects), seen) for p in candidates)
    telling = set()
    for predicate in candidates:
        space = AtomSpace((predicate,), scene.objects)
        for group in alike:
            labels = labeller.truth.labels(space, group)
            known = (labels != UNKNOWN).all(axis=0)
            if (labels[:, known] != labels[0, known]).any():
                telling.add(predicate)
    return telling
