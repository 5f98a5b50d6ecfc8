"""Reading labels out of a summary: true, false or unsure for every grounding.

Three steps: lines, then what each line says by itself, then whose the verdicts on lines of their
own are (docs/models.md, "How replies are read").
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from skillwrapper.symbols.predicates import Atom
from skillwrapper.vlm.parsing.layout import verdicts_by_line
from skillwrapper.vlm.parsing.lines import excerpt, reply_lines
from skillwrapper.vlm.parsing.markup import Line, without_lead
from skillwrapper.vlm.parsing.memory import remembering
from skillwrapper.vlm.parsing.statements import LineReading, Statement, StatementReader
from skillwrapper.vlm.parsing.verdicts import Reading, Said, Verdict, borne_out

_MOST_COMPLAINTS = 100


@dataclass(frozen=True)
class ParsedLabels:
    """What a summary says.

    Attributes:
        labels: True, False, or None where the summary says that it cannot be told.
        missing: groundings that it does not say anything usable about, in the order asked.
        unusable: what could not be used, with the reason.
    """

    labels: Mapping[Atom, bool | None]
    missing: tuple[Atom, ...]
    unusable: tuple[str, ...]


def parse_labels(reply: str, atoms: Sequence[Atom]) -> ParsedLabels:
    """Read labels of the groundings asked for. Never raises.

    A grounding without a verdict, with two that contradict each other, or with one that could be
    meant for another grounding, is missing: nothing is guessed, and nothing is taken to be false
    because it was not mentioned (docs/semantics.md, D10).
    """
    return _reader(tuple(atoms)).read(reply)


@lru_cache(maxsize=16)
def _reader(atoms: tuple[Atom, ...]) -> _LabelReader:
    return _LabelReader(atoms)


class _LabelReader:
    """Reads summaries; remembers what lines say by themselves, since most of them come again."""

    def __init__(self, atoms: tuple[Atom, ...]) -> None:
        self._atoms = tuple(dict.fromkeys(atoms))
        self._statements = StatementReader(self._atoms)
        read = remembering(self._statements.read, _length)  # lines that differ in numbers are one
        self._read_line = remembering(lambda line: read(without_lead(line)), _length)

    def read(self, reply: str) -> ParsedLabels:
        readings = list(map(self._read_line, reply_lines(reply)))
        claims = list(_claims(readings))
        usable = borne_out([said for _, _, said in claims])
        read: dict[int, bool | None] = {}
        doubtful: set[int] = set()
        unusable: list[str] = []
        for line, statement, said in claims:
            asked = statement.asked
            if asked is None:
                unusable.append(f"{statement.call}: not asked for, or not clear what is meant")
            elif not isinstance(said, Verdict) or said.family not in usable:
                unusable.append(f"no label in '{excerpt(line)}'")
                doubtful |= {asked} if said is Said.AMBIGUOUS else set()
            elif read.setdefault(asked, said.value) is not said.value:
                unusable.append(f"{self._atoms[asked]}: contradictory labels")
                doubtful.add(asked)
        for asked in doubtful:
            read.pop(asked, None)
        if not read and not unusable:
            unusable.append(f"no labels in the reply: '{excerpt(reply)}'")
        labels = {atom: read[n] for n, atom in enumerate(self._atoms) if n in read}
        missing = tuple(atom for n, atom in enumerate(self._atoms) if n not in read)
        return ParsedLabels(labels, missing, tuple(unusable[:_MOST_COMPLAINTS]))


def _length(line: Line) -> int:
    return len(line.whole)


def _claims(readings: Sequence[LineReading]) -> Iterator[tuple[str, Statement, Reading]]:
    """Every statement with its line and what the reply says of it there."""
    outside = verdicts_by_line(readings)
    for number, reading in enumerate(readings):
        for statement in reading.statements:
            yield reading.text, statement, _agreed(statement.said, outside.get(number))


def _agreed(inside: Reading, outside: Verdict | None) -> Reading:
    """What a line says of a statement, and a line above or below it."""
    if outside is None:
        return inside
    if inside is Said.NOTHING:
        return outside
    same = isinstance(inside, Verdict) and inside.value is outside.value
    return inside if same else Said.AMBIGUOUS
