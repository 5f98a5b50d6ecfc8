"""A whole run from a configuration: folder, environment, models, loop."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ProviderError, RunFolderError, UserError
from skillwrapper.runs.events import RunEvent
from skillwrapper.runs.folder import CONFIG, RunFolder, held
from skillwrapper.runs.loop import LearningResult, LearningRun
from skillwrapper.runs.model_sessions import CallCounter, open_session
from skillwrapper.runs.models import check_models
from skillwrapper.runs.settings import RunSettings
from skillwrapper.vlm.store import CallStore


class Onlooker:
    """Told of what happens in a run; does nothing, so that others need not do everything."""

    def opened(self, counter: CallCounter) -> None:
        """The models are ready; the counter tells how often they were asked."""

    def happened(self, event: RunEvent) -> None:
        """Something happened."""


def learn(
    config: RunSettings,
    out: Path,
    onlooker: Onlooker | None = None,
) -> LearningResult:
    """Run Algorithm 1 in a folder, or go on with a run that is there.

    Args:
        config: what to do.
        out: the folder.
        onlooker: told of what happens.

    Raises:
        UserError: if the configuration or the folder cannot be used, also because another
            process is learning in it.
        ProviderError: if a model does not answer.
        RobotError: if the environment fails.
        LimitReachedError: if a limit of the user's is reached; the run can be resumed.
    """
    package = find_domain(config.domain)
    config = config.model_copy(update={"domain": package.reference})
    check_models(config)  # first: a mistake in a name or a missing key leaves no folder behind
    with held(out):
        is_new = not (out / CONFIG).exists()
        folder = RunFolder.create_or_resume(out, config, package.file)
        _check_length(folder, config)
        try:
            return _learn(config, package, folder, onlooker or Onlooker())
        except (UserError, ProviderError):
            if is_new and not _has_records(folder):
                folder.discard_beginning()  # so that the mistake can be mended under this name
            raise


def _check_length(folder: RunFolder, config: RunSettings) -> None:
    """A shorter run would put its model in the place of the longer one's."""
    finished = folder.finished_iterations()
    if config.iterations < finished:
        raise RunFolderError(
            f"{folder.path}: {finished} iterations are finished, and only {config.iterations} were "
            f"asked for; give --iterations {finished} or more, or choose another --out"
        )


def _has_records(folder: RunFolder) -> bool:
    """Whether a skill was executed, or a model said anything."""
    if folder.episode(1).exists():
        return True
    if not folder.calls.exists():
        return False
    with CallStore(folder.calls, read_only=True) as store:
        return any(store.calls())


def _learn(
    config: RunSettings, package: DomainPackage, folder: RunFolder, onlooker: Onlooker
) -> LearningResult:
    with (
        closing(package.make_environment()) as environment,
        open_session(config, folder.calls) as session,
    ):

        def watch(event: RunEvent) -> None:
            session.counter.iteration = event.iteration
            onlooker.happened(event)

        onlooker.opened(session.counter)
        return LearningRun(folder, config, environment, session.assistant, watch).run()
