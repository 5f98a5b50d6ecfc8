"""What perception asks a model: which ground atoms are true in a picture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from skillwrapper.symbols.predicates import Atom, Predicate
from skillwrapper.world.domain import Domain
from skillwrapper.world.observation import Observation
from skillwrapper.world.types import Object


@dataclass(frozen=True)
class EvaluationQuestion:
    """Which ground atoms are true in a picture (paper, Appendix, two-stage evaluation).

    Attributes:
        domain: types, objects and skills.
        objects: the objects of the scene.
        observation: the picture.
        predicates: the predicates to ask for, all groundings each.
    """

    domain: Domain
    objects: tuple[Object, ...]
    observation: Observation
    predicates: tuple[Predicate, ...]


@dataclass(frozen=True)
class EvaluationAnswer:
    """Labels: True, False, or None for unknown; every grounding asked for has an entry.

    Attributes:
        labels: the label of every grounding.
        agreement: if there were several votes, the share of them that the label has, 0 to 1.
    """

    labels: Mapping[Atom, bool | None]
    agreement: Mapping[Atom, float] = field(default_factory=dict)
