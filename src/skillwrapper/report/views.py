"""What the page says of single predicates, operators and violations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from skillwrapper.errors import FileError
from skillwrapper.report.history import DatedDecision, RunHistory
from skillwrapper.runs.archive import RecordedLabels
from skillwrapper.runs.archive.records import CertificateRecord, DecodingRecord, ErrorRatesRecord
from skillwrapper.symbols import AbstractModel, Operator
from skillwrapper.symbols.operators import Variable
from skillwrapper.symbols.pddl import print_domain
from skillwrapper.symbols.predicates import Literal, Predicate

_ACTION = "\n  (:action "


@dataclass(frozen=True)
class PredicateView:
    """A predicate of the learned model.

    Attributes:
        signature: e.g. ``holding(?robot, ?pickupable)``.
        semantics: when it is true.
        origin: the decision that brought it in; None if there is no record of it.
        true: how many of its groundings were read as true, over all pictures.
        false: as false.
        unknown: as unknown.
        misread: how often it is misread, as estimated; None if labels were taken as they were read.
    """

    signature: str
    semantics: str
    origin: DatedDecision | None
    true: int
    false: int
    unknown: int
    misread: ErrorRatesRecord | None = None

    @classmethod
    def of(
        cls,
        predicate: Predicate,
        history: RunHistory,
        labels: RecordedLabels,
        decoding: DecodingRecord | None,
    ) -> PredicateView:
        """Gather what is known of a predicate."""
        counts = labels.count(predicate.name)
        return cls(
            predicate.signature,
            predicate.semantics,
            history.origin(predicate.signature),
            counts[True],
            counts[False],
            counts[None],
            decoding.rates_of(predicate.name) if decoding else None,
        )

    @property
    def readings(self) -> int:
        """How many groundings were read."""
        return self.true + self.false + self.unknown


@dataclass(frozen=True)
class OperatorView:
    """An operator in readable form and in PDDL.

    Attributes:
        name: e.g. ``Pick_1``.
        call: the skill with its variables and their types.
        context: further parameters.
        needs: what must be true before.
        forbids: what must be false before.
        absences: universal absences.
        adds: what becomes true.
        deletes: what becomes false.
        changes: conditional effects.
        pddl: the action.
    """

    name: str
    call: str
    context: tuple[str, ...]
    needs: tuple[str, ...]
    forbids: tuple[str, ...]
    absences: tuple[str, ...]
    adds: tuple[str, ...]
    deletes: tuple[str, ...]
    changes: tuple[str, ...]
    pddl: str


@dataclass(frozen=True)
class SkillView:
    """A skill with what was learned of it.

    Attributes:
        signature: e.g. ``Pick(robot, pickupable)``.
        executions: how often it was run.
        successes: how often that succeeded.
        operators: its operators.
    """

    signature: str
    executions: int
    successes: int
    operators: tuple[OperatorView, ...]


@dataclass(frozen=True)
class ViolationView:
    """A transition that breaks a statement of the certificate.

    Attributes:
        statement: e.g. ``Theorem 1``.
        reason: which part.
        instances: the skill instances of the transitions in question.
        numbers: their numbers.
    """

    statement: str
    reason: str
    instances: tuple[str, ...]
    numbers: tuple[int, ...]


def view_skills(model: AbstractModel, history: RunHistory) -> tuple[SkillView, ...]:
    """All skills of the domain, those without operators too."""
    pddl = dict(_actions(model))
    views = []
    for skill in model.domain.skills:
        runs = [t.success for t in history.transitions if t.instance.skill == skill.name]
        operators = tuple(_operator(o, pddl[o.name]) for o in model.operators_of(skill.name))
        views.append(SkillView(skill.signature, len(runs), sum(runs), operators))
    return tuple(views)


def view_violations(certificate: CertificateRecord, history: RunHistory) -> Iterator[ViolationView]:
    """The violations of a certificate with the transitions they speak of.

    Raises:
        FileError: if it speaks of transitions that were not recorded.
    """
    names = {"lemma1": "Lemma 1", "theorem1": "Theorem 1"}
    for entry in certificate.violations:
        both = (entry.transition, entry.partner)
        numbers = tuple(number for number in both if number is not None)
        if max(numbers) >= len(history.transitions):
            raise FileError(
                f"the certificate speaks of transition {max(numbers)}, and "
                f"{len(history.transitions)} were recorded; run the same learn command again to "
                "mend it"
            )
        instances = tuple(str(history.transitions[number].instance) for number in numbers)
        statement = names.get(entry.statement, entry.statement)
        yield ViolationView(statement, entry.reason, instances, numbers)


def _actions(model: AbstractModel) -> Iterator[tuple[str, str]]:
    """Every operator's name with its action, cut out of the printed domain."""
    text = print_domain(model).removesuffix("\n)\n")
    blocks = text.split(_ACTION)[1:]
    ordered: Sequence[Operator] = sorted(model.operators, key=lambda o: o.name)
    for operator, block in zip(ordered, blocks, strict=True):
        yield operator.name, f"  (:action {block}\n".replace("\n  ", "\n").removeprefix("  ")


def _operator(operator: Operator, pddl: str) -> OperatorView:
    own = operator.parameters[: operator.arity]
    literals = sorted(operator.preconditions)
    return OperatorView(
        name=operator.name,
        call=f"{operator.skill}({', '.join(map(_variable, own))})",
        context=tuple(map(_variable, operator.context)),
        needs=tuple(_texts(x for x in literals if x.positive)),
        forbids=tuple(_texts(x for x in literals if not x.positive)),
        absences=tuple(map(str, sorted(operator.absences))),
        adds=tuple(map(str, sorted(operator.add_effects))),
        deletes=tuple(map(str, sorted(operator.delete_effects))),
        changes=tuple(map(str, sorted(operator.conditional_effects))),
        pddl=pddl,
    )


def _texts(literals: Iterator[Literal]) -> Iterator[str]:
    return (str(literal.atom) for literal in literals)


def _variable(variable: Variable) -> str:
    return f"{variable.name}: {' and '.join(variable.types)}" if variable.types else variable.name
