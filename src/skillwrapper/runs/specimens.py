"""Pictures with known answers, for trying out a model: the file that a domain names ``doctor``.

=========== ==================================================================================
key         what it holds
=========== ==================================================================================
pictures    by name: ``file``, relative to the folder of the domain, and ``holds``, the atoms that
            are true in it, each as a list of the predicate's name and of objects
predicates  name, types and semantics of the predicates that are asked for
scene       name of the scene in the pictures; the domain's first one by default
success     a skill instance that worked, with the pictures ``before`` and ``after``
failure     the same for one that did not work
=========== ==================================================================================

No predicate may be true of everything, and some atoms must differ between the two pictures of the
success: else a model that does not look could not be told from one that does.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ConfigurationError
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_picture
from skillwrapper.world.skills import SkillInstance
from skillwrapper.world.types import Object


class _Entry(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class _PictureEntry(_Entry):
    file: str
    holds: list[list[str]]


class _PredicateEntry(_Entry):
    name: str
    types: list[str]
    semantics: str = Field(min_length=1)


class _TransitionEntry(_Entry):
    skill: list[str] = Field(min_length=1)
    before: str
    after: str


class _DoctorFile(_Entry):
    pictures: dict[str, _PictureEntry]
    predicates: list[_PredicateEntry] = Field(min_length=1)
    scene: str | None = None
    success: _TransitionEntry
    failure: _TransitionEntry


@dataclass(frozen=True)
class Specimen:
    """What a model is tried on.

    Attributes:
        domain: types, objects and skills.
        objects: what the pictures show.
        predicates: what is asked for.
        success: a skill that worked; some answers differ before and after it.
        failure: a skill that did not.
        truth: of the pictures before and after the success, in this order: the label of every
            grounding.
    """

    domain: Domain
    objects: tuple[Object, ...]
    predicates: tuple[Predicate, ...]
    success: Transition
    failure: Transition
    truth: tuple[Mapping[Atom, bool], Mapping[Atom, bool]]


def read_specimen(package: DomainPackage) -> Specimen:
    """What the package of a domain brings for trying out a model.

    Raises:
        ConfigurationError: if it brings nothing, or there is a mistake in the file.
        PictureError: if a picture is missing or none.
    """
    document = YamlDocument.read(package.doctor)
    entries = document.validate(_DoctorFile)
    domain = package.domain
    scene = domain.scene(entries.scene)
    predicates = tuple(Predicate(e.name, tuple(e.types), e.semantics) for e in entries.predicates)
    reader = _Reader(document, entries, package, all_groundings(predicates, scene.objects))
    success = reader.transition("success", entries.success, success=True)
    failure = reader.transition("failure", entries.failure, success=False)
    truth = (reader.truth(entries.success.before), reader.truth(entries.success.after))
    _check(document, truth)
    return Specimen(domain, scene.objects, predicates, success, failure, truth)


@dataclass(frozen=True)
class _Reader:
    document: YamlDocument
    entries: _DoctorFile
    package: DomainPackage
    atoms: tuple[Atom, ...]

    def transition(self, name: str, entry: _TransitionEntry, *, success: bool) -> Transition:
        for picture in (entry.before, entry.after):
            if picture not in self.entries.pictures:
                where = self.document.place((name,))
                known = ", ".join(self.entries.pictures)
                raise ConfigurationError(f"{where}: unknown picture '{picture}'; known: {known}")
        instance = SkillInstance(entry.skill[0], tuple(entry.skill[1:]))
        return Transition(self._shown(entry.before), instance, success, self._shown(entry.after))

    def truth(self, picture: str) -> dict[Atom, bool]:
        said = {
            Atom(true[0], tuple(true[1:])) for true in self.entries.pictures[picture].holds if true
        }
        unknown = said - set(self.atoms)
        if unknown:
            where = self.document.place(("pictures", picture, "holds"))
            raise ConfigurationError(
                f"{where}: no grounding of the predicates: {min(map(str, unknown))}"
            )
        return {atom: atom in said for atom in self.atoms}

    def _shown(self, picture: str) -> Observation:
        file = self.package.folder / self.entries.pictures[picture].file
        return Observation((load_picture(file),))


def _check(document: YamlDocument, truth: tuple[Mapping[Atom, bool], ...]) -> None:
    for labels in truth:
        if len(set(labels.values())) < 2:
            raise ConfigurationError(
                f"{document.path}: expected true and false atoms in every picture; else a model "
                "that says the same of everything would pass"
            )
    if truth[0] == truth[1]:
        raise ConfigurationError(
            f"{document.path}: expected an atom that differs before and after the success; else a "
            "model that does not look would pass"
        )
