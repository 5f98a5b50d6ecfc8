"""What a perception study looks at: predicates, and pictures of which the truth is known."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.evaluation.published import PublishedFigures, published_figures
from skillwrapper.evaluation.study.conditions import Condition
from skillwrapper.evaluation.study.models import truthful_assistant
from skillwrapper.evaluation.study.scoring import Readings
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.runs.archive import RunArchive
from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.world.capabilities import Enumerable, require
from skillwrapper.world.domain import Domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_picture
from skillwrapper.world.types import Object

_ATOM = re.compile(r"\s*([A-Za-z][\w-]*)\s*(?:\(([^()]*)\))?\s*")
_LAYOUT = 424_242
"""Seed of the arrangement of clean pictures; no run resets to it or to those that follow."""


@dataclass(frozen=True)
class Sample:
    """A picture to be read, and what is true in it.

    Attributes:
        observation: what is shown.
        truth: the label of every grounding.
    """

    observation: Observation
    truth: Readings


class Subject:
    """Something that can be studied.

    Args:
        domain: types, objects and skills.
        predicates: what is read.
        origin: where the predicates and their truth come from, for tables.
    """

    published = PublishedFigures()
    """Figures of others, to stand beside."""

    def __init__(self, domain: Domain, predicates: Sequence[Predicate], origin: str) -> None:
        if not predicates:
            raise ConfigurationError(f"{origin}: expected predicates to study, got none")
        self.domain, self.predicates, self.origin = domain, tuple(predicates), origin

    @property
    def objects(self) -> tuple[Object, ...]:
        """The objects in the pictures: all of the domain."""
        return self.domain.objects

    def supports(self, condition: Condition) -> bool:
        """Whether pictures can be shown under a condition."""
        return not condition.needs_simulator

    def samples(self, condition: Condition) -> tuple[Sample, ...]:
        """Pictures under a condition; the same states for every condition."""
        raise NotImplementedError

    def _labels(self, true: set[Atom]) -> dict[Atom, bool | None]:
        return {atom: atom in true for atom in all_groundings(self.predicates, self.objects)}


class SimulatedSubject(Subject):
    """Pictures of sampled states of a domain that can list them.

    Args:
        package: the domain.
        predicates: what is read.
        truth: the true atoms of a state, or None: then what the noise-free embedded model reads
            off the usual drawing in the same arrangement counts as the truth.
        origin: for tables.
        pictures: how many states are sampled.
        seed: of the sample.
    """

    def __init__(
        self,
        package: DomainPackage,
        predicates: Sequence[Predicate],
        truth: Callable[[Any], set[Atom]] | None,
        origin: str,
        *,
        pictures: int,
        seed: int,
    ) -> None:
        self._truth, self._package = truth, package
        self.published = published_figures(package)
        self._usual = _enumerable(package.make_environment())
        super().__init__(self._usual.domain, predicates, origin)
        states = list(self._usual.reachable_states())
        chance = random.Random(f"perception study {seed}")
        self._states = chance.sample(states, min(pictures, len(states)))
        self._seed = seed

    def supports(self, condition: Condition) -> bool:
        """Other arrangements always; another drawing if the domain has one."""
        return not condition.redrawn or self._package.has("drawings")

    def samples(self, condition: Condition) -> tuple[Sample, ...]:
        """The sampled states, drawn under a condition."""
        shown = self._usual
        if condition.redrawn:
            drawing = next(iter(self._package.entries.drawings))
            shown = _enumerable(self._package.make_environment(drawing))
        pictures, plain = [], []
        for number, state in enumerate(self._states):
            layout = _LAYOUT + (1 + number + 100_000 * self._seed if condition.layouts else 0)
            pictures.append(condition.apply(shown.set_state(state, seed=layout)))
            plain.append(self._usual.set_state(state, seed=layout))
        truths = self._truths(plain)
        return tuple(Sample(o, t) for o, t in zip(pictures, truths, strict=True))

    def _truths(self, plain: Sequence[Observation]) -> list[Readings]:
        if self._truth is not None:
            return [self._labels(self._truth(state)) for state in self._states]
        questions = [
            EvaluationQuestion(self.domain, self.objects, o, self.predicates) for o in plain
        ]
        return [answer.labels for answer in truthful_assistant().evaluate(questions)]


class LabelledSubject(Subject):
    """Pictures of one's own with the atoms that are true in them.

    Args:
        domain: types, objects and skills.
        predicates: what is read.
        file: YAML: the path of every picture, relative to the file, with a list of true atoms;
            atoms that are not listed are false.

    Raises:
        ConfigurationError: if the file is not of this kind.
        PictureError: if a picture cannot be read.
    """

    def __init__(self, domain: Domain, predicates: Sequence[Predicate], file: Path) -> None:
        super().__init__(domain, predicates, f"labels of {file}")
        document = YamlDocument.read(file)
        if not isinstance(document.data, dict) or not document.data:
            raise ConfigurationError(f"{file}: expected pictures with lists of true atoms")
        self._samples = tuple(
            Sample(
                Observation((load_picture(file.parent / str(path)),)),
                self._labels(self._true(document, path, entries)),
            )
            for path, entries in document.data.items()
        )

    def samples(self, condition: Condition) -> tuple[Sample, ...]:
        """The pictures, distorted by a condition."""
        return tuple(Sample(condition.apply(s.observation), s.truth) for s in self._samples)

    def _true(self, document: YamlDocument, path: object, entries: object) -> set[Atom]:
        place = document.place((str(path),))
        if not isinstance(entries, list):
            raise ConfigurationError(f"{place}: expected a list of true atoms, got {entries!r}")
        known = {str(atom): atom for atom in all_groundings(self.predicates, self.objects)}
        found = set()
        for entry in entries:
            text = str(parse_atom(str(entry), place))
            if text not in known:
                raise UnknownNameError("atom", text, known, place)
            found.add(known[text])
        return found


def subject_of(
    target: str, *, labels: Path | None = None, pictures: int = 40, seed: int = 0
) -> Subject:
    """What a target stands for.

    Args:
        target: a reference to a domain (its expert's predicates, true by the simulator) or the
            folder of a run (its learned predicates, true by the noise-free embedded model).
        labels: pictures of one's own with their true atoms, instead of the simulator's.
        pictures: how many states are sampled.
        seed: of the sample.

    Raises:
        UserError: if there is no such domain or run, or the labels are not usable.
    """
    if RunArchive.is_one(Path(target)):
        archive = RunArchive.open(Path(target))
        learned = archive.latest().model
        domain, predicates = learned.domain, learned.predicates
        package, truth = find_domain(archive.settings().domain), None
        origin = f"learned predicates of {target}, true by the embedded model without noise"
    else:
        package = find_domain(target)
        expert = package.expert
        domain, predicates = expert.model.domain, expert.model.predicates
        truth = _set_of(expert.atoms)
        origin = f"expert's predicates of {target}, true by the simulator"
    if labels is not None:
        return LabelledSubject(domain, predicates, labels)
    return SimulatedSubject(package, predicates, truth, origin, pictures=pictures, seed=seed)


def parse_atom(text: str, where: str) -> Atom:
    """An atom as ``holding(robot, patty)``; one without arguments may go without parentheses.

    Raises:
        ConfigurationError: if it is none.
    """
    match = _ATOM.fullmatch(text)
    if match is None:
        raise ConfigurationError(f"{where}: expected an atom like on(patty, stove), got '{text}'")
    return Atom(match[1], tuple(t.strip() for t in (match[2] or "").split(",") if t.strip()))


def _set_of(atoms: Callable[[Any], Any]) -> Callable[[Any], set[Atom]]:
    return lambda state: set(atoms(state))


def _enumerable(environment: Environment) -> Enumerable:
    return require(environment, Enumerable, "a study without --labels")
