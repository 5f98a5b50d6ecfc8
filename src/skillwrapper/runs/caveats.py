"""What a plan rests on that nobody has made sure of; to be said before anything moves."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillwrapper.runs.archive import ArchivedIteration
from skillwrapper.symbols import Operator


def caveats(iteration: ArchivedIteration, skills: Iterable[str]) -> Iterator[str]:
    """Sentences on the skills of a plan.

    Args:
        iteration: whose model it was made with.
        skills: their names.
    """
    for skill in dict.fromkeys(skills):
        operators = [o for o in iteration.model.operators if o.skill == skill]
        if operators and all(_changes_nothing(operator) for operator in operators):
            yield f"{skill}: no predicate tells what it changes"
        left = sum(one.skill == skill for one in iteration.unresolved)
        if left:
            yield f"{skill}: {left} inconsistencies were left when it was learned"
        untested = {str(c) for o in operators for c in iteration.untested(o)}
        if untested:
            yield f"{skill}: nothing has shown yet whether it needs {', '.join(sorted(untested))}"


def _changes_nothing(operator: Operator) -> bool:
    return not (operator.add_effects or operator.delete_effects or operator.conditional_effects)
