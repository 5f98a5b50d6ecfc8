"""Reading skill sequences out of a reply."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from skillwrapper.vlm.parsing.instances import InstanceReader, instance_reader
from skillwrapper.vlm.parsing.lines import excerpt, reply_lines
from skillwrapper.vlm.parsing.markup import Line
from skillwrapper.vlm.parsing.memory import remembering
from skillwrapper.world.skills import Skill, SkillInstance
from skillwrapper.world.types import Object

_HEADING = re.compile(
    r"(?:(?:skill|exploratory|candidate|proposed|the) ){0,3}"
    r"(?:sequence|plan|option|trajectory|episode|candidate|seq|set)s?"
    r"(?:[ _#(:-]{0,3}\d{1,3}|[ _#(:-]{1,3}(?:[a-z]|one|two|three|four|five|six)\b)",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class ParsedSequences:
    """What a reply proposed.

    Attributes:
        sequences: in the order of the reply, none empty.
        unusable: what could not be used, with the reason.
    """

    sequences: tuple[tuple[SkillInstance, ...], ...]
    unusable: tuple[str, ...]


class _Listed(NamedTuple):
    """A line with the skills in it: those that are meant, and why the others cannot be told."""

    line: Line
    is_heading: bool
    meant: tuple[SkillInstance, ...]
    unusable: tuple[str, ...]

    @property
    def size(self) -> int:
        """How many skills are written there."""
        return len(self.meant) + len(self.unusable)


def parse_sequences(
    reply: str, skills: Sequence[Skill], objects: Sequence[Object]
) -> ParsedSequences:
    """Read sequences: under headings, one a line, or one a paragraph. Never raises."""
    read = _line_reader(tuple(skills), tuple(objects))
    lines = list(map(read, reply_lines(reply)))
    sequences: list[tuple[SkillInstance, ...]] = []
    unusable: list[str] = []
    for group in _group(lines):
        unusable += [why for line in group for why in line.unusable]
        meant = [instance for line in group for instance in line.meant]
        sequences += [tuple(meant)] if meant else []
    if not sequences and not unusable:
        unusable.append(f"no skills in the reply: '{excerpt(reply)}'")
    return ParsedSequences(tuple(sequences), tuple(unusable))


@lru_cache(maxsize=16)
def _line_reader(
    skills: tuple[Skill, ...], objects: tuple[Object, ...]
) -> Callable[[Line], _Listed]:
    reader = instance_reader(skills, objects)
    return remembering(lambda line: _listed(line, reader), lambda line: len(line.whole))


def _listed(line: Line, reader: InstanceReader) -> _Listed:
    heading = _HEADING.match(line.text)
    text = line.text[heading.end() :].lstrip(" :.)=[-") if heading else line.text
    is_title = line.titled and "(" not in text and heading is None
    read = [step.meant for step in (() if is_title else reader.steps(text))]
    meant = tuple(instance for instance in read if not isinstance(instance, str))
    unusable = tuple(excerpt(why, 160) for why in read if isinstance(why, str))
    return _Listed(line, heading is not None, meant, unusable)


def _group(lines: list[_Listed]) -> list[list[_Listed]]:
    """Lines with skills that belong together."""
    starts = [line.is_heading for line in lines]
    if any(starts):
        return _split(lines, starts)
    sizes = [line.size for line in lines]
    if max(sizes, default=0) > 1:
        return _split(lines, sizes)
    groups = _split(lines, _starts_by_paragraph(lines))
    if all(sum(line.size for line in group) <= 1 for group in groups):
        return [lines]  # one list with empty lines in between
    return groups


def _split(lines: list[_Listed], starts: Sequence[int]) -> list[list[_Listed]]:
    """The lines from each start to the next, and those before the first."""
    places = [0, *(number for number, starts_here in enumerate(starts) if starts_here), None]
    return [lines[start:end] for start, end in itertools.pairwise(places)]


def _starts_by_paragraph(lines: list[_Listed]) -> list[bool]:
    starts = []
    last_number: int | None = None
    for line in lines:
        restarts = (
            line.line.number is not None
            and last_number is not None
            and line.line.number <= last_number
        )
        restarts = restarts or line.line.whole.startswith("- - ")  # a list in a list, in YAML
        starts.append(restarts or not line.line.text or set(line.line.text) <= set("[]{}, "))
        if line.line.number is not None:
            last_number = line.line.number
    return starts
