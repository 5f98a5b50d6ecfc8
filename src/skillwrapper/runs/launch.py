"""From settings to a run: its environment, its models, its folder, and Algorithm 1 among them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import (
    ConfigurationError,
    ProviderError,
    RunFolderError,
    SymbolError,
    UnknownNameError,
    UserError,
)
from skillwrapper.robots.absent import AbsentRobot
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm, Respondent
from skillwrapper.runs.archive import (
    ArchiveWriter,
    RunArchive,
    discard_beginning,
    make_archive,
    reserved,
    restate_settings,
)
from skillwrapper.runs.corrections import CorrectedRespondent, Corrections
from skillwrapper.runs.events import ImportedModelTried, Observer, RunEvent, RunStarted
from skillwrapper.runs.imported_model import read_imported, retake
from skillwrapper.runs.model_sessions import CallCounter, open_session
from skillwrapper.runs.models import check_models
from skillwrapper.runs.recollection import Recollection
from skillwrapper.runs.relearning import write_fit
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings
from skillwrapper.runs.settings_layers import SettingsLayers
from skillwrapper.symbols import Predicate
from skillwrapper.symbols.predicates import parse_predicate
from skillwrapper.vlm.protocol import VisionLanguageModel
from skillwrapper.world.domain import Domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.robot import Robot, RobotEnvironment


def learn(
    settings: RunSettings | Mapping[str, Any],
    out: Path | str | None = None,
    *,
    environment: Environment | Robot | None = None,
    model: VisionLanguageModel | None = None,
    observers: Sequence[Observer] = (),
) -> LearningResult:
    """Run Algorithm 1, in a folder or without one.

    Args:
        settings: what to do; a mapping leaves out what stays at its default, and may name
            settings with dots: ``{"domain": "my_folder", "learning.attempts": 5}``.
        out: the folder of the run; one that holds a run with the same settings is resumed. None
            keeps nothing but the result.
        environment: the robot or simulator; a ``Robot`` works in the domain that the settings
            name. None for the robot of that domain. One that is given stays open.
        model: answers every role in place of the models that the settings name.
        observers: told of every event, in order.

    Raises:
        UserError: if the settings or the folder cannot be used, also because another process is
            learning in it.
        ProviderError: if a model does not answer.
        RobotError: if the environment fails.
        LimitReachedError: if a limit of the user's is reached; the run can be resumed.
    """
    chosen = _settings(settings, environment)
    if isinstance(environment, Robot):
        environment = RobotEnvironment(environment, find_domain(chosen.domain).domain)
    if model is None:
        check_models(chosen)  # first: a mistake in a name or a key leaves no folder behind
    with _environment(chosen, environment) as world:
        if out is None:
            return _run(chosen, world, model, None, observers)
        with reserved(Path(out)):
            return _run_in(Path(out), chosen, world, model, observers)


def learn_recorded(
    run: Path | str,
    settings: RunSettings | None = None,
    *,
    model: VisionLanguageModel | None = None,
    observers: Sequence[Observer] = (),
) -> LearningResult:
    """Learn from what is recorded in the folder of a run, and execute nothing.

    Args:
        run: folder of a run, or of an import.
        settings: how; None for what the folder says. The number of iterations is that of the
            recorded episodes.
        model: as in ``learn``.
        observers: as in ``learn``.

    Raises:
        UserError: if there is no run, nothing is recorded, or it was learned with other settings.
        ProviderError: if a model does not answer.
        LimitReachedError: if a limit of the user's is reached; the run can be resumed.
    """
    archive = RunArchive.open(Path(run))
    episodes = archive.layout.recorded_episodes()
    if not episodes:
        raise RunFolderError(f"{run}: expected recorded episodes, got none; nothing to learn from")
    chosen = (settings or archive.settings()).model_copy(update={"iterations": episodes})
    if model is None:
        check_models(chosen)
    with reserved(archive.path):
        restate_settings(archive, chosen)
        make_archive(archive.path, chosen, archive.domain())
        absent = RobotEnvironment(AbsentRobot(), archive.domain())
        return _run(chosen, absent, model, archive, observers, is_all=True)


def _run_in(
    out: Path,
    settings: RunSettings,
    environment: Environment,
    model: VisionLanguageModel | None,
    observers: Sequence[Observer],
) -> LearningResult:
    """Run in a folder that is ours; a start that comes to nothing leaves nothing behind."""
    is_new = not RunArchive(out).layout.config.exists()
    archive = make_archive(out, settings, environment.domain)
    _check_length(archive, settings)
    try:
        return _run(settings, environment, model, archive, observers)
    except (UserError, ProviderError):
        if is_new and not _has_records(archive):
            discard_beginning(archive)  # so that the mistake can be mended under this name
        raise


def _run(
    settings: RunSettings,
    environment: Environment,
    model: VisionLanguageModel | None,
    archive: RunArchive | None,
    observers: Sequence[Observer],
    *,
    is_all: bool = False,
) -> LearningResult:
    store = archive.layout.calls if archive else None
    with open_session(settings, store, model=model) as session:
        watching: list[Observer] = [_iteration_counter(session.counter)]
        words = _words(settings, environment.domain)
        earlier, corrections = EarlierRun(words=words), Corrections()
        if archive is not None:
            watching.append(ArchiveWriter(archive))
            read_imported(archive)  # first: a damaged file is said before anything is done
            corrections = Corrections.of(archive.corrections())
            corrected = map(corrections.applied, words)
            words = tuple(p for p in corrected if p and p.name not in corrections.words)
            # What was chosen before a correction is not what would be chosen after it.
            as_it_is = is_all or bool(corrections)
            earlier = EarlierRun(
                archive.episode,
                archive.layout.finished_iterations(),
                as_it_is,
                (*words, *corrections.words.values()),
            )
        watching += observers
        for observer in watching:
            observer(RunStarted(0, session.counter))
        session.greet()
        assistant: Respondent = session.assistant
        if corrections:
            assistant = CorrectedRespondent(assistant, corrections)
        result = LearningAlgorithm(settings, environment, assistant, watching, earlier).run()
        return result if archive is None else _with_imported(archive, result, watching)


def _with_imported(
    archive: RunArchive, learned: LearningResult, observers: Sequence[Observer]
) -> LearningResult:
    """Imported operators in the place of learned ones, where nothing speaks against them."""
    if not archive.layout.imported.exists():
        return learned
    known = Recollection.of(archive)
    retaken = retake(archive, known)
    if retaken is None:
        return learned
    for observer in observers:
        observer(ImportedModelTried(known.latest.number, str(retaken)))
    return learned if retaken.against else write_fit(archive, known, retaken.fit)


def _words(settings: RunSettings, domain: Domain) -> tuple[Predicate, ...]:
    """The predicates that are known beforehand.

    Raises:
        ConfigurationError: if one is no predicate, or of a type that the domain does not have.
    """
    found: dict[str, Predicate] = {}
    for text in settings.predicates:
        try:
            predicate = parse_predicate(text)
        except SymbolError as error:
            raise ConfigurationError(f"predicates: {error}") from error
        for name in predicate.types:
            if name not in domain.types.parents:
                raise UnknownNameError("type", name, domain.types.names, f"predicates: '{text}'")
        if predicate.name in found:
            raise ConfigurationError(f"predicates: '{predicate.name}' is defined twice")
        found[predicate.name] = predicate
    return tuple(found.values())


def _settings(
    settings: RunSettings | Mapping[str, Any], environment: Environment | Robot | None
) -> RunSettings:
    """The settings with their domain as it is found again from anywhere."""
    if not isinstance(settings, RunSettings):
        layers = SettingsLayers(RunSettings)
        if environment is not None and not isinstance(environment, Robot):
            layers.add("domain", environment.domain.name, "domain")
        for name, value in settings.items():
            layers.add_any(name, value)
        settings = layers.build()
    if environment is not None and not isinstance(environment, Robot):
        return settings
    return settings.model_copy(update={"domain": find_domain(settings.domain).reference})


@contextmanager
def _environment(settings: RunSettings, given: Environment | None) -> Iterator[Environment]:
    if given is not None:
        yield given
        return
    with closing(find_domain(settings.domain).make_environment()) as made:
        yield made


def _iteration_counter(counter: CallCounter) -> Observer:
    """Tells the call store which iteration asks."""

    def note(event: RunEvent) -> None:
        counter.iteration = event.iteration or None

    return note


def _check_length(archive: RunArchive, settings: RunSettings) -> None:
    """A shorter run would put its model in the place of the longer one's."""
    finished = archive.layout.finished_iterations()
    if settings.iterations < finished:
        raise RunFolderError(
            f"{archive.path}: {finished} iterations are finished, and only {settings.iterations} "
            f"were asked for; give --iterations {finished} or more, or choose another --out"
        )


def _has_records(archive: RunArchive) -> bool:
    """Whether a skill was executed, or a model said anything."""
    if archive.layout.episode(1).exists():
        return True
    with archive.open_calls() as store:
        return store is not None and any(store.calls())
