"""Expert Operators: a model written by hand, with true states or with states read off pictures."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Final

from skillwrapper.evaluation.exact.learning_curves import Stage
from skillwrapper.evaluation.methods.method import Bench, Prepared
from skillwrapper.evaluation.problems.readers import AtomReader, PictureReader
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.runs.archive import make_archive
from skillwrapper.runs.model_sessions import open_session


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

    @contextmanager
    def prepare(self, bench: Bench) -> Iterator[Prepared]:
        """Load the expert's model."""
        expert = bench.package.expert
        model, truth = expert.model, AtomReader(expert.atoms)
        stages = (Stage(0, model),)
        states = bench.truth.space.states
        if not self.reads_pictures:
            solver = bench.solver(model, truth, truth)
            yield Prepared(solver, stages, lambda atoms: truth.read(atoms, states))
            return
        config = bench.config()
        archive = make_archive(bench.folder / "run", config, bench.environment.domain)
        with open_session(config, archive.layout.calls, learning=False) as session:
            table = TruthTable(bench.environment.domain, session.assistant)
            reader = PictureReader(bench.environment, table)
            solver = bench.solver(model, reader, truth, lambda: session.counter.answered)
            yield Prepared(solver, stages, lambda atoms: truth.read(atoms, states), calls=archive)


EXPERT: Final = ExpertMethod("expert", "Expert Operators, true states", reads_pictures=False)
EXPERT_READ: Final = ExpertMethod("expert-read", "Expert Operators", reads_pictures=True)
