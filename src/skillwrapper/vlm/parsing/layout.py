"""Which statements the verdicts belong to that stand on lines of their own.

A verdict belongs to the statement above it, or it is the heading of the statements below. Which of
the two is told by the reply as a whole; where it is not, nobody gets the verdict.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from skillwrapper.vlm.parsing.statements import LineReading
from skillwrapper.vlm.parsing.verdicts import Verdict


class _Part(NamedTuple):
    """A line that matters for the layout.

    Attributes:
        number: of the line.
        reading: what the line says.
        touches_last: whether no empty line stands between it and the part before.
    """

    number: int
    reading: LineReading
    touches_last: bool

    @property
    def verdict(self) -> Verdict | None:
        return self.reading.verdict

    @property
    def is_statement(self) -> bool:
        return bool(self.reading.statements)

    @property
    def takes_verdict(self) -> bool:
        """Whether it is one statement that still lacks one."""
        return self.reading.is_open and len(self.reading.statements) == 1


def verdicts_by_line(readings: Sequence[LineReading]) -> dict[int, Verdict]:
    """The verdicts for lines with statements that come from other lines."""
    if all(reading.verdict is None for reading in readings):
        return {}
    parts = list(_parts(readings))
    headings = [n for n, part in enumerate(parts) if part.reading.is_heading]
    first = headings[0] if headings else len(parts)
    placed = _of_bare_verdicts(parts[:first])
    if headings:
        placed |= _below_headings(parts, first)
    return placed | _second_verdicts(parts)


def _second_verdicts(parts: Sequence[_Part]) -> dict[int, Verdict]:
    """Verdicts below statements that have another one."""
    found: dict[int, Verdict] = {}
    above: _Part | None = None
    for part in parts:
        if part.is_statement:
            above = part
        elif above and part.verdict and not part.reading.is_heading:
            for given in above.reading.given:
                if given.value is not part.verdict.value:
                    found[above.number] = part.verdict
    return found


def _parts(readings: Sequence[LineReading]) -> Iterator[_Part]:
    touches = paragraph_begins = False
    for number, reading in enumerate(readings):
        if not reading.text:
            touches, paragraph_begins = False, True
            continue
        aside = reading.mentions or (reading.is_prose and not paragraph_begins)
        if not aside or reading.ends_group:
            yield _Part(number, reading, touches)
            touches = True
        paragraph_begins = False


def _of_bare_verdicts(parts: Sequence[_Part]) -> dict[int, Verdict]:
    """Where no verdict is marked as a heading: those above, or those below, but not a mixture."""
    parts = [part for part in parts if part.is_statement or part.verdict]
    places = [n for n, part in enumerate(parts) if part.verdict]
    if not places:
        return {}
    if parts[0].verdict:
        return _below_bare(parts, places)
    above = [parts[n - 1] for n in places]
    torn = any(
        not parts[n].touches_last and n + 1 < len(parts) and parts[n + 1].touches_last
        for n in places
    )
    if torn or not all(part.takes_verdict for part in above):
        return {}
    return {
        part.number: v for part, n in zip(above, places, strict=True) if (v := parts[n].verdict)
    }


def _below_bare(parts: Sequence[_Part], places: Sequence[int]) -> dict[int, Verdict]:
    """Verdicts that head paragraphs, each with a statement right below it."""
    for n in places:
        following = parts[n + 1] if n + 1 < len(parts) else None
        heads = following is not None and following.is_statement
        if not heads or parts[n].touches_last or not parts[n].reading.is_pure:
            return {}
        if following and not (following.touches_last or parts[n].reading.is_bold):
            return {}
    headed = (part for part in parts if part.is_statement)
    return _below(parts) if all(part.reading.is_open for part in headed) else {}


def _below_headings(parts: Sequence[_Part], first: int) -> dict[int, Verdict]:
    """Statements below headings; none where the headings might as well belong to those above."""
    marked = [part for part in parts if part.is_statement or part.verdict]
    if any(part.verdict and not part.reading.is_heading for part in parts[first:]):
        return {}
    alternate = len(marked) % 2 == 0 and all(
        part.takes_verdict if n % 2 == 0 else part.verdict for n, part in enumerate(marked)
    )
    return {} if alternate else _below(parts[first:])


def _below(parts: Sequence[_Part]) -> dict[int, Verdict]:
    found: dict[int, Verdict] = {}
    verdict: Verdict | None = None
    for part in parts:
        if part.is_statement:
            if verdict and part.reading.leads:
                found[part.number] = verdict
        else:
            verdict = part.verdict
    return found
