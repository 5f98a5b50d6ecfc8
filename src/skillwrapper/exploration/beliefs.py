"""What the learned model lets expect of skill instances in states: how likely, and how new."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.analogies import Analogies, newness
from skillwrapper.exploration.novelty import Earlier, Features, see_features
from skillwrapper.exploration.promise import promise_of
from skillwrapper.grounding import FALSE, TRUE, AtomSpace, Labels
from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.predictions import attempts_of
from skillwrapper.learning.version_space import VersionSpace, version_spaces
from skillwrapper.transitions.tables import SkillTable
from skillwrapper.world.skills import SkillInstance

ArgumentTypes = tuple[tuple[str, ...], ...]
"""The types of the arguments of a skill instance."""
_AMONG_ALIKE = 0.5
"""What is new among attempts that are alike counts so much beside what is new altogether."""


@dataclass(frozen=True, eq=False)
class Expectations:
    """Of skill instances in states, each (states, instances).

    Attributes:
        success: how likely the instance works.
        alone: how new it is beside failures: something is seen that none of them saw, 0 to 1; if
            the skill never succeeded, also beside those that were alike by what other skills need.
        pairs: the same by pairs of what is seen.
        promise: how promising it is if the skill never succeeded, or not with arguments of such
            types, but for a factor; else 0.
        alone_done: how new it is beside successes.
        pairs_done: the same by pairs.
        untried: whether this very instance was never tried where the same was seen, 0 or 1; what
            tells its objects from others may have no name yet.
        unlike: how new the whole state is beside those in which the instance succeeded, by pairs of
            what holds in it.
        elsewhere: the same beside those in which it failed.
    """

    success: NDArray[np.float64]
    alone: NDArray[np.float64]
    pairs: NDArray[np.float64]
    promise: NDArray[np.float64]
    alone_done: NDArray[np.float64]
    pairs_done: NDArray[np.float64]
    untried: NDArray[np.float64]
    unlike: NDArray[np.float64]
    elsewhere: NDArray[np.float64]


_FIGURES = len(fields(Expectations))


class SkillBeliefs:
    """What is believed of one skill after one fit; remembers what it worked out.

    Args:
        fit: what was learned.
        skill: name of the skill.
        doubt: how likely a failure has a cause that no predicate speaks of.
        others: of the operators of other skills, if this one never succeeded.
    """

    def __init__(
        self, fit: Fit, skill: str, doubt: float, others: Sequence[VersionSpace] = ()
    ) -> None:
        self._types = fit.domain.types.names
        self.of_skill: SkillFit = fit.skill(skill)
        self.spaces: tuple[VersionSpace, ...] = version_spaces(fit, skill, doubt=doubt)
        seen = [
            see_features(table.space, attempts_of(table), self._types) for table in self._tables
        ]
        self._failures = self._of(seen, success=False)
        self._successes = self._of(seen, success=True)
        self._tried = frozenset(self._attempted(seen))
        self._worked = frozenset(self._kinds(success=True))
        self._failed = self._kinds(success=False)
        arity = len(fit.domain.skill_by_name[skill].parameters)
        self._analogies = Analogies(others, arity)
        self._siblings = Analogies(self.spaces, arity, in_order=True)
        self._failed_like_siblings = Counter(self._kinds_that_failed_like_siblings())
        self._failed_members = self._members_that_failed()
        self._held: dict[tuple[AtomSpace, SkillInstance, bool], Earlier] = {}
        self._known: dict[tuple[AtomSpace, bytes], NDArray[np.float64]] = {}

    def expect(
        self, space: AtomSpace, states: Labels, instances: list[SkillInstance]
    ) -> NDArray[np.float64]:
        """The figures of ``Expectations``, in its order (figures, states, instances).

        Args:
            space: the ground atoms of the whole vocabulary in the scene.
            states: abstract states (states, atoms).
            instances: all instances of the skill in the scene.
        """
        keys = [(space, state.tobytes()) for state in states]
        new = [row for row, key in enumerate(keys) if key not in self._known]
        if new:
            found = self._work_out(space, states[new], instances)
            for place, row in enumerate(new):
                self._known[keys[row]] = found[:, place]
        return np.stack([self._known[key] for key in keys], axis=1)

    def _work_out(
        self, space: AtomSpace, states: Labels, instances: list[SkillInstance]
    ) -> NDArray[np.float64]:
        arguments = np.array([space.index.numbers(i.arguments) for i in instances], dtype=np.intp)
        arguments = arguments.reshape(len(instances), -1)
        attempts = Attempts.everywhere(AbstractStates(states), arguments)
        failing = np.ones(len(attempts))
        for version_space in self.spaces:
            failing *= 1 - version_space.success_probability(space, attempts)
        success = np.where(failing < 1, 1 - failing, self._like_siblings(space, attempts))
        figures = [success, *self._novelty(space, states, attempts, instances)]
        return np.stack(figures).reshape(_FIGURES, len(states), len(instances))

    def _novelty(
        self, space: AtomSpace, states: Labels, attempts: Attempts, instances: list[SkillInstance]
    ) -> list[NDArray[np.float64]]:
        """Beside failures and beside successes; all is new beside nothing."""
        if not self._tables:
            return [np.ones(len(attempts))] * (_FIGURES - 1)
        useful = AtomSpace(self._tables[0].space.predicates, space.objects)
        labels = states[:, [space.column[atom] for atom in useful.atoms]]
        looked_up = AbstractStates(labels)
        useful_attempts = Attempts(looked_up, attempts.arguments, attempts.rows, attempts.which)
        seen = see_features(useful, useful_attempts, self._types)
        failed, done = (
            of.novelty(seen) for of in (self._earlier_failures, self._earlier_successes)
        )
        members = self._analogies.members(space, attempts)
        alike = newness(seen, members, self._failures, self._failed_members)
        alone = np.maximum(failed.alone, _AMONG_ALIKE * alike)
        promise = self._promise(space, seen, attempts)
        untried = self._untried(seen, attempts, instances)
        unlike, elsewhere = (
            self._unlike(useful, labels, instances, success)[attempts.rows, attempts.which]
            for success in (True, False)
        )
        return [
            alone, failed.pairs, promise, done.alone, done.pairs, untried, unlike, elsewhere
        ]  # fmt: skip

    def _like_siblings(self, space: AtomSpace, attempts: Attempts) -> NDArray[np.float64]:
        """How likely attempts work, with arguments of types that never worked (attempts,).

        What the skill changes may be another thing then, so that no operator can be bound. So where
        all holds that it seems to need of arguments of other types, it is as likely as not, and
        less with every failure there, by the rule of succession.
        """
        kinds = _types_of(space, attempts)
        likely = [
            0.0 if kind in self._worked else 1 / (2 + self._failed_like_siblings[kind])
            for kind in kinds
        ]
        found = np.array(likely)[attempts.which] if likely else np.zeros(len(attempts))
        if found.any():
            found *= self._siblings.members(space, attempts).any(axis=1)
        return found

    def _kinds_that_failed_like_siblings(self) -> Iterator[ArgumentTypes]:
        """The types of arguments, once for every failure where all held that others need."""
        for table in self._tables:
            like = self._siblings.members(table.space, attempts_of(table)).any(axis=1)
            for row in np.flatnonzero(like & ~table.success).tolist():
                yield table.argument_types(row)

    def _untried(
        self, seen: Features, attempts: Attempts, instances: list[SkillInstance]
    ) -> NDArray[np.float64]:
        """Whether an instance was never tried where it saw the same (attempts,)."""
        which = attempts.which.tolist()
        keys = zip(
            (instances[n] for n in which), map(bytes, np.packbits(seen, axis=1)), strict=True
        )
        return np.array([key not in self._tried for key in keys], dtype=np.float64)

    def _unlike(
        self, space: AtomSpace, states: Labels, instances: list[SkillInstance], success: bool
    ) -> NDArray[np.float64]:
        """Beside all that held where the instance succeeded, or failed (states, instances)."""
        found, seen = np.ones((len(states), len(instances))), _values(states)
        for number, instance in enumerate(instances):
            key = space, instance, success
            if key not in self._held:
                self._held[key] = Earlier(_values(self._held_where(space, instance, success)))
            found[:, number] = self._held[key].novelty(seen).pairs
        return found

    def _held_where(self, space: AtomSpace, instance: SkillInstance, success: bool) -> Labels:
        """The states (states, atoms) in which the instance succeeded, or failed."""
        rows = [
            table.before[_attempts_at(table, instance, success)]
            for table in self._tables
            if table.space == space
        ]
        return np.vstack([np.zeros((0, len(space.atoms)), dtype=np.int8), *rows])

    def _members_that_failed(self) -> NDArray[np.bool_]:
        """Of which families earlier failures were (failures, families)."""
        found = [
            self._analogies.members(table.space, attempts_of(table))[~table.success]
            for table in self._tables
        ]
        return np.vstack(found) if found else np.zeros((0, 0), dtype=bool)

    def _promise(self, space: AtomSpace, seen: Features, attempts: Attempts) -> NDArray[np.float64]:
        """Of attempts at the skill, or with such types, that never succeeded (attempts,)."""
        if not self.of_skill.operators:
            return promise_of(seen, self._failures)
        found = np.zeros(len(seen))
        kinds = _types_of(space, attempts)
        for kind in dict.fromkeys(kinds):
            if kind not in self._worked:
                own = np.array([k == kind for k in kinds], dtype=bool)[attempts.which]
                rows = [n for n, k in enumerate(self._failed) if k == kind]
                found[own] = promise_of(seen[own], self._failures[rows])
        return found

    @cached_property
    def _earlier_failures(self) -> Earlier:
        return Earlier(self._failures)

    @cached_property
    def _earlier_successes(self) -> Earlier:
        return Earlier(self._successes)

    @cached_property
    def _tables(self) -> list[SkillTable]:
        return [prediction.table for prediction in self.of_skill.predictions]

    def _kinds(self, *, success: bool) -> list[ArgumentTypes]:
        """The types of the arguments of earlier attempts (attempts,), in the order of ``_of``."""
        return [
            table.argument_types(row)
            for table in self._tables
            for row in np.flatnonzero(table.success == success).tolist()
        ]

    def _attempted(self, seen: list[Features]) -> Iterator[tuple[SkillInstance, bytes]]:
        """Every instance that was tried, with what it saw."""
        for table, own in zip(self._tables, seen, strict=True):
            for number, row in zip(table.which.tolist(), np.packbits(own, axis=1), strict=True):
                yield table.instances[number], bytes(row)

    def _of(self, seen: list[Features], *, success: bool) -> Features:
        """What earlier attempts saw (attempts, features)."""
        tables = zip(self._tables, seen, strict=True)
        found = [own[table.success == success] for table, own in tables]
        return np.vstack(found) if found else np.zeros((0, 0), dtype=bool)


def _types_of(space: AtomSpace, attempts: Attempts) -> list[ArgumentTypes]:
    """The types of the arguments of every skill instance (instances,)."""
    return [tuple(space.objects[n].types for n in own) for own in attempts.arguments.tolist()]


def _values(states: Labels) -> Features:
    """What holds and what does not in states (states, twice the atoms)."""
    return np.hstack([states == TRUE, states == FALSE])


def _attempts_at(table: SkillTable, instance: SkillInstance, success: bool) -> NDArray[np.bool_]:
    """The attempts at an instance that succeeded, or failed (n,)."""
    own = [number for number, other in enumerate(table.instances) if other == instance]
    found: NDArray[np.bool_] = (table.success == success) & np.isin(table.which, own)
    return found


class Beliefs:
    """What is believed of all skills; what did not change is not worked out again."""

    def __init__(self) -> None:
        self._skills: dict[str, tuple[object, SkillBeliefs]] = {}

    def of_skill(self, fit: Fit, skill: str, doubt: float) -> SkillBeliefs:
        """What is believed of a skill."""
        others = () if fit.skill(skill).operators else self._spaces_of_all(fit, doubt)
        key = (id(fit.skill(skill)), fit.predicates, doubt, others)
        if skill not in self._skills or self._skills[skill][0] != key:
            self._skills[skill] = (key, SkillBeliefs(fit, skill, doubt, others))
        return self._skills[skill][1]

    def _spaces_of_all(self, fit: Fit, doubt: float) -> tuple[VersionSpace, ...]:
        known = [s.skill for s in fit.each() if s.operators]
        return tuple(space for name in known for space in self.of_skill(fit, name, doubt).spaces)

    def expect(
        self,
        fit: Fit,
        space: AtomSpace,
        states: Labels,
        instances: tuple[SkillInstance, ...],
        doubt: float,
    ) -> Expectations:
        """What to expect of all instances of a scene in some states (states, atoms)."""
        figures = np.zeros((_FIGURES, len(states), len(instances)))
        for skill in fit.domain.skills:
            numbers = [n for n, i in enumerate(instances) if i.skill == skill.name]
            if numbers:
                own = [instances[n] for n in numbers]
                beliefs = self.of_skill(fit, skill.name, doubt)
                figures[:, :, numbers] = beliefs.expect(space, states, own)
        return Expectations(*figures)
