"""What two runs differ in: vocabulary, operators, evidence."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.archive.archive import ArchivedIteration
from skillwrapper.runs.synonyms import Synonym, find_synonyms
from skillwrapper.symbols import Literal, Operator, Predicate
from skillwrapper.symbols.describe import describe_predicate
from skillwrapper.world.episode import Episode

_MOST_ORDERS = 720
"""Orders of context parameters that are tried to make two operators alike."""


@dataclass(frozen=True)
class Side:
    """One of two runs.

    Attributes:
        latest: its last finished iteration.
        episodes: what it rests on.
    """

    latest: ArchivedIteration
    episodes: tuple[Episode, ...]

    @classmethod
    def of(cls, archive: RunArchive) -> Side:
        """Of a run.

        Raises:
            UserError: if no iteration is finished, or a file is damaged.
        """
        return cls(archive.latest(), archive.episodes())

    def of_skill(self, skill: str) -> tuple[Operator, ...]:
        """Its operators of a skill."""
        return self.latest.model.operators_of(skill)

    @cached_property
    def evidence(self) -> dict[str, str]:
        """Figures by what they are of."""
        done = [t for episode in self.episodes for t in episode.transitions]
        runs = Counter(t.instance.skill for t in done)
        successes = Counter(t.instance.skill for t in done if t.success)
        figures = {
            skill: f"{successes[skill]} of {runs[skill]} succeeded" for skill in sorted(runs)
        }
        certificate = self.latest.certificate
        figures |= {
            "episodes": str(len(self.episodes)),
            "pictures": str(len({o.key for t in done for o in (t.before, t.after)})),
            "violations of Lemma 1": str(certificate.lemma1_violations),
            "violations of Theorem 1": str(certificate.theorem1_violations),
            "unresolved inconsistencies": str(len(self.latest.unresolved)),
        }
        return figures


@dataclass(frozen=True)
class Difference:
    """What the second run has otherwise; lines begin with ``-`` (first), ``+`` (second) or a space.

    Attributes:
        vocabulary: predicates.
        operators: by skill.
        evidence: figures.
    """

    vocabulary: tuple[str, ...]
    operators: tuple[str, ...]
    evidence: tuple[str, ...]

    @property
    def sections(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """All, with titles."""
        return (
            ("vocabulary", self.vocabulary),
            ("operators", self.operators),
            ("evidence", self.evidence),
        )

    def to_json(self) -> dict[str, Any]:
        """As plain data."""
        return {title: list(lines) for title, lines in self.sections}


def compare(first: RunArchive, second: RunArchive) -> Difference:
    """Compare two runs.

    Raises:
        UserError: if one has no finished iteration, or a file is damaged.
    """
    one, other = Side.of(first), Side.of(second)
    synonyms = find_synonyms(one.latest, other.latest)
    words = {synonym.second.name: synonym for synonym in synonyms}
    return Difference(
        (*_vocabulary(one, other), *(f"  {synonym}" for synonym in synonyms)),
        tuple(_operators(one, other, words)),
        tuple(_evidence(one, other)),
    )


def _vocabulary(one: Side, other: Side) -> Iterator[str]:
    ours, theirs = one.latest.model.predicate_by_name, other.latest.model.predicate_by_name
    for name in sorted({*ours, *theirs}):
        if ours.get(name) != theirs.get(name):
            yield from _only("-", ours.get(name))
            yield from _only("+", theirs.get(name))


def _only(sign: str, predicate: Predicate | None) -> Iterator[str]:
    if predicate is not None:
        yield f"{sign} {describe_predicate(predicate)}"


def _operators(one: Side, other: Side, words: Mapping[str, Synonym]) -> Iterator[str]:
    skills = [*one.latest.domain.skill_by_name, *other.latest.domain.skill_by_name]
    for skill in dict.fromkeys(skills):
        left = list(other.of_skill(skill))
        for operator in one.of_skill(skill):
            if not left:
                yield from _whole("-", operator)
                continue
            partner = min(left, key=lambda o: len(_different(operator, o, words)))
            left.remove(partner)
            changes = _different(operator, partner, words)
            if changes:
                yield f"  {operator.name} / {partner.name}"
                yield from changes
        for operator in left:
            yield from _whole("+", operator)


def _whole(sign: str, operator: Operator) -> Iterator[str]:
    yield f"{sign} {operator.name} is new" if sign == "+" else f"{sign} {operator.name} is gone"
    names = [v.name for v in operator.parameters]
    yield from (f"{sign}   {line}" for line in sorted(_lines(operator, names)))


def _different(
    operator: Operator, other: Operator, words: Mapping[str, Synonym]
) -> tuple[str, ...]:
    """The lines in which two operators of a skill differ, in the names of the first one."""
    own = [v.name for v in operator.parameters]
    ours = _lines(operator, own)
    spare = [*own[operator.arity :], *(f"?new_{n}" for n in range(len(other.context)))]
    orders = itertools.permutations(spare, len(other.context))
    readings = (
        _lines(other, [*own[: operator.arity], *order], words)
        for order in itertools.islice(orders, _MOST_ORDERS)
    )
    theirs = min(readings, key=lambda lines: len(lines ^ ours))
    gone = (f"-   {line}" for line in sorted(ours - theirs))
    return (*gone, *(f"+   {line}" for line in sorted(theirs - ours)))


def _lines(
    operator: Operator, names: Sequence[str], words: Mapping[str, Synonym] | None = None
) -> frozenset[str]:
    """All that an operator says, with other names for its parameters and for predicates."""
    to = dict(zip((v.name for v in operator.parameters), names, strict=True))

    def said(literal: Literal) -> Literal:
        return _in_words(literal.substitute(to), words or {})

    changed = [Literal(atom) for atom in operator.add_effects]
    changed += [Literal(atom, False) for atom in operator.delete_effects]
    lines = [f"{to[v.name]} is {' and '.join(v.types)}" for v in operator.parameters]
    lines += [f"needs {said(literal)}" for literal in operator.preconditions]
    lines += [f"makes {said(literal)}" for literal in changed]
    for absence in operator.absences:
        # That no other is in the opposite relation is no absence of the relation.
        absent = said(Literal(absence.atom))
        atom = absent.atom if absent.positive else absence.atom.substitute(to)
        lines.append(f"needs no other {', '.join(absence.quantified)}: {atom}")
    for effect in operator.conditional_effects:
        when = " and ".join(sorted(str(said(c)) for c in effect.condition)) or "always"
        lines.append(f"changes every other {effect.quantified} with {when}: {said(effect.effect)}")
    return frozenset(lines)


def _in_words(literal: Literal, words: Mapping[str, Synonym]) -> Literal:
    """A literal in the words of the first run."""
    synonym = words.get(literal.atom.predicate)
    if synonym is None:
        return literal
    atom = replace(literal.atom, predicate=synonym.first.name)
    return Literal(atom, literal.positive is synonym.same)


def _evidence(one: Side, other: Side) -> Iterator[str]:
    ours, theirs = one.evidence, other.evidence
    for name in dict.fromkeys([*ours, *theirs]):
        if ours.get(name) != theirs.get(name):
            yield f"- {name}: {ours.get(name, 'none')}"
            yield f"+ {name}: {theirs.get(name, 'none')}"
