"""Reading skill sequences out of a reply."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from skillwrapper.vlm.parsing.instances import InstanceReader, Step, instance_reader
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
    line: Line
    is_heading: bool
    steps: tuple[Step, ...]


def parse_sequences(
    reply: str, skills: Sequence[Skill], objects: Sequence[Object]
) -> ParsedSequences:
    """Read sequences: under headings, one a line, or one a paragraph. Never raises."""
    read = _line_reader(tuple(skills), tuple(objects))
    lines = list(map(read, reply_lines(reply)))
    sequences, unusable = [], []
    for group in _group(lines):
        steps = []
        for step in group:
            if isinstance(step.meant, str):
                unusable.append(excerpt(step.meant, 160))
            else:
                steps.append(step.meant)
        if steps:
            sequences.append(tuple(steps))
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
    return _Listed(line, heading is not None, () if is_title else reader.steps(text))


def _group(lines: list[_Listed]) -> list[list[Step]]:
    """Skills that belong together."""
    if any(line.is_heading for line in lines):
        return _split(lines, [line.is_heading for line in lines])
    if any(len(line.steps) > 1 for line in lines):
        return _split(lines, [bool(line.steps) for line in lines])
    groups = _split(lines, _starts_by_paragraph(lines))
    if all(len(group) <= 1 for group in groups):  # one list with empty lines in between
        return [[step for group in groups for step in group]]
    return groups


def _split(lines: list[_Listed], starts: list[bool]) -> list[list[Step]]:
    groups: list[list[Step]] = [[]]
    for line, starts_here in zip(lines, starts, strict=True):
        if starts_here:
            groups.append([])
        groups[-1].extend(line.steps)
    return [group for group in groups if group]


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
