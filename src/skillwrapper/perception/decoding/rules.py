"""One rule for every role, chosen by description length: how its atoms change along an edge.

An atom persists, is set, is cleared, is set or cleared if a condition holds and else persists, or
changes at rates of its own. What a rule costs is what it takes to say which rule it is, and its
exceptions, all in nats.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial

import numpy as np
from numpy.typing import NDArray

from skillwrapper.perception.decoding.cells import Cells, Role
from skillwrapper.perception.decoding.chains import StepKind
from skillwrapper.perception.decoding.conditions import Conditions
from skillwrapper.perception.decoding.messages import Joint, Transitions
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.decoding.priors import Priors, rate

_KT = 0.5
"""Weight of either outcome before any was seen: Krichevsky and Trofimov's coding of rates."""
_WAYS_TO_CHANGE = math.log(3)
"""To say whether an atom is set, is cleared, or changes at rates of its own."""


class Readiness(StrEnum):
    """How readily a skill is taken to change its arguments, before anything is known."""

    BOLD = "bold"
    """As likely as not."""
    SHY = "shy"
    """No more than anything else."""


class RuleKind(StrEnum):
    """How atoms of a role change."""

    PERSIST = "persist"
    SET = "set"
    CLEAR = "clear"
    FREE = "free"
    IF = "if"


@dataclass(frozen=True, eq=False)
class Rule:
    """A rule.

    Attributes:
        kind: what it says.
        table: (2, 2) the probability of truth after, by the truth of the condition, then of the
            atom before.
        condition: number of the condition among the role's candidates; -1 for none.
        exceptions: how often it is expected to be broken.
        nats: what it costs to name it, and to name its exceptions.
    """

    kind: RuleKind
    table: Floats
    condition: int = -1
    exceptions: float = 0.0
    nats: float = 0.0


class Rules:
    """The rules of all roles, learned again and again.

    Args:
        cells: the cells.
        conditions: finds the variables of conditions.
        priors: what is taken for likely beforehand.
    """

    def __init__(self, cells: Cells, conditions: Conditions, priors: Priors) -> None:
        self._cells, self._conditions, self._priors = cells, conditions, priors
        self._to_name = math.log(max(2, len(cells.roles)))
        self._limit = priors.misread
        self.exception = priors.misread
        self._misread: Floats = np.full(len(cells.predicates), priors.misread)
        self.of_role: list[Rule] = []

    def transitions(self) -> Transitions:
        """The rules, cell by cell."""
        tables = np.array([rule.table for rule in self.of_role]).reshape(-1, 2, 2)
        condition = np.full(len(self._cells.role), -1, dtype=np.intp)
        for number, rule in enumerate(self.of_role):
            if rule.condition >= 0:
                found = self._conditions.variables(number)
                condition[self._cells.slices[number]] = found[:, rule.condition]
        return Transitions(tables[self._cells.role], condition)

    def learn_rates(self, joint: Joint, readiness: Readiness) -> None:
        """Rates of change of every role by itself; seldom, as far as nothing is known."""
        counts = self._counts(joint)
        self.of_role = [self._seldom(n, counts[n], readiness) for n in range(len(counts))]

    def learn(
        self,
        joint: Joint,
        belief: Floats,
        idle: NDArray[np.bool_],
        misread: Floats,
        *,
        free: bool,
    ) -> None:
        """Choose the rule of every role.

        Args:
            joint: what is believed of the cells.
            belief: the probability (variables,) that an atom is true, context included.
            idle: whether a role (roles,) is of a skill of which nothing else is seen to change.
            misread: for every predicate the share of readings that is wrong.
            free: whether a role may change at rates of its own.
        """
        counts = self._counts(joint)
        self._misread = misread
        self.of_role = [
            self._choose(number, counts[number], joint, belief, bool(idle[number]), free)
            for number in range(len(counts))
        ]
        ruled = [n for n, r in enumerate(self.of_role) if r.kind is not RuleKind.FREE]
        broken = sum(self.of_role[n].exceptions for n in ruled)
        covered = float(counts[ruled].sum()) if ruled else 0.0
        # More exceptions than misreadings would leave no reason to overrule a reading.
        self.exception = min(self._limit, rate(broken, covered, self._limit / 10))

    def description(self) -> Floats:
        """What the rules of each predicate (predicates,) cost, in nats."""
        own = [role.predicate for role in self._cells.roles]
        nats = [rule.nats for rule in self.of_role]
        size = len(self._cells.predicates)
        costs = np.bincount(np.array(own, dtype=np.intp), np.array(nats), size)
        return costs.astype(np.float64)

    def _counts(self, joint: Joint) -> Floats:
        """How often (roles, 2, 2) atoms of each role are expected to go from truth to truth."""
        role, roles = self._cells.role, len(self._cells.roles)
        flat = joint.probability.reshape(-1, 4)
        counts = [np.bincount(role, flat[:, k], roles) for k in range(4)]
        return np.stack(counts, axis=1).reshape(-1, 2, 2).astype(np.float64)

    def _choose(
        self,
        number: int,
        counts: Floats,
        joint: Joint,
        belief: Floats,
        idle: bool,
        free: bool,
    ) -> Rule:
        role, total = self._cells.roles[number], float(counts.sum())
        flips = float(counts[0, 1] + counts[1, 0])
        cost = partial(self._cost, role, total)
        persist = self._always(RuleKind.PERSIST, flips)
        if role.kind is StepKind.SAME:
            return persist
        named = 0.0 if idle else self._naming(role)
        change = named + _WAYS_TO_CHANGE
        stay = math.log(2) + _WAYS_TO_CHANGE if idle else 0.0
        found = [
            (cost(flips) + stay, persist),
            *(
                (cost(missed) + change, self._always(kind, missed))
                for kind, missed in (
                    (RuleKind.SET, float(counts[:, 0].sum())),
                    (RuleKind.CLEAR, float(counts[:, 1].sum())),
                )
            ),
        ]
        if free:
            found.append((_coded(counts) + change, _free(counts)))
        best = min(found, key=lambda pair: pair[0])
        if best[1].kind in (RuleKind.PERSIST, RuleKind.FREE):
            best = min(
                (best, *self._conditional(number, joint, belief, named, best[0])),
                key=lambda pair: pair[0],
            )
        return replace(best[1], nats=best[0])

    def _naming(self, role: Role) -> float:
        """What it costs to say that atoms of a role do not persist.

        A skill is there to change its arguments; all else it leaves alone, but for few roles.
        """
        own = role.kind is StepKind.SUCCESS and role.others == 0
        return math.log(2) if own else self._to_name

    def _conditional(
        self, number: int, joint: Joint, belief: Floats, named: float, most: float
    ) -> list[tuple[float, Rule]]:
        """The cheapest rule with a condition, if one can be cheaper than the best without."""
        candidates = self._conditions.candidates(self._cells.roles[number])
        own = self._cells.slices[number]
        total = float(own.stop - own.start)
        cost = partial(self._cost, self._cells.roles[number], total)
        price = named + math.log(4 * max(1, len(candidates)))
        if not candidates or cost(0.0) + price >= most:
            return []
        variables = self._conditions.variables(number)
        holds = np.where(variables >= 0, belief[variables], 0.0)
        flat = joint.probability[own].reshape(-1, 4)
        given = (holds.T @ flat).reshape(-1, 2, 2)  # (candidates, before, after)
        otherwise = flat.sum(axis=0).reshape(2, 2) - given
        options = []
        for wanted, (on, off) in enumerate(((otherwise, given), (given, otherwise))):
            for value in (0, 1):
                broken = on[:, :, 1 - value].sum(axis=1) + off[:, 0, 1] + off[:, 1, 0]
                best = int(broken.argmin())
                options.append((float(broken[best]), best, wanted, value))
        exceptions, condition, wanted, value = min(options)
        table = np.empty((2, 2))
        table[wanted] = value * (1 - self.exception) + (1 - value) * self.exception
        table[1 - wanted] = self.exception, 1 - self.exception
        rule = Rule(RuleKind.IF, table, condition, exceptions)
        return [(cost(exceptions) + price, rule)]

    def _cost(self, role: Role, total: float, exceptions: float) -> float:
        """The nats that so many exceptions among so many cells take.

        One counts for no more than a misreading of the predicate: else it would be taken for one.
        """
        rare = max(self.exception, float(self._misread[role.predicate]))
        return -exceptions * math.log(rare) - (total - exceptions) * math.log(1 - self.exception)

    def _always(self, kind: RuleKind, exceptions: float) -> Rule:
        rare, often = self.exception, 1 - self.exception
        row = {
            RuleKind.PERSIST: (rare, often),
            RuleKind.SET: (often, often),
            RuleKind.CLEAR: (rare, rare),
        }[kind]
        return Rule(kind, np.array([row, row]), exceptions=exceptions)

    def _seldom(self, number: int, counts: Floats, readiness: Readiness) -> Rule:
        """Rates of change that are as low beforehand as the price of naming a change says."""
        bold = readiness is Readiness.BOLD
        price = self._naming(self._cells.roles[number]) if bold else self._to_name
        mean = math.exp(-price)
        up = rate(float(counts[0, 1]), float(counts[0].sum()), mean)
        down = rate(float(counts[1, 0]), float(counts[1].sum()), mean)
        row = (up, 1 - down)
        return Rule(RuleKind.FREE, np.array([row, row]))


def _coded(counts: Floats) -> float:
    """The nats of coding changes at two unknown rates."""
    rows = counts.tolist()
    return -sum(_log_beta(a + _KT, b + _KT) - _log_beta(_KT, _KT) for a, b in rows)


def _free(counts: Floats) -> Rule:
    up, down = (
        (c + _KT) / (n + 2 * _KT)
        for c, n in zip((counts[0, 1], counts[1, 0]), counts.sum(axis=1), strict=True)
    )
    row = (up, 1 - down)
    return Rule(RuleKind.FREE, np.array([row, row]))


def _log_beta(one: float, other: float) -> float:
    return math.lgamma(one) + math.lgamma(other) - math.lgamma(one + other)
