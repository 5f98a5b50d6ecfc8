"""Figures that others published for a domain, to stand beside ours; a file of its package."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from skillwrapper.domains.package import DomainPackage
from skillwrapper.files.yaml_documents import YamlDocument

Share = Annotated[float, Field(ge=0.0, le=1.0)]
Spread = tuple[float, float]
"""Mean and standard deviation."""


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class PublishedMethod(_Part):
    """What was published of one method.

    Attributes:
        easy: solved, in percent.
        budget_easy: planning budget; None for methods without.
        hard: solved, in percent.
        budget_hard: planning budget; None for methods without.
        impossible: recognised, in percent.
    """

    easy: Spread | None = None
    budget_easy: Spread | None = None
    hard: Spread | None = None
    budget_hard: Spread | None = None
    impossible: Spread | None = None


class PublishedResults(_Part):
    """Problems solved.

    Attributes:
        note: what must be said with it.
        classes: what the classes of problems are called there, where not easy and hard.
        methods: by the names that our methods have.
    """

    note: str = ""
    classes: Mapping[Literal["easy", "hard"], str] = {}
    methods: Mapping[str, PublishedMethod] = {}

    def heading(self, text: str) -> str:
        """A heading of a table with the classes' names."""
        for kind, name in self.classes.items():
            text = re.sub(rf"\b{kind}\b", name, text)
        return text


class PublishedPerception(_Part):
    """How well predicates were read.

    Attributes:
        heading: of the column.
        note: what must be said with it.
        conditions: for the condition of ours that comes nearest, one mean lifted accuracy or more.
    """

    heading: str = "published"
    note: str = ""
    conditions: Mapping[str, tuple[Share, ...]] = {}


class PublishedPair(_Part):
    """A curated pair.

    Attributes:
        name: of the pair.
        target: the target predicate.
        correct: how many runs of each model were correct.
    """

    name: str
    target: str
    correct: tuple[int, ...]


class PublishedInvention(_Part):
    """How often the predicate was invented that was meant.

    Attributes:
        title: of the table.
        note: what must be said with it.
        runs: how often each pair was put to each model.
        models: their names.
        pairs: the pairs.
    """

    title: str
    note: str = ""
    runs: int = Field(ge=1)
    models: tuple[str, ...] = Field(min_length=1)
    pairs: tuple[PublishedPair, ...]

    @model_validator(mode="after")
    def _one_figure_a_model(self) -> PublishedInvention:
        for pair in self.pairs:
            if len(pair.correct) != len(self.models):
                raise ValueError(f"expected {len(self.models)} figures for the pair {pair.name}")
        return self


class PublishedFigures(_Part):
    """All that was published; what is missing was not."""

    results: PublishedResults = PublishedResults()
    perception: PublishedPerception = PublishedPerception()
    invention: PublishedInvention | None = None


def published_figures(package: DomainPackage) -> PublishedFigures:
    """What the file of a domain's package says; nothing if it has none.

    Raises:
        ConfigurationError: if the file is not of this kind; names file and line.
    """
    if not package.has("published"):
        return PublishedFigures()
    return YamlDocument.read(package.published).validate(PublishedFigures)
