"""A whole run from a configuration: folder, environment, models, loop."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from skillwrapper.domains.registry import domain_file, make_environment
from skillwrapper.run.assistants import Session, Spending, check_models, open_assistant
from skillwrapper.run.config import RunConfig
from skillwrapper.run.events import RunEvent
from skillwrapper.run.folder import RunFolder
from skillwrapper.run.loop import LearningResult, LearningRun


class Onlooker:
    """Told of what happens in a run; does nothing, so that others need not do everything."""

    def opened(self, session: Session) -> None:
        """The models are ready; the session tells how often they were asked."""

    def happened(self, event: RunEvent) -> None:
        """Something happened."""


def learn(
    config: RunConfig,
    out: Path,
    onlooker: Onlooker | None = None,
    spending: Spending | None = None,
) -> LearningResult:
    """Run Algorithm 1 in a folder, or go on with a run that is there.

    Args:
        config: what to do.
        out: the folder.
        onlooker: told of what happens.
        spending: limits, repetitions and a shared call store; None for the defaults.

    Raises:
        UserError: if the configuration or the folder cannot be used.
        ProviderError: if a model does not answer.
        RobotError: if the environment fails.
        LimitReachedError: if a limit of the user's is reached; the run can be resumed.
    """
    onlooker = onlooker or Onlooker()
    check_models(config)  # first: a mistake in a name or a missing key leaves no folder behind
    folder = RunFolder.create_or_resume(out, config, domain_file(config.domain))
    with (
        closing(make_environment(config.domain)) as environment,
        open_assistant(config, folder, spending=spending) as session,
    ):

        def watch(event: RunEvent) -> None:
            session.note(event)
            onlooker.happened(event)

        onlooker.opened(session)
        return LearningRun(folder, config, environment, session.assistant, watch).run()
