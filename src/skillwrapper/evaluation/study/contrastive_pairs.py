"""Curated pairs of executions, each with the predicate that tells them apart."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.evaluation.study.subjects import parse_atom
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.invention.questions import InventionQuestion
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import AbstractModel, Atom, Predicate
from skillwrapper.world.capabilities import Enumerable
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.skills import parse_skill_instance


@dataclass(frozen=True)
class ContrastivePair:
    """Two executions and what should be said of them.

    Attributes:
        name: for tables.
        target: the atom that tells them apart; terms with a question mark may be anything.
        question: what the model is asked.
    """

    name: str
    target: Atom
    question: InventionQuestion


class _Entry(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _ExecutionEntry(_Entry):
    layout: int
    state: dict[str, Any]
    skill: str


class _PairEntry(_Entry):
    name: str
    target: str
    kind: InconsistencyKind
    known: list[str]
    first: _ExecutionEntry
    second: _ExecutionEntry | None = None
    unexplained: list[str] = Field(default_factory=list)


class _PairsFile(_Entry):
    domain: str
    pairs: list[_PairEntry] = Field(min_length=1)


def read_pairs(
    path: Path, environment: Enumerable, expert: AbstractModel
) -> tuple[ContrastivePair, ...]:
    """Read curated pairs and draw their pictures.

    Raises:
        ConfigurationError: if the file is not of this kind, or an execution does not go the way
            that the kind of its pair asks for.
        UnknownNameError: if a name does not exist.
    """
    document = YamlDocument.read(path)
    content = document.validate(_PairsFile)
    if content.domain != environment.domain.name:
        raise ConfigurationError(
            f"{path}: expected pairs of {environment.domain.name}, got those of {content.domain}"
        )
    return tuple(
        _Reader(environment, expert, document.place(("pairs", number))).pair(entry)
        for number, entry in enumerate(content.pairs)
    )


@dataclass(frozen=True)
class _Reader:
    environment: Enumerable
    expert: AbstractModel
    where: str

    def pair(self, entry: _PairEntry) -> ContrastivePair:
        lonely = entry.kind in (InconsistencyKind.UNEXPLAINED, InconsistencyKind.UNNOTICED)
        if lonely is not (entry.second is None):
            number = "one execution" if lonely else "two executions"
            raise ConfigurationError(f"{self.where}: expected {number} for kind {entry.kind}")
        both_succeed = entry.kind is InconsistencyKind.DETERMINISM
        first = self._transition(entry.first, success=True)
        second = self._transition(entry.second, success=both_succeed) if entry.second else None
        skill = self.environment.domain.skill_by_name[first.instance.skill]
        unexplained = tuple(parse_atom(text, self.where) for text in entry.unexplained)
        question = InventionQuestion(
            domain=self.environment.domain,
            skill=skill,
            kind=entry.kind,
            first=first,
            second=second,
            types=_types(self.environment.domain, skill.name, unexplained),
            unexplained=unexplained,
            current=tuple(self._predicate(name) for name in entry.known),
            rejected=(),
            count=1,
        )
        return ContrastivePair(entry.name, self._target(entry.target), question)

    def _transition(self, entry: _ExecutionEntry, *, success: bool) -> Transition:
        environment = self.environment
        state = environment.state_from_data(entry.state)
        instance = parse_skill_instance(entry.skill)
        succeeded, following = environment.successor(state, instance)
        if succeeded is not success:
            expected, got = ("success", "failure") if success else ("failure", "success")
            raise ConfigurationError(
                f"{self.where}: expected a {expected} of {instance}, got a {got}"
            )
        before = environment.set_state(state, seed=entry.layout)
        return Transition(before, instance, succeeded, environment.set_state(following))

    def _predicate(self, name: str) -> Predicate:
        known = self.expert.predicate_by_name
        if name not in known:
            raise UnknownNameError("predicate", name, known, self.where)
        return known[name]

    def _target(self, text: str) -> Atom:
        target = parse_atom(text, self.where)
        predicate, objects = (
            self._predicate(target.predicate),
            self.environment.domain.object_by_name,
        )
        if len(target.terms) != predicate.arity:
            raise ConfigurationError(
                f"{self.where}: expected {predicate.arity} terms in {text}, got {len(target.terms)}"
            )
        for term in target.terms:
            if not term.startswith("?") and term not in objects:
                raise UnknownNameError("object", term, objects, self.where)
        return target


def _types(domain: Domain, skill: str, unexplained: tuple[Atom, ...]) -> tuple[str, ...]:
    """The types that a proposer may use, as in a run (docs/semantics.md, D1)."""
    types = dict.fromkeys(p.type for p in domain.skill_by_name[skill].parameters)
    for atom in unexplained:
        for term in atom.terms:
            types.update(dict.fromkeys(domain.object_by_name[term].types))
    return tuple(types)
