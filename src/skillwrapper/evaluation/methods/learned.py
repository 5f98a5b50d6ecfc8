"""Methods that run Algorithm 1, each with its own configuration."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final

from skillwrapper.evaluation.exact.learning_curves import read_stages
from skillwrapper.evaluation.exact.state_readers import PictureReader
from skillwrapper.evaluation.methods.method import CellContext, Prepared, Shares
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.runs.settings import RunSettings
from skillwrapper.transitions.recorded import RecordedTransitions

WHOLE_METHOD: Final = Shares(
    "reads pictures, proposes predicates",
    "explores, asks, scores and prunes predicates, learns operators, plans",
)


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
        shares: who does what.
        source: None: it explores itself.
    """

    name: str
    title: str
    shares: Shares
    configure: Callable[[RunSettings], RunSettings] = unchanged
    source: str | None = None

    @contextmanager
    def prepare(self, context: CellContext) -> Iterator[Prepared]:
        """Learn in the folder ``run`` of the cell, which can be looked at like any other run."""
        config = self.configure(context.config())
        path = context.folder / "run"
        result = learn(config, path, environment=context.environment)
        archive = RunArchive.open(path)
        stages = read_stages(archive)
        with open_session(config, archive.layout.calls, learning=False) as session:
            domain, model = context.environment.domain, stages[-1].model
            recorded = TruthTable(domain, session.assistant)

            def remember() -> Acquaintance:
                done = RecordedTransitions.of(domain, result.episodes)
                priors = config.perception.decoding
                return Acquaintance.from_record(done, recorded, model.predicates, priors)

            solver = context.solver(
                model,
                PictureReader(recorded),
                context.exact.read,
                lambda: session.counter.answered,
                remember,
            )
            yield Prepared(
                solver,
                stages,
                context.exact.read,
                result.episodes,
                recorded,
                config.learning.absences,
                result.figures.model_dump(),
                run=archive,
                calls=archive,
            )
