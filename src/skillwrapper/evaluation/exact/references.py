"""What is known of a bundled domain beside its simulator: for comparisons, never for learning."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from skillwrapper.errors import UnknownNameError
from skillwrapper.symbols import AbstractModel, Atom, Predicate


@dataclass(frozen=True)
class DomainReference:
    """An expert's knowledge of a domain.

    Attributes:
        problems: the file of its shipped test problems.
        expert_model: a model written by hand, exact on all reachable states.
        expert_atoms: the atoms of that model's predicates that are true in a state.
        system_predicates: the predicates in which the simulator describes its states; their true
            atoms are those of ``EnumerableEnvironment.true_atoms``.
        structure: what is alike of two states, as text; problems are spread over it.
        impossible_kinds: kinds of impossible problems.
        impossibility: kind and reason why a state cannot be reached from another, where known.
    """

    problems: Path
    expert_model: Callable[[], AbstractModel]
    expert_atoms: Callable[[Any], Iterable[Atom]]
    system_predicates: tuple[Predicate, ...]
    structure: Callable[[Any], str]
    impossible_kinds: tuple[str, ...]
    impossibility: Callable[[Any, Any], tuple[str, str] | None]


def reference_of(domain: str) -> DomainReference:
    """The reference of a bundled domain.

    Raises:
        UnknownNameError: if there is none.
    """
    if domain not in _REFERENCES:
        raise UnknownNameError("domain with an expert's reference", domain, _REFERENCES)
    return _REFERENCES[domain]()


def reference_names() -> tuple[str, ...]:
    """Names of the domains that have one, sorted."""
    return tuple(sorted(_REFERENCES))


def _burger() -> DomainReference:
    from skillwrapper.domains.burger import expert, impossibility  # noqa: PLC0415
    from skillwrapper.domains.burger.system_predicates import (  # noqa: PLC0415
        SYSTEM_PREDICATES,
    )

    return DomainReference(
        problems=Path(expert.__file__).with_name("problems.yaml"),
        expert_model=expert.expert_model,
        expert_atoms=expert.expert_atoms,
        system_predicates=SYSTEM_PREDICATES,
        structure=impossibility.structure,
        impossible_kinds=impossibility.IMPOSSIBLE_KINDS,
        impossibility=impossibility.impossibility,
    )


# Each imports its simulator itself, as in ``domains.registry``.
_REFERENCES: Mapping[str, Callable[[], DomainReference]] = MappingProxyType({"burger": _burger})
