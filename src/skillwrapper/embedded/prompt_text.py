"""Reading a rendered prompt: its sections, and the lists in them."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.vlm.parsing.calls import find_calls

_OBJECT = re.compile(r"^- ([\w-]+) \(([^()]*)\)")
_SKILL = re.compile(r"^- ([\w-]+)\(")
_PARAMETER = re.compile(r"^\s+- ([\w-]+) \(([\w-]+)\)")
_PREDICATE = re.compile(r"^- ([\w-]+)\(([^()]*)\)(?::\s*(.*))?$")
_CALL = re.compile(r"^- ([\w-]+)\(([^()]*)\)")
_EXECUTION = re.compile(r"^(\d+)\. (.*\)) (succeeded|failed)")
_PICTURE = re.compile(r"^- Picture (\d+): ([^,]*)")
_ALLOWED = re.compile(r"^- \?([\w-]+) \(at most (once|twice)\)")


@dataclass(frozen=True)
class WrittenPredicate:
    """A predicate as a prompt has it."""

    name: str
    types: tuple[str, ...]
    semantics: str


@dataclass(frozen=True)
class WrittenCall:
    """``name(argument, ...)`` as a prompt has it."""

    name: str
    arguments: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.name}({', '.join(self.arguments)})"


@dataclass(frozen=True)
class WrittenSkill:
    """A skill as a prompt has it.

    Attributes:
        name: of the skill.
        types: the type of each of its parameters.
        text: all that is written of it: its name, what it does, the roles of its parameters.
    """

    name: str
    types: tuple[str, ...]
    text: str = ""


@dataclass(frozen=True)
class PromptText:
    """A prompt, taken apart.

    Attributes:
        text: all of it.
        sections: the lines under each second-level heading.
    """

    text: str
    sections: dict[str, list[str]]

    @classmethod
    def of(cls, text: str) -> PromptText:
        """Take a prompt apart; what is quoted at its end is not looked into."""
        body, quoted, rest = text.partition("\n## Text\n")
        sections: dict[str, list[str]] = {}
        current: list[str] = []
        for line in body.split("\n"):
            if line.startswith("## "):
                current = sections.setdefault(line[3:].strip(), [])
            else:
                current.append(line)
        if quoted:
            sections["Text"] = [rest]
        return cls(text, sections)

    def __contains__(self, title: str) -> bool:
        return title in self.sections

    def lines(self, title: str) -> list[str]:
        """The lines of a section; none if there is no such section."""
        return self.sections.get(title, [])

    @cached_property
    def quotation(self) -> str:
        """What stands between the triple quotes at the end."""
        inner = re.search(r'"""\n(.*)\n"""', "".join(self.lines("Text")), re.DOTALL)
        return inner.group(1) if inner else ""

    @cached_property
    def objects(self) -> dict[str, frozenset[str]]:
        """Types of every object."""
        found = (_OBJECT.match(line) for line in self.lines("Objects"))
        return {m.group(1): frozenset(_split(m.group(2))) for m in found if m}

    @cached_property
    def skills(self) -> tuple[WrittenSkill, ...]:
        """The skills, from ``Skills`` or ``Skill``."""
        skills: list[tuple[str, list[str], list[str]]] = []
        for line in (*self.lines("Skills"), *self.lines("Skill")):
            head, parameter = _SKILL.match(line), _PARAMETER.match(line)
            if head:
                skills.append((head.group(1), [], []))
            elif parameter and skills:
                skills[-1][1].append(parameter.group(2))
            if skills:
                skills[-1][2].append(line)
        return tuple(
            WrittenSkill(name, tuple(types), "\n".join(text)) for name, types, text in skills
        )

    @cached_property
    def instances(self) -> tuple[WrittenCall, ...]:
        """All skills on all objects of the right types, in the order of the prompt."""
        return tuple(
            WrittenCall(skill.name, names)
            for skill in self.skills
            for names in itertools.permutations(self.objects, len(skill.types))
            if all(t in self.objects[n] for t, n in zip(skill.types, names, strict=True))
        )

    def predicates(self, title: str) -> tuple[WrittenPredicate, ...]:
        """The predicates listed in a section."""
        found = (_PREDICATE.match(line) for line in self.lines(title))
        return tuple(
            WrittenPredicate(m.group(1), _split(m.group(2).replace("?", "")), m.group(3) or "")
            for m in found
            if m
        )

    def calls(self, title: str) -> tuple[WrittenCall, ...]:
        """The list items of a section that begin with a call."""
        found = (_CALL.match(line) for line in self.lines(title))
        return tuple(WrittenCall(m.group(1), _split(m.group(2))) for m in found if m)

    @cached_property
    def executions(self) -> tuple[tuple[WrittenCall, bool], ...]:
        """The executions of an invention prompt, with their success."""
        found = (_EXECUTION.match(line) for line in self.lines("Executions"))
        return tuple(
            (WrittenCall(call.name, call.arguments), m.group(3) == "succeeded")
            for m in found
            if m
            for call in find_calls(m.group(2))[:1]
        )

    @cached_property
    def captions(self) -> dict[str, int]:
        """Position of the first picture of every moment."""
        captions: dict[str, int] = {}
        for line in self.lines("Pictures"):
            found = _PICTURE.match(line)
            if found:
                captions.setdefault(found.group(2).strip(), int(found.group(1)) - 1)
        return captions

    @cached_property
    def allowed(self) -> dict[str, int]:
        """How often a new predicate may use each type."""
        found = (_ALLOWED.match(line) for line in self.lines("Allowed parameters"))
        return {m.group(1): 1 if m.group(2) == "once" else 2 for m in found if m}

    def number(self, pattern: str, default: int) -> int:
        """The number that the first group of a pattern finds in the prompt."""
        found = re.search(pattern, self.text)
        return int(found.group(1)) if found else default


def _split(listing: str) -> tuple[str, ...]:
    return tuple(listing.replace(",", " ").split())


def covers(wider: Sequence[str], objects: dict[str, frozenset[str]], *given: str) -> bool:
    """Whether objects of the given types are all of the wider types, position by position."""
    return len(wider) == len(given) and all(
        all(w in types for types in objects.values() if g in types)
        for w, g in zip(wider, given, strict=True)
    )
