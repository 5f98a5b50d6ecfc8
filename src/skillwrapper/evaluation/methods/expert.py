"""Expert Operators: a model written by hand, with true states or with states read off pictures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final

from skillwrapper.evaluation.exact.learning_curves import Stage
from skillwrapper.evaluation.exact.state_readers import AtomReader, PictureReader
from skillwrapper.evaluation.methods.method import CellContext, Prepared, Shares
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.archive import make_archive
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.symbols import Predicate
from skillwrapper.world.capabilities import Settable, require
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True)
class ExpertMethod:
    """Plans with the expert's model.

    Attributes:
        name: short, as in experiment files.
        title: as in tables.
        reads_pictures: whether the expert's predicates are read by the model, as in the paper.
        source: None: it learns nothing.
    """

    name: str
    title: str
    reads_pictures: bool
    source: str | None = None

    @property
    def shares(self) -> Shares:
        """The model reads, if anybody does."""
        reading = "reads start and goal" if self.reads_pictures else "nothing"
        return Shares(reading, "plans with operators written by hand")

    @contextmanager
    def prepare(self, context: CellContext) -> Iterator[Prepared]:
        """Load the expert's model.

        Raises:
            ConfigurationError: if the domain has no expert.
        """
        expert = context.package.expert
        model, truth = expert.model, AtomReader(expert.atoms)
        stages = (Stage(0, model),)
        exact = context.exact.labelled(truth)
        if not self.reads_pictures:
            require(context.environment, Settable, f"the method {self.name}")
            yield Prepared(context.solver(model, truth, exact), stages, exact)
            return
        config = context.config()
        archive = make_archive(context.folder / "run", config, context.environment.domain)
        with open_session(config, archive.layout.calls, learning=False) as session:
            table = TruthTable(context.environment.domain, session.assistant)
            reader = PictureReader(table)
            solver = context.solver(
                model,
                reader,
                exact,
                lambda: session.counter.answered,
                lambda: _look_around(context, table, model.predicates),
            )
            yield Prepared(solver, stages, exact, calls=archive)


def _look_around(
    context: CellContext, table: TruthTable, predicates: Sequence[Predicate]
) -> Acquaintance:
    """Read what resets show: nothing else was executed."""
    environment, settings = context.environment, context.settings
    starts: dict[Scene, list[Observation]] = {}
    for name in environment.domain.scenes:
        for number in range(1, settings.hypotheses.starts + 1):
            seed = context.config().layout_seed(number)
            seen = environment.reset(seed=seed, scene=name)
            starts.setdefault(environment.scene, []).append(seen)
    return Acquaintance.from_starts(
        starts,
        table,
        predicates,
        restored=environment.domain.resets_restore_state,
        priors=settings.perception.decoding,
    )


EXPERT: Final = ExpertMethod("expert", "Expert Operators, true states", reads_pictures=False)
EXPERT_READ: Final = ExpertMethod("expert-read", "Expert Operators", reads_pictures=True)
