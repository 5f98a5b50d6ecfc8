"""Noise profiles: in which ways, and how often, the embedded model is to err.

Profiles are data: ``profiles/NAME.yaml``, or any file of that form.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.embedded.facts import Sort
from skillwrapper.errors import UnknownNameError
from skillwrapper.files.yaml_documents import YamlDocument

_FOLDER = Path(__file__).with_name("profiles")
_NEAREST_SORT = {
    Sort.RELATION_TO_KIND: Sort.RELATION,
    Sort.VACANCY: Sort.RELATION,
    Sort.PLACE: Sort.RELATION,
    Sort.CONDITION: Sort.ATTRIBUTE,
}
"""As which other sort facts err if their own sort was not measured."""


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class ErrorRates(_Part):
    """How often facts are misread, over all pictures.

    Attributes:
        false_positive: share of the false ones that are taken to be true, 0 to 1.
        false_negative: share of the true ones that are taken to be false, 0 to 1.
    """

    false_positive: float = Field(default=0.0, ge=0, le=1)
    false_negative: float = Field(default=0.0, ge=0, le=1)


class FactErrors(_Part):
    """How often facts of one class were read, and how often wrongly.

    Attributes:
        sort: of the facts.
        name: of the relation, attribute or condition.
        kinds: of the things concerned, as the scene reader calls them; none for any.
        positives: readings of facts that were true.
        false_negatives: how many of those were read as false.
        negatives: readings of facts that were false.
        false_positives: how many of those were read as true.
    """

    sort: Sort
    name: str
    kinds: tuple[str, ...] = ()
    positives: int = Field(default=0, ge=0)
    false_negatives: int = Field(default=0, ge=0)
    negatives: int = Field(default=0, ge=0)
    false_positives: int = Field(default=0, ge=0)


class Exchange(_Part):
    """Look-alikes that are taken for each other in tall stacks.

    Attributes:
        height: how many things of their kind such a stack has at least.
        rate: share of the pictures with errors in which it happens.
    """

    height: int = Field(default=3, ge=2)
    rate: float = Field(default=0.0, ge=0, le=1)


class NoiseProfile(_Part):
    """What goes wrong and how often.

    Attributes:
        name: of the profile.
        source: where the figures come from.
        facts: how often facts were misread; others err like those nearest to them.
        other: error rates of facts that have none near.
        clean_pictures: share of pictures in which every fact is seen rightly; the errors are in
            the others, as often as the rates over all pictures ask for.
        due_to_picture: share of an error that is due to the picture, and is made whenever the
            fact is asked for; the rest is drawn anew for every question.
        exchange: look-alikes taken for each other.
        malformed: share of replies that break off or are nonsense.
        wrong_names: share of replies in which a name is misspelt.
        timeouts: share of calls that time out; they are repeated.
    """

    name: str = ""
    source: str = ""
    facts: tuple[FactErrors, ...] = ()
    other: ErrorRates = ErrorRates()
    clean_pictures: float = Field(default=0.0, ge=0, lt=1)
    due_to_picture: float = Field(default=1.0, ge=0, le=1)
    exchange: Exchange = Exchange()
    malformed: float = Field(default=0.0, ge=0, le=1)
    wrong_names: float = Field(default=0.0, ge=0, le=1)
    timeouts: float = Field(default=0.0, ge=0, le=1)

    def rates(self, sort: Sort, name: str, kinds: tuple[str, ...]) -> ErrorRates:
        """Error rates of a class of facts, over all pictures: its own, or of those nearest."""
        for near in self._nearest(sort, name, kinds):
            if near:
                return _pooled(near)
        return self.other

    def _nearest(self, sort: Sort, name: str, kinds: tuple[str, ...]) -> Iterator[list[FactErrors]]:
        """Classes of measured facts, from the same to those that are at least of a like sort."""
        if sort is Sort.RELATION_TO_KIND:
            sort = Sort.RELATION
        like = [f for f in self.facts if f.sort is sort]
        named = [f for f in like if f.name == name]
        yield [f for f in named if f.kinds == kinds]
        yield [f for f in named if not f.kinds]
        yield [f for f in named if len(set(f.kinds)) == len(set(kinds))]
        yield named
        yield like
        yield [f for f in self.facts if f.sort is _NEAREST_SORT.get(sort)]


NO_NOISE = NoiseProfile(name="none")


def noise_profile(name: str) -> NoiseProfile:
    """The profile of a name, of a file, or of a rate such as ``0.05``: every fact errs so often.

    Raises:
        UnknownNameError: if there is none.
        ConfigurationError: if the file is not a profile.
    """
    if re.fullmatch(r"0?\.\d+", name):
        rate = float(name)
        return NoiseProfile(name=name, other=ErrorRates(false_positive=rate, false_negative=rate))
    if name.endswith((".yaml", ".yml")):
        return read_profile(Path(name))
    if name not in profile_names():
        raise UnknownNameError("noise profile", name, profile_names())
    return _bundled(name)


def read_profile(path: Path) -> NoiseProfile:
    """The profile in a file; its name tells what stands in it.

    Raises:
        ConfigurationError: if it is missing or not a profile; names file and line.
    """
    profile = YamlDocument.read(path).validate(NoiseProfile)
    digest = hashlib.sha256(profile.model_dump_json(exclude={"name"}).encode()).hexdigest()
    return profile.model_copy(update={"name": f"{path.stem}-{digest[:12]}"})


def profile_names() -> tuple[str, ...]:
    """The profiles that can be chosen by name."""
    return tuple(sorted(path.stem for path in _FOLDER.glob("*.yaml")))


@cache
def _bundled(name: str) -> NoiseProfile:
    document = YamlDocument.read(_FOLDER / f"{name}.yaml")
    return document.validate(NoiseProfile).model_copy(update={"name": name})


def _pooled(several: list[FactErrors]) -> ErrorRates:
    return ErrorRates(
        false_positive=_share(several, "false_positives", "negatives"),
        false_negative=_share(several, "false_negatives", "positives"),
    )


def _share(several: list[FactErrors], wrong: str, read: str) -> float:
    total = sum(getattr(one, read) for one in several)
    return sum(getattr(one, wrong) for one in several) / total if total else 0.0
