"""What an iteration and a run leave on disk for people and other programs."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from skillwrapper.files.writing import write_atomically, write_json
from skillwrapper.grounding import AtomSpace
from skillwrapper.learning.certification import Certificate
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.folder import RunFolder
from skillwrapper.symbols.describe import describe_model
from skillwrapper.symbols.files import model_to_json, predicates_to_yaml
from skillwrapper.transitions.recorded import RecordedTransitions


def write_iteration(
    folder: RunFolder,
    number: int,
    fit: Fit,
    certificate: Certificate,
    unresolved: Sequence[dict[str, Any]],
) -> None:
    """Describe an iteration; ``summary.json``, written by the caller, marks it complete."""
    target = folder.iteration(number)
    target.mkdir(parents=True, exist_ok=True)
    write_atomically(target / "predicates.yaml", predicates_to_yaml(fit.predicates))
    write_atomically(target / "model.json", model_to_json(fit.model))
    write_atomically(target / "operators.txt", describe_model(fit.model))
    write_json(target / "certificate.json", certificate.to_json())
    write_json(target / "unresolved.json", list(unresolved))


def write_truth_table(
    path: Path, fit: Fit, recorded: RecordedTransitions, truth: TruthTable
) -> None:
    """Labels of all observations as CSV: 1 true, 0 false, ? unknown."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    for scene in recorded.scenes:
        space = AtomSpace(fit.predicates, scene.objects)
        observations = recorded.observations(scene)
        writer.writerow(["observation", *map(str, space.atoms)])
        labels = truth.labels(space, observations)
        for observation, row in zip(observations, labels, strict=True):
            writer.writerow([observation.key, *("?" if v < 0 else int(v) for v in row)])
    write_atomically(path, text.getvalue())


def describe_inconsistency(
    inconsistency: Inconsistency, recorded: RecordedTransitions
) -> dict[str, Any]:
    """An inconsistency with its transitions and pictures, as plain data."""
    witnesses = [
        _witness(number, recorded)
        for number in (inconsistency.first, inconsistency.second)
        if number is not None
    ]
    return {
        "kind": str(inconsistency.kind),
        "skill": inconsistency.skill,
        "witnesses": witnesses,
        "unexplained": [str(atom) for atom in inconsistency.unexplained],
    }


def _witness(number: int, recorded: RecordedTransitions) -> dict[str, Any]:
    transition = recorded.records[number].transition
    return {
        "transition": number,
        "instance": str(transition.instance),
        "success": transition.success,
        "before": [p.sha256 for p in transition.before.pictures],
        "after": [p.sha256 for p in transition.after.pictures],
    }
