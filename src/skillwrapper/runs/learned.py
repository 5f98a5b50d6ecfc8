"""Reading back what a run has learned."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from skillwrapper.errors import RunFolderError
from skillwrapper.runs.folder import RunFolder
from skillwrapper.symbols import AbstractModel, Operator, Predicate
from skillwrapper.symbols.files import read_model
from skillwrapper.symbols.operators import Condition
from skillwrapper.world.domain import load_domain


@dataclass(frozen=True)
class LearnedRun:
    """The result of a finished run.

    Attributes:
        folder: where it stands.
        model: predicates and operators.
        certificate: Lemma 1 and Theorem 1, as plain data.
        unresolved: inconsistencies that are left, as plain data.
        summary: figures, as plain data.
    """

    folder: RunFolder
    model: AbstractModel
    certificate: dict[str, Any]
    unresolved: list[dict[str, Any]]
    summary: dict[str, Any]

    def agreement(self, predicate: Predicate) -> float | None:
        """The share of votes for the label, on average over all labels read of a predicate.

        None if labels were not voted on.
        """
        known: dict[str, float] = self.summary.get("agreement", {})
        return known.get(predicate.name)

    def untested(self, operator: Operator) -> frozenset[Condition]:
        """The conditions of an operator of which nothing recorded shows that they matter."""
        known = set(self.summary.get("untested", {}).get(operator.name, ()))
        return frozenset(c for c in operator.conditions if str(c) in known)

    @classmethod
    def read(cls, folder: RunFolder) -> LearnedRun:
        """Read the latest state of a run.

        Raises:
            RunFolderError: if no iteration is finished yet.
        """
        last = folder.finished_iterations()
        if last == 0:
            raise RunFolderError(
                f"{folder.path}: no iteration is finished yet; "
                "run the same learn command again to go on"
            )
        target = folder.iteration(last)
        domain = load_domain(folder.path / "domain.yaml")
        return cls(
            folder,
            read_model(target / "model.json", domain),
            json.loads((target / "certificate.json").read_text(encoding="utf-8")),
            json.loads((target / "unresolved.json").read_text(encoding="utf-8")),
            json.loads((target / "summary.json").read_text(encoding="utf-8")),
        )
