"""The layout of ``domain.yaml``: what a domain declares, and which files of its folder go with it.

Nothing is looked up here: what a run keeps is a copy without the files beside it. The parts of a
domain package are found by ``skillwrapper.domains``.
"""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, WithJsonSchema

from skillwrapper.redaction import without_secrets

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_MOST_NAMES = 10_000


def _check_name(name: str) -> str:
    if not _NAME.fullmatch(name):
        raise ValueError("expected a letter, then letters, digits, '-' and '_'")
    return name


Name = Annotated[
    str,
    AfterValidator(_check_name),
    WithJsonSchema({"type": "string", "pattern": f"^{_NAME.pattern}$"}),
]
"""A name that a model's reply can carry: no blank, comma, parenthesis or line break."""
Prose = Annotated[str, AfterValidator(without_secrets)]
"""What is shown to models and people, and kept in every run; keys have no business in it."""


class Entry(BaseModel):
    """Part of a file in which every key is known."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class TypeEntry(Entry):
    """An object type."""

    parents: list[Name] = Field(default_factory=list, description="direct supertypes")
    description: Prose = Field("", description="what it means, one sentence")


class ObjectEntry(Entry):
    """An object."""

    types: list[Name] = Field(min_length=1, description="its types, without supertypes")
    description: Prose = Field("", description="how to recognise it in a picture")


class ParameterEntry(Entry):
    """A parameter of a skill."""

    name: Name = Field(description="unique within the skill")
    type: Name = Field(description="the type an argument must have")
    role: Prose = Field("", description="the part an argument plays, one sentence")


class SkillEntry(Entry):
    """A skill."""

    parameters: list[ParameterEntry] = Field(description="typed parameters")
    description: Prose = Field("", description="what it is meant to do, one sentence")


class ExpertEntry(Entry):
    """A model of the domain written by hand."""

    model: str = Field(description="file of predicates and operators, as in a run's model.json")
    atoms: str = Field(description="function from a state to the true atoms of its predicates")


class DomainFile(Entry):
    """Everything that a ``domain.yaml`` may hold.

    A *reference* is ``file.py:name`` for something in a file of the domain's folder, or
    ``package.module:name`` for something installed.
    """

    name: Name = Field(description="of the domain")
    agent: Prose = Field(description="one sentence on the robot, used in prompts")
    description: Prose = Field(description="what pictures show, used in prompts")
    failures_change_nothing: bool = Field(
        False, description="whether a failed skill is known to leave the state as it was"
    )
    resets_restore_state: bool = Field(
        False,
        description="whether every reset brings the same state of a scene back, if perhaps not "
        "the same picture; then a predicate of the state reads the same at every start",
    )
    types: dict[Name, TypeEntry] = Field(
        min_length=1, max_length=_MOST_NAMES, description="by name"
    )
    objects: dict[Name, ObjectEntry] = Field(
        min_length=1, max_length=_MOST_NAMES, description="by name"
    )
    skills: dict[Name, SkillEntry] = Field(
        min_length=1, max_length=_MOST_NAMES, description="by name"
    )
    scenes: dict[Name, list[Name]] = Field(
        default_factory=dict, description="named sets of objects; without any, one with all"
    )
    robot: str | None = Field(
        None, description="reference to a Robot or Environment, or to a function that makes one"
    )
    extra: str | None = Field(
        None, description="extra of the package skillwrapper that the robot needs"
    )
    drawings: dict[Name, str] = Field(
        default_factory=dict, description="like robot, with pictures drawn in other ways"
    )
    scene_reader: str | None = Field(
        None, description="reference to a function that reads pictures for the embedded model"
    )
    words: str | None = Field(
        None, description="file of words that the embedded model lacks for this domain"
    )
    expert: ExpertEntry | None = Field(None, description="a model written by hand")
    system_predicates: str | None = Field(
        None, description="reference to the predicates of the simulator's own true atoms"
    )
    problems: str | None = Field(None, description="file of test problems")
    structure: str | None = Field(
        None, description="reference to a function that says what is alike of states"
    )
    impossibility: str | None = Field(
        None, description="reference to what explains why states cannot be reached"
    )
    pairs: str | None = Field(None, description="file of contrastive pairs for the study")
    published: str | None = Field(None, description="file of published figures to compare with")
    doctor: str | None = Field(None, description="file of pictures for trying out a model")


def domain_schema() -> dict[str, Any]:
    """The JSON Schema (draft 2020-12) of ``domain.yaml``: keys, kinds and meanings."""
    schema = DomainFile.model_json_schema()
    for entry in schema["properties"].values():
        if "patternProperties" in entry:
            entry["additionalProperties"] = False  # no other names than those of the pattern
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}
