"""Methods that run Algorithm 1, each with its own configuration."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from skillwrapper.evaluation.exact.learning_curves import read_stages
from skillwrapper.evaluation.methods.method import Bench, Prepared
from skillwrapper.evaluation.problems.readers import PictureReader
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.events import RunEvent
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.loop import LearningRun
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.runs.recorder import read_episode
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world.episode import Episode


def unchanged(config: RunSettings) -> RunSettings:
    """The experiment's own configuration."""
    return config


@dataclass(frozen=True)
class LearnedMethod:
    """Learns a model from pictures, then plans with it.

    Attributes:
        name: short, as in experiment files.
        title: as in tables.
        configure: changes the configuration of the whole method.
        source: None: it explores itself.
    """

    name: str
    title: str
    configure: Callable[[RunSettings], RunSettings] = unchanged
    source: str | None = None

    @contextmanager
    def prepare(self, bench: Bench) -> Iterator[Prepared]:
        """Learn in the folder ``run`` of the cell, which can be looked at like any other run."""
        config = self.configure(bench.config())
        path = bench.folder / "run"
        folder = RunFolder.create_or_resume(path, config, bench.package.file)
        figures = _learn(bench, config, folder)
        stages = read_stages(folder, bench.environment.domain)
        with open_session(config, folder.calls, learning=False) as session:
            recorded = TruthTable(bench.environment.domain, session.assistant)
            solver = bench.solver(
                stages[-1].model,
                PictureReader(bench.environment, recorded),
                PictureReader(bench.environment, bench.truth.sight),
                lambda: session.counter.answered,
            )
            yield Prepared(
                solver,
                stages,
                bench.truth.labels,
                read_episodes(folder),
                recorded,
                config.learning.absences,
                figures,
                run=folder,
                calls=folder,
            )


def _learn(bench: Bench, config: RunSettings, folder: RunFolder) -> dict[str, Any]:
    """Run what is left of the run; figures of the whole."""
    with open_session(config, folder.calls) as session:

        def watch(event: RunEvent) -> None:
            session.counter.iteration = event.iteration

        run = LearningRun(folder, config, bench.environment, session.assistant, watch)
        return run.run().to_json()


def read_episodes(folder: RunFolder) -> tuple[Episode, ...]:
    """The episodes of all finished iterations."""
    last = folder.finished_iterations()
    return tuple(read_episode(folder, number) for number in range(1, last + 1))
