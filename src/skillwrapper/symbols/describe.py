"""Operators and predicates in plain text, for people and for prompts."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, Condition, Operator, Variable
from skillwrapper.symbols.predicates import Literal, Predicate


def describe_predicate(predicate: Predicate) -> str:
    """E.g. ``holding(?robot, ?pickupable): the robot holds the ingredient``."""
    meaning = " ".join(predicate.semantics.split())
    return f"{predicate.signature}: {meaning}" if meaning else predicate.signature


def describe_operator(operator: Operator, untested: Collection[Condition] = ()) -> str:
    """A block of lines: the skill with its variables, what it needs, what it changes.

    Args:
        operator: the operator.
        untested: conditions of which nothing shows that they matter; they are set apart.
    """
    own = ", ".join(map(str, operator.parameters[: operator.arity]))
    context = ", ".join(map(str, operator.context))
    with_context = f" with {context}" if context else ""
    literals = sorted(operator.preconditions, key=_positive_first)
    absences = sorted(operator.absences)
    lines = [f"{operator.name}: {operator.skill}({own}){with_context}"]
    for title, doubted in (("needs", False), ("may need", True)):
        for conditions in (literals, absences):
            lines += _line(title, (str(c) for c in conditions if (c in untested) is doubted))
    lines += _line("may need", (str(v) for v in operator.parameters if v in untested))
    lines += _line("makes true", map(str, sorted(operator.add_effects)))
    lines += _line("makes false", map(str, sorted(operator.delete_effects)))
    lines += _line("changes", (str(effect) for effect in sorted(operator.conditional_effects)))
    if len(lines) == 1:
        lines.append("  needs and changes nothing")
    return "\n".join(lines)


def describe_condition(condition: Condition, names: Mapping[str, str]) -> str:
    """A condition with objects in the place of parameters, e.g. ``not holding(robot, cup)``."""
    match condition:
        case Literal():
            return str(condition.substitute(names))
        case Absence():
            return str(Absence(condition.atom.substitute(names), condition.quantified))
        case Variable():
            return f"{names[condition.name]} to be {' and '.join(condition.types)}"


def describe_model(model: AbstractModel) -> str:
    """All predicates, then all operators."""
    predicates = "\n".join(map(describe_predicate, model.predicates)) or "no predicates"
    operators = "\n\n".join(map(describe_operator, model.operators)) or "no operators"
    return f"{predicates}\n\n{operators}\n"


def _positive_first(literal: Literal) -> tuple[bool, Literal]:
    return not literal.positive, literal


def _line(title: str, parts: Iterable[str]) -> list[str]:
    text = ", ".join(parts)
    return [f"  {title} {text}"] if text else []
