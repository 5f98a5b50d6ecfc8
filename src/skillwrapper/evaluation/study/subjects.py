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
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.published import PublishedFigures, published_figures
from skillwrapper.evaluation.study.conditions import Condition
from skillwrapper.evaluation.study.scoring import Readings
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.grounding import FALSE, TRUE, AtomSpace
from skillwrapper.runs.archive import RunArchive
from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.world.capabilities import Enumerable, require
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_picture
from skillwrapper.world.types import Object

_ATOM = re.compile(r"\s*([A-Za-z][\w-]*)\s*(?:\(([^()]*)\))?\s*")
_READ = {TRUE: True, FALSE: False}
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
        package: the domain.
        predicates: what is read.
        objects: what is in the pictures.
        origin: where the predicates and their truth come from, for tables.
    """

    def __init__(
        self,
        package: DomainPackage,
        predicates: Sequence[Predicate],
        objects: Sequence[Object],
        origin: str,
    ) -> None:
        if not predicates:
            raise ConfigurationError(f"{origin}: expected predicates to study, got none")
        self.package, self.domain, self.origin = package, package.domain, origin
        self.predicates, self.objects = tuple(predicates), tuple(objects)

    @property
    def published(self) -> PublishedFigures:
        """Figures of others, to stand beside."""
        return published_figures(self.package)

    def supports(self, condition: Condition) -> bool:
        """Whether pictures can be shown under a condition."""
        return not condition.needs_simulator

    def samples(self, condition: Condition) -> tuple[Sample, ...]:
        """Pictures under a condition; the same states for every condition."""
        raise NotImplementedError

    def _labels(self, true: set[Atom]) -> dict[Atom, bool | None]:
        return {atom: atom in true for atom in all_groundings(self.predicates, self.objects)}


class SimulatedSubject(Subject):
    """Pictures of sampled states of a domain's first scene.

    Args:
        package: the domain.
        predicates: what is read.
        truth: the true atoms of a state, or None: then what is read without error off the usual
            drawing in the same arrangement counts as the truth.
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
        self._truth = truth
        self._usual = _enumerable(package)
        super().__init__(package, predicates, self._usual.scene.objects, origin)
        states = list(self._usual.reachable_states())
        chance = random.Random(f"perception study {seed}")
        self._states = chance.sample(states, min(pictures, len(states)))
        self._seed = seed

    def supports(self, condition: Condition) -> bool:
        """Other arrangements always; another drawing if the domain has one."""
        drawings = self.package.entries.drawings
        wanted = condition.drawing
        return not condition.redrawn or (wanted in drawings if wanted else bool(drawings))

    def samples(self, condition: Condition) -> tuple[Sample, ...]:
        """The sampled states, drawn under a condition."""
        shown = self._usual
        if condition.redrawn:
            drawing = condition.drawing or next(iter(self.package.entries.drawings))
            shown = _enumerable(self.package, drawing)
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
        space = AtomSpace(self.predicates, self.objects)
        labels = ExactReader.required(self.package, "a study of a run").labels(space, plain)
        return [dict(zip(space.atoms, map(_READ.get, row), strict=True)) for row in labels.tolist()]


class LabelledSubject(Subject):
    """Pictures of one's own with the atoms that are true in them.

    Args:
        package: the domain.
        predicates: what is read.
        file: YAML: the path of every picture, relative to the file, with a list of true atoms;
            atoms that are not listed are false.

    Raises:
        ConfigurationError: if the file is not of this kind.
        PictureError: if a picture cannot be read.
    """

    def __init__(self, package: DomainPackage, predicates: Sequence[Predicate], file: Path) -> None:
        super().__init__(package, predicates, package.domain.objects, f"labels of {file}")
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
    truth: Callable[[Any], set[Atom]] | None = None
    if RunArchive.is_one(Path(target)):
        archive = RunArchive.open(Path(target))
        predicates = archive.latest().model.predicates
        package = find_domain(archive.settings().domain)
        origin = f"learned predicates of {target}, true by the embedded model without noise"
    else:
        package = find_domain(target)
        expert = package.expert
        predicates, truth = expert.model.predicates, _set_of(expert.atoms)
        origin = f"expert's predicates of {target}, true by the simulator"
    if labels is not None:
        return LabelledSubject(package, predicates, labels)
    return SimulatedSubject(package, predicates, truth, origin, pictures=pictures, seed=seed)


def parse_atom(text: str, where: str) -> Atom:
    """An atom as ``holding(robot, cup)``; one without arguments may go without parentheses.

    Raises:
        ConfigurationError: if it is none.
    """
    match = _ATOM.fullmatch(text)
    if match is None:
        raise ConfigurationError(f"{where}: expected an atom like on(cup, shelf), got '{text}'")
    return Atom(match[1], tuple(t.strip() for t in (match[2] or "").split(",") if t.strip()))


def _set_of(atoms: Callable[[Any], Any]) -> Callable[[Any], set[Atom]]:
    return lambda state: set(atoms(state))


def _enumerable(package: DomainPackage, drawing: str | None = None) -> Enumerable:
    """The domain's first scene, in the arrangement of clean pictures."""
    made = require(package.make_environment(drawing), Enumerable, "a study without --labels")
    made.reset(seed=_LAYOUT)
    return made
