"""Words for what is seen: how relations, attributes and conditions are spoken of.

``general_words.yaml`` knows the common relations; a domain adds its own words in a file of the
same form. What has no words is called by its name.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from skillwrapper.files.yaml_documents import YamlDocument

_GENERAL = Path(__file__).with_name("general_words.yaml")


def _checked_cue(text: str) -> str:
    try:
        re.compile(text)
    except re.error as error:
        raise ValueError(f"expected a regular expression ({error})") from error
    return text


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Wording(_Part):
    """How one thing is said.

    Attributes:
        names: what a predicate for it may be called.
        meanings: sentences that say what it means; ``{0}`` and ``{1}`` stand for the parameters.
        cues: regular expressions of whole words that give it away in what others write.
        salience: how readily it comes to mind, against 1 of most others.
    """

    names: tuple[str, ...] = ()
    meanings: tuple[str, ...] = ()
    cues: tuple[Annotated[str, AfterValidator(_checked_cue)], ...] = ()
    salience: float = Field(default=1.0, gt=0)

    def filled_from(self, other: Wording) -> Wording:
        """With the other's names and meanings where it has none, and with its cues as well."""
        return Wording(
            names=self.names or other.names,
            meanings=self.meanings or other.meanings,
            cues=(*self.cues, *other.cues),
            salience=max(self.salience, other.salience),
        )

    def about(self, **what: str) -> Wording:
        """With the name or the kind of a thing put in for ``{name}`` or ``{kind}``."""
        ((slot, text),) = what.items()
        slot, found = f"{{{slot}}}", r"[\s_-]?".join(map(re.escape, re.split(r"[\s_-]+", text)))
        return Wording(
            names=tuple(name.replace(slot, text) for name in self.names),
            meanings=tuple(meaning.replace(slot, text) for meaning in self.meanings),
            cues=tuple(cue.replace(slot, found) for cue in self.cues),
            salience=self.salience,
        )


class PropertyWords(Wording):
    """How an attribute or a condition is spoken of, and its opposite."""

    opposite: Wording = Wording()

    def filled_for(self, name: str) -> PropertyWords:
        """With what the bare name gives where words are missing."""
        said = _spoken(name)
        positive = self.filled_from(
            Wording(names=(f"is_{name}",), meanings=(f"the {{0}} is {said}",), cues=(said,),
                    salience=3.0)
        )  # fmt: skip
        negated = tuple(rf"(?:not|never) (?:yet )?(?:been )?(?:{c})" for c in positive.cues)
        opposite = self.opposite.filled_from(
            Wording(names=(f"not_{name}",), meanings=(f"the {{0}} is not {said}",), cues=negated)
        )
        return PropertyWords(**dict(positive), opposite=opposite)


class RelationWords(_Part):
    """How a relation is spoken of.

    Attributes:
        between: kinds of things of which it is said, pair by pair; none for any kinds.
        direct: the first thing stands in the relation to the second.
        inverse: the same, said of the second thing first.
        somewhere: a thing stands in it to something.
        at_name: a thing stands in it to the thing called ``{name}``.
        at_kind: a thing stands in it to something that is a ``{kind}``.
        vacant: nothing stands in it to a thing.
        taken: something stands in it to a thing.
        above: a thing stands in it to another one, directly or with like things between.
        lowest: a thing is at the lower end of a chain of like things.
        highest: a thing is at the upper end of such a chain.
        part: a thing is anywhere in such a chain.
    """

    between: tuple[tuple[str, str], ...] = ()
    direct: Wording | None = None
    inverse: Wording | None = None
    somewhere: Wording | None = None
    at_name: Wording | None = None
    at_kind: Wording | None = None
    vacant: Wording | None = None
    taken: Wording | None = None
    above: Wording | None = None
    lowest: Wording | None = None
    highest: Wording | None = None
    part: Wording | None = None

    def filled_from(self, other: RelationWords) -> RelationWords:
        """With the other's words where it has none, and with its kinds and cues as well."""
        forms = {}
        for form in FORMS:
            mine, given = getattr(self, form), getattr(other, form)
            forms[form] = mine.filled_from(given) if mine and given else mine or given
        between = tuple(dict.fromkeys((*self.between, *other.between)))
        return RelationWords(between=between, **forms)

    @classmethod
    def called(cls, name: str) -> RelationWords:
        """What the bare name of a relation gives."""
        said = _spoken(name)

        def wording(predicate: str, meaning: str, cue: str, salience: float = 1.0) -> Wording:
            return Wording(names=(predicate,), meanings=(meaning,), cues=(cue,), salience=salience)

        return cls(
            direct=wording(name, f"the {{0}} is {said} the {{1}}", said, 3.0),
            somewhere=wording(f"{name}_something", f"the {{0}} is {said} something", said),
            vacant=wording(
                f"nothing_{name}", f"nothing is {said} the {{0}}",
                rf"(?:nothing|no \w+)\b.{{0,20}}\b{said}", 3.0,
            ),
            taken=wording(
                f"something_{name}", f"something is {said} the {{0}}",
                rf"(?:some\w*|an?)\b.{{0,20}}\b{said}",
            ),
        )  # fmt: skip


FORMS = tuple(name for name in RelationWords.model_fields if name != "between")
"""The ways in which a relation can be spoken of."""


class Words(_Part):
    """All words of a domain.

    Attributes:
        attributes: of things, by the names that the scene reader gives them.
        conditions: of whole pictures, likewise.
        relations: likewise.
        look_alikes: pairs of things, by name, that are easily taken for each other.
    """

    attributes: dict[str, PropertyWords] = {}
    conditions: dict[str, PropertyWords] = {}
    relations: dict[str, RelationWords] = {}
    look_alikes: tuple[tuple[str, str], ...] = ()

    def relation(self, name: str) -> RelationWords:
        """Words for a relation; bare ones if there are none."""
        given = self.relations.get(name, RelationWords())
        general = general_words().relations.get(name)
        return given.filled_from(general or RelationWords.called(name))

    def attribute(self, name: str) -> PropertyWords:
        """Words for an attribute; bare ones if there are none."""
        return self.attributes.get(name, PropertyWords()).filled_for(name)

    def condition(self, name: str) -> PropertyWords:
        """Words for a condition; bare ones if there are none."""
        bare = Wording(
            names=(f"it_is_{name}",), meanings=(f"it is {_spoken(name)}",), cues=(_spoken(name),)
        )
        opposite = Wording(names=(f"it_is_not_{name}",), meanings=(f"it is not {_spoken(name)}",))
        given = self.conditions.get(name, PropertyWords())
        filled = PropertyWords(
            **dict(given.filled_from(bare)), opposite=given.opposite.filled_from(opposite)
        )
        return filled.filled_for(name)


def read_words(path: Path) -> Words:
    """The words in a file.

    Raises:
        ConfigurationError: if it is missing or not of the form; names file and line.
    """
    return YamlDocument.read(path).validate(Words)


@cache
def general_words() -> Words:
    """Words for the relations that many worlds have."""
    return read_words(_GENERAL)


def joined_words(several: tuple[Words, ...]) -> Words:
    """The words of several domains together; of what two have, the earlier comes first."""
    joined = Words()
    for words in several:
        relations = {
            name: joined.relations.get(name, RelationWords()).filled_from(given)
            for name, given in words.relations.items()
        }
        joined = Words(
            attributes=words.attributes | joined.attributes,
            conditions=words.conditions | joined.conditions,
            relations=joined.relations | relations,
            look_alikes=(*joined.look_alikes, *words.look_alikes),
        )
    return joined


def _spoken(name: str) -> str:
    return name.replace("_", " ")
