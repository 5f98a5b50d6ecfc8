"""A candidate predicate on trial: what would be learned with it, and what that is worth."""

from __future__ import annotations

from dataclasses import dataclass

from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Predicate


@dataclass(frozen=True, eq=False)
class Trial:
    """A candidate with the model that would be learned with it.

    Attributes:
        predicate: the candidate.
        dormant: whether it was known, but set aside.
        fit: what would be learned.
        score: its score on the transitions of the inconsistency's skill (D6); None if no
            transition is decided.
        remains: whether the inconsistency it was asked for remains.
        undecided: whether it is gone only for want of a label (D10).
        misreadings: what was read of it takes as much to describe as so many misreadings (D24).
    """

    predicate: Predicate
    dormant: bool
    fit: Fit
    score: float | None
    remains: bool
    undecided: bool
    misreadings: float = 0.0

    @classmethod
    def of(
        cls,
        predicate: Predicate,
        inconsistency: Inconsistency,
        *,
        dormant: bool,
        before: Fit,
        fit: Fit,
    ) -> Trial:
        """Try a candidate for an inconsistency.

        Args:
            predicate: the candidate.
            inconsistency: what it was asked for.
            dormant: whether it was known, but set aside.
            before: what is learned without it.
            fit: what is learned with it.
        """
        skill = fit.skill(inconsistency.skill)
        if inconsistency.kind is InconsistencyKind.UNNOTICED:
            # A change has its name, even if what it hangs on has none yet: no score is asked for.
            remains = inconsistency.since is None and skill.unnoticed is not None
            return cls(predicate, dormant, fit, 1.0, remains=remains, undecided=False)
        decides_one = any(
            i.witness not in skill.witnesses and i.culprit not in skill.undecided
            for i in before.skill(inconsistency.skill).inconsistencies
            if i.identity == inconsistency.identity
        )
        return cls(
            predicate,
            dormant,
            fit,
            skill.score(inconsistency.kind),
            remains=inconsistency.witness in skill.witnesses,
            undecided=not decides_one,
        )

    def shortcoming(self, threshold: float) -> str:
        """Why it is no answer, for people; empty if it resolves the inconsistency (D6)."""
        if self.remains:
            return "the inconsistency remains"
        if self.undecided:
            return "its labels of what is inconsistent are unknown"
        if self.score is None:
            return "no transition is decided with it"
        if self.score <= threshold:
            return f"score {self.score:.2f} is not above {threshold:.2f}"
        return ""

    def is_worth_it(self, before: Fit, kind: InconsistencyKind, slack: float = 0.0) -> bool:
        """Whether it explains at least as much as it takes, but for ``slack`` transitions.

        What it leaves of the third and fourth kind counts only if one of these was asked for:
        a good relation often has to wait for its partner (D6).
        """
        if kind in (InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT):
            return self.fit.hard_cost <= before.hard_cost + slack
        if kind is InconsistencyKind.UNNOTICED:
            slack += 1.0  # counts as much as a transition that is wrong
        return self.fit.cost <= before.cost + slack

    def rank(self) -> tuple[float, float, int]:
        """Smaller is better: what is left of conditions 1 and 2 and the operators that it takes,
        what is left of the other kinds, the number of groundings to evaluate.

        A reading that is taken for a mistake counts as much as a transition that is wrong, and so
        do rules that take as much to say: what tells of places in the picture follows none, and
        seems to be misread, or to change by chance.
        """
        wrong = self.misreadings
        return self.fit.hard_cost + wrong, self.fit.cost + wrong, self.predicate.arity
