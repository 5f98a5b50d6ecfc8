"""A model as a folder of files: for planners, for people, and complete for programs."""

from __future__ import annotations

from pathlib import Path

from skillwrapper.files.writing import write_atomically
from skillwrapper.symbols.files import model_to_json, predicates_to_yaml
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.pddl import print_domain


def write_model(folder: Path, model: AbstractModel) -> None:
    """Write ``domain.pddl``, ``predicates.yaml`` and ``model.json``; the folder is made."""
    write_atomically(folder / "predicates.yaml", predicates_to_yaml(model.predicates))
    write_atomically(folder / "model.json", model_to_json(model))
    write_atomically(folder / "domain.pddl", print_domain(model))
