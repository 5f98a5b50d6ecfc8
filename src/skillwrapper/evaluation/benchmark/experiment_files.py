"""Experiment files: every mistake in them is told with its line."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from skillwrapper.domains.discovery import domain_names, find_domain
from skillwrapper.embedded.noise import noise_profile, profile_names
from skillwrapper.errors import ConfigurationError, UnknownNameError, UserError
from skillwrapper.evaluation.benchmark.experiments import (
    MOST_CELLS,
    Experiment,
    ProblemChoice,
)
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.methods.settings import ExperimentSettings
from skillwrapper.evaluation.problems.problem_files import read_problem_document
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.runs.settings_layers import SettingsLayers

_MOVED: Final[Mapping[str, str]] = MappingProxyType(
    {"budget": "exploration.budget", "time_limit": "planner.time_limit", "noise": "model.noise"}
)
"""Where settings stand now that once stood directly under ``settings``."""


def read_experiment(
    path: Path, config: Path | None = None, assignments: Iterable[str] = ()
) -> Experiment:
    """Read an experiment file.

    Args:
        path: the file.
        config: a YAML file of settings that go over those of the experiment.
        assignments: single settings that go over both, e.g. ``exploration.budget=20``.

    Raises:
        ConfigurationError: with file, line, what was expected and what came.
        UnknownNameError: for a method, domain, noise or setting that does not exist, with the
            nearest one.
    """
    document = YamlDocument.read(path)
    _check_moved(document.part("settings"))
    experiment = document.validate(Experiment)
    _check_names(document, "methods", "method", experiment.methods, METHODS)
    for key in ("methods", "domains", "seeds", "noise"):
        _check_different(document, key, getattr(experiment, key))
    _check_size(document, experiment)
    for number, name in enumerate(experiment.noise):
        try:
            noise_profile(name)
        except UnknownNameError as error:
            place = document.place(("noise", number))
            raise UnknownNameError("noise", name, profile_names(), place) from error
    _check_sources(document, experiment)
    changes = {
        "domains": _found_domains(document, experiment),
        "problems": _with_problem_file(document, experiment),
        "settings": _layered(document.part("settings"), config, assignments),
    }
    return experiment.model_copy(update=changes)


def _check_moved(settings: YamlDocument) -> None:
    given = settings.data if isinstance(settings.data, dict) else {}
    for old, new in _MOVED.items():
        if old in given:
            hint = "'noise: [...]' of the experiment" if old == "noise" else f"'{new}'"
            raise ConfigurationError(
                f"{settings.place((old,))}: settings are those of runs; "
                f"'{old}' is now {hint} (see: skillwrapper settings)"
            )
    if isinstance(given.get("model"), str):
        raise ConfigurationError(
            f"{settings.place(('model',))}: settings are those of runs; the name of the model is "
            f"now 'model.name', e.g. 'model: {{name: {given['model']}}}'"
        )


def _layered(
    settings: YamlDocument, config: Path | None, assignments: Iterable[str]
) -> ExperimentSettings:
    layers = SettingsLayers(ExperimentSettings)
    layers.add_file(settings)
    if config is not None:
        _add_config(layers, YamlDocument.read(config))
    for text in assignments:
        layers.assign(text)
    return layers.build()


def _add_config(layers: SettingsLayers[ExperimentSettings], document: YamlDocument) -> None:
    if document.data is not None and not isinstance(document.data, dict):
        raise ConfigurationError(f"{document.place(())}: expected settings with their values")
    for name, value, location in _leaves(document.data or {}):
        layers.add(name, value, document.place(location))


def _leaves(
    data: Mapping[str, Any], above: tuple[str, ...] = ()
) -> Iterable[tuple[str, Any, tuple[str, ...]]]:
    """Every single value with its name."""
    for key, value in data.items():
        location = (*above, str(key))
        if isinstance(value, dict) and value:
            yield from _leaves(value, location)
        else:
            yield ".".join(location), value, location


def _check_names(
    document: YamlDocument, key: str, kind: str, names: tuple[str, ...], known: Collection[str]
) -> None:
    for number, name in enumerate(names):
        if name not in known:
            raise UnknownNameError(kind, name, known, document.place((key, number)))


def _found_domains(document: YamlDocument, experiment: Experiment) -> tuple[str, ...]:
    """The references, those of folders as absolute paths; a path may start at the file."""
    found = []
    for number, reference in enumerate(experiment.domains):
        beside = document.path.parent / reference
        is_path = reference not in domain_names() and beside.exists()
        try:
            package = find_domain(str(beside.resolve()) if is_path else reference)
        except UserError as error:
            where = document.place(("domains", number))
            raise ConfigurationError(f"{where}: {error}") from error
        found.append(package.reference)
    return tuple(found)


def _check_different(document: YamlDocument, key: str, values: tuple[Hashable, ...]) -> None:
    seen: set[Hashable] = set()
    for number, value in enumerate(values):
        if value in seen:
            where = document.place((key, number))
            raise ConfigurationError(f"{where}: expected different {key}, got {value!r} twice")
        seen.add(value)


def _check_size(document: YamlDocument, experiment: Experiment) -> None:
    if experiment.cell_count > MOST_CELLS:
        raise ConfigurationError(
            f"{document.place(('seeds',))}: expected at most {MOST_CELLS} cells (methods x domains "
            f"x seeds x noise), got {experiment.cell_count}; divide the experiment"
        )


def _check_sources(document: YamlDocument, experiment: Experiment) -> None:
    for number, name in enumerate(experiment.methods):
        source = METHODS[name].source
        if source is not None and source not in experiment.methods:
            raise ConfigurationError(
                f"{document.place(('methods', number))}: '{name}' learns from what '{source}' "
                f"executes; expected '{source}' among the methods, add it"
            )


def _with_problem_file(document: YamlDocument, experiment: Experiment) -> ProblemChoice:
    """The same with an absolute path, so that the folder of results can stand anywhere."""
    name = experiment.problems.file
    if name is None:
        return experiment.problems
    path = (document.path.parent / name).resolve()
    where = document.place(("problems", "file"))
    if not path.is_file():
        raise ConfigurationError(f"{where}: expected a file of problems, found none at {path}")
    if len(experiment.domains) > 1:
        raise ConfigurationError(
            f"{where}: one file of problems is for one domain, got {len(experiment.domains)}"
        )
    try:
        read_problem_document(path)
    except ConfigurationError as error:
        raise ConfigurationError(f"{where}: {error}") from error
    return experiment.problems.model_copy(update={"file": str(path)})
