"""Tables of a study: the same rows for the terminal, Markdown and whatever else shows them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from skillwrapper.evaluation.published import PublishedInvention
from skillwrapper.evaluation.study.invention import InventionStudy, Proposal
from skillwrapper.evaluation.study.meaning import Meaning
from skillwrapper.evaluation.study.perception import PerceptionStudy

EMBEDDED_NOTE = (
    "The embedded model is a stand-in for trying, testing and simulation studies; its figures "
    "say nothing about a real model."
)
_MARKS = {
    Meaning.SYNONYM: "yes, synonym",
    Meaning.ANTONYM: "yes, antonym",
    Meaning.OTHER: "no",
    Meaning.UNDECIDED: "undecided",
}


@dataclass(frozen=True)
class StudyTable:
    """A table.

    Attributes:
        title: what it shows.
        columns: titles of the columns; the first one names the rows.
        rows: cells as text.
        notes: sentences that belong under it.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()

    def to_markdown(self) -> str:
        """The table in Markdown."""
        alignment = ("---", *("---:" for _ in self.columns[1:]))
        lines = [f"### {self.title}", ""]
        lines += [f"| {' | '.join(cells)} |" for cells in (self.columns, alignment, *self.rows)]
        return "\n".join([*lines, *(f"\n{note}" for note in self.notes)]) + "\n"


def perception_tables(study: PerceptionStudy) -> tuple[StudyTable, ...]:
    """Accuracy by condition beside published figures, then every predicate."""
    return (_conditions_table(study), *_predicate_tables(study))


def invention_tables(study: InventionStudy) -> tuple[StudyTable, ...]:
    """Correct runs of every pair, published pairs beside them, and what was proposed."""
    published = (_published_pairs_table(study.published),) if study.published else ()
    return (_pairs_table(study), *published, *_proposal_tables(study))


def _conditions_table(study: PerceptionStudy) -> StudyTable:
    rows, published = [], study.published.conditions
    for condition in study.conditions:
        cells = [f"{condition.name}: {condition.meaning}"]
        for model in study.models:
            result = study.result(model, condition)
            cells += [_percent(result.lifted_accuracy), _percent(result.accuracy)]
        if published:
            printed = published.get(condition.name, ())
            cells.append(" / ".join(map(_percent, printed)))
        rows.append(tuple(cells))
    measures = [(m, what) for m in study.models for what in ("lifted accuracy", "accuracy")]
    beside = [study.published.heading] if published else []
    columns = ("condition", *(f"{m.label}: {what}" for m, what in measures), *beside)
    return StudyTable(
        f"Mean accuracy over all predicates, {study.pictures} pictures each",
        columns,
        tuple(rows),
        tuple(_perception_notes(study)),
    )


def _perception_notes(study: PerceptionStudy) -> Iterator[str]:
    yield f"Read were the {study.origin}."
    yield (
        "Lifted accuracy, the paper's measure: a predicate is right in a picture if all of its "
        "groundings are; accuracy counts single groundings. An unknown label is not right."
    )
    if study.published.note:
        yield study.published.note
    if study.left_out:
        yield f"Left out, because they need a simulator's drawing: {', '.join(study.left_out)}."
    if any(model.is_embedded for model in study.models):
        yield EMBEDDED_NOTE


def _predicate_tables(study: PerceptionStudy) -> Iterator[StudyTable]:
    columns = (
        "predicate",
        "lifted accuracy",
        "accuracy",
        "readings",
        "true",
        "false positives",
        "false negatives",
        "unknown",
    )
    for result in study.results:
        rows = tuple(
            (
                score.predicate,
                _percent(score.lifted_accuracy),
                _percent(score.accuracy),
                *map(
                    str,
                    (
                        score.readings,
                        score.true,
                        score.false_positives,
                        score.false_negatives,
                        score.unknown,
                    ),
                ),
            )
            for score in result.scores
        )
        yield StudyTable(f"{result.condition.name}, {result.model.label}", columns, rows)


def _pairs_table(study: InventionStudy) -> StudyTable:
    rows = [
        (name, target, *(_correct(study.of(model, name)) for model in study.models))
        for name, target in study.targets.items()
    ]
    totals = [_correct([p for p in study.proposals if p.model == m]) for m in study.models]
    notes = [
        f"Correct is a synonym or antonym of the target: equal or opposite truth in all "
        f"{study.states} states compared. The proposals' truth is read by the embedded model "
        "without noise; what that does not understand is undecided, counts as not correct here, "
        "and is for people to judge."
    ]
    if any(model.is_embedded for model in study.models):
        notes.append(EMBEDDED_NOTE)
    return StudyTable(
        f"Predicate invention in {study.domain}: correct runs",
        ("pair", "target", *(model.label for model in study.models)),
        (*rows, ("all pairs", "", *totals)),
        tuple(notes),
    )


def _published_pairs_table(published: PublishedInvention) -> StudyTable:
    pairs, runs = published.pairs, published.runs
    rows = [(p.name, p.target, *(f"{n} of {runs}" for n in p.correct)) for p in pairs]
    sums = [sum(p.correct[number] for p in pairs) for number in range(len(published.models))]
    totals = (f"{right} of {runs * len(pairs)}" for right in sums)
    return StudyTable(
        published.title,
        ("pair", "target", *published.models),
        (*rows, ("all pairs", "", *totals)),
        (published.note,) if published.note else (),
    )


def _proposal_tables(study: InventionStudy) -> Iterator[StudyTable]:
    for model in study.models:
        rows = tuple(
            (p.pair, str(p.run), p.predicate.signature if p.predicate else "nothing usable",
             _MARKS[p.meaning])
            for name in study.targets
            for p in study.of(model, name)
        )  # fmt: skip
        columns = ("pair", "run", "proposed", "correct")
        yield StudyTable(f"What was proposed, {model.label}", columns, rows)


def _correct(proposals: list[Proposal] | tuple[Proposal, ...]) -> str:
    right = sum(p.meaning.is_correct for p in proposals)
    open_ones = sum(p.meaning is Meaning.UNDECIDED for p in proposals)
    undecided = f", {open_ones} undecided" if open_ones else ""
    return f"{right} of {len(proposals)}{undecided}"


def _percent(share: float | None) -> str:
    return "undefined" if share is None else f"{100 * share:.1f} %"
