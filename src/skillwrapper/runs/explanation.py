"""Why an operator of a run is as it is: the transitions and pictures that its literals rest on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import product

from skillwrapper.errors import UnknownNameError
from skillwrapper.grounding import FALSE, TRUE
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.operators import LearnedOperator
from skillwrapper.learning.untested import find_tests
from skillwrapper.learning.version_space import VersionSpace, version_spaces
from skillwrapper.runs.recollection import Recollection
from skillwrapper.symbols import Absence, Atom, Literal, Variable
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.episode import Transition


class Standing(StrEnum):
    """What the recorded transitions say of a literal."""

    PROVEN = "proven"
    """A condition that is needed: without it some transition cannot be explained."""
    OPEN = "open"
    """A condition that held each time it worked, and of which nothing shows that it matters."""
    REFUTED = "refuted"
    """No condition: it worked with it and without it."""
    EFFECT = "effect"
    """It came about each time."""


@dataclass(frozen=True)
class PlacedTransition:
    """A transition, and where it stands in the run.

    Attributes:
        episode: from 1.
        step: from 1.
        transition: what was run, between which pictures.
    """

    episode: int
    step: int
    transition: Transition

    def __str__(self) -> str:
        how = "succeeded" if self.transition.success else "failed"
        return f"episode {self.episode}, step {self.step}: {self.transition.instance} {how}"


@dataclass(frozen=True)
class Reason:
    """What is known of one literal of an operator.

    Attributes:
        literal: as it is printed.
        standing: what the transitions say.
        chance: how likely a condition is needed; None for what is none.
        rests_on: what speaks for it: of a condition, the transitions in which the operator did not
            apply for want of it alone; of an effect, those that made it; of what is refuted, two
            that worked, one with it and one without.
        consequence: what would change without it.
    """

    literal: str
    standing: Standing
    chance: float | None
    rests_on: tuple[PlacedTransition, ...]
    consequence: str


@dataclass(frozen=True)
class Explanation:
    """Of one operator.

    Attributes:
        learned: the operator with its successes.
        successes: these, in order of time.
        reasons: of its conditions, of its effects, and of what is refuted.
        smallest: the smallest preconditions that explain all transitions as well.
    """

    learned: LearnedOperator
    successes: tuple[PlacedTransition, ...]
    reasons: tuple[Reason, ...]
    smallest: tuple[frozenset[Condition], ...]

    def reason(self, literal: str) -> Reason:
        """Of one literal, in the words in which it is printed; spaces do not matter.

        Raises:
            UnknownNameError: if the operator has no such literal, nor is it refuted.
        """
        known = {_plain(reason.literal): reason for reason in self.reasons}
        if _plain(literal) not in known:
            raise UnknownNameError("literal", literal, [r.literal for r in self.reasons])
        return known[_plain(literal)]


def explain(known: Recollection, operator: str) -> Explanation:
    """Explain an operator of a run.

    Args:
        known: what is recorded.
        operator: its name, in any case.

    Raises:
        UnknownNameError: if there is no such operator.
    """
    fit = known.fit()
    by_name = {learned.operator.name.lower(): learned for learned in fit.operators}
    if operator.lower() not in by_name:
        names = [learned.operator.name for learned in fit.operators]
        raise UnknownNameError("operator", operator, names)
    return _Explainer(fit, by_name[operator.lower()], placed_transitions(known)).explain()


def placed_transitions(known: Recollection) -> tuple[PlacedTransition, ...]:
    """All transitions, by their numbers in what was learned."""
    return tuple(
        PlacedTransition(episode, step, transition)
        for episode, recorded in enumerate(known.episodes, start=1)
        for step, transition in enumerate(recorded.transitions, start=1)
    )


@dataclass(frozen=True)
class _Explainer:
    fit: Fit
    learned: LearnedOperator
    transitions: Sequence[PlacedTransition]

    def explain(self) -> Explanation:
        operator = self.learned.operator
        spaces = version_spaces(self.fit, operator.skill)
        (space,) = (s for s in spaces if s.operator is operator)
        reasons = (*self._conditions(space), *self._effects(), *self._refuted())
        successes = self._at(self.learned.cluster.ids)
        return Explanation(self.learned, successes, reasons, space.most_general)

    def _at(self, ids: Iterable[int]) -> tuple[PlacedTransition, ...]:
        return tuple(self.transitions[number] for number in ids)

    def _conditions(self, space: VersionSpace) -> Iterator[Reason]:
        tests = find_tests(self.fit, self.learned)
        for condition in sorted(space.conditions, key=_order):
            wrong = self._at(tests.get(condition, ()))
            proven = condition in space.proven or bool(wrong)
            if wrong:
                told = f"it would apply to {_wrong(wrong)}"
            elif proven:
                told = "together with others that can be left out, it tells failures from successes"
            else:
                told = (
                    f"nothing recorded would be told otherwise; it held before all "
                    f"{len(self.learned.cluster.ids)} successes; to decide it, run "
                    f"{self.learned.operator.skill} where this alone is not so"
                )
            standing = Standing.PROVEN if proven else Standing.OPEN
            chance = space.probability[condition]
            yield Reason(_printed(condition), standing, chance, wrong, told)

    def _effects(self) -> Iterator[Reason]:
        operator, ids = self.learned.operator, self.learned.cluster.ids
        told = f"{len(ids)} successes would have changed what no operator says"
        literals = [Literal(atom) for atom in sorted(operator.add_effects)]
        literals += [Literal(atom, False) for atom in sorted(operator.delete_effects)]
        for literal in literals:
            yield Reason(f"makes {literal}", Standing.EFFECT, None, self._at(ids), told)

    def _refuted(self) -> Iterator[Reason]:
        for atom in self._atoms():
            held = self._holding(atom)
            if {TRUE, FALSE} <= held.keys():
                both = self._at((held[TRUE], held[FALSE]))
                told = "it worked with it and without it"
                yield Reason(str(atom), Standing.REFUTED, None, both, told)

    def _atoms(self) -> Iterator[Atom]:
        """All atoms over the parameters that the change binds."""
        bound = len(self.learned.cluster.groups[0].lifting.objects)
        names = [v.name for v in self.learned.operator.parameters[:bound]]
        for predicate in self.fit.predicates:
            for terms in product(names, repeat=predicate.arity):
                if len(set(terms)) == len(terms):
                    yield Atom(predicate.name, terms)

    def _holding(self, atom: Atom) -> dict[int, int]:
        """For each label that an atom had before a success, the first of them."""
        found: dict[int, int] = {}
        for group in self.learned.cluster.groups:
            names = (v.name for v in self.learned.operator.parameters)
            objects = dict(zip(names, group.lifting.objects, strict=False))
            column = group.table.space.column.get(atom.substitute(objects))
            if column is not None:
                for row in group.rows:
                    found.setdefault(
                        int(group.table.before[row, column]), int(group.table.ids[row])
                    )
        return found


def _order(condition: Condition) -> tuple[int, str]:
    kinds = (Literal, Absence, Variable)
    return kinds.index(type(condition)), str(condition)


def _printed(condition: Condition) -> str:
    return f"types {condition}" if isinstance(condition, Variable) else str(condition)


def _wrong(transitions: Sequence[PlacedTransition]) -> str:
    failed = sum(not one.transition.success for one in transitions)
    parts = [f"{failed} that failed"] if failed else []
    other = len(transitions) - failed
    parts += [f"{other} that changed something else"] if other else []
    return " and ".join(parts)


def _plain(literal: str) -> str:
    return "".join(literal.lower().split())
