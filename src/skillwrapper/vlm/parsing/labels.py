"""Reading labels out of a summary: true, false or unsure for every grounding."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from skillwrapper.symbols.predicates import Atom
from skillwrapper.vlm.parsing.calls import Call, find_calls
from skillwrapper.vlm.parsing.lines import excerpt, plain_lines, without_lead
from skillwrapper.vlm.parsing.names import NameIndex, fold
from skillwrapper.vlm.parsing.structured import flatten_json

_WORDS = {
    True: "true t yes y 1 holds correct satisfied ✓ ✔ ✅ ☑ 👍",
    False: "false f no n 0 incorrect unsatisfied untrue ✗ ✘ ❌ ☒ x 👎",
    None: "unsure unknown uncertain unclear undetermined indeterminate undecided ambiguous maybe"
    " possibly perhaps none null n/a na ? ⚠ unsure/unknown undeterminable",
}
_VERDICTS = {word: verdict for verdict, words in _WORDS.items() for word in words.split()}
_UNSURE = re.compile(
    r"\b(?:can(?:not|'t| not)(?: be)? (?:tell|told|say|said|see|seen|determined?|judged?|decided?)"
    r"|not (?:sure|certain|clear|visible|determinable|known|mentioned|stated|specified)"
    r"|hard to (?:tell|say)|insufficient|either way|true or false|true/false)\b",
    re.IGNORECASE,
)
_NOT = re.compile(
    r"^\W*(?:is |are |does |it is |it's )?(?:not|isn't|doesn't|never)\b\W*"
    r"(?:true|hold|holds|the case|satisfied|correct)?",
    re.IGNORECASE,
)
_NOT_FALSE = re.compile(r"^\W*(?:is )?not false\b", re.IGNORECASE)
_TOKEN = re.compile(r"n/a|[A-Za-z]+|[01](?![\d.])|\?|[✓✔✅☑👍✗✘❌☒👎⚠]", re.IGNORECASE)
_SKIPPED = frozenset(
    [
        "is",
        "are",
        "be",
        "being",
        "the",
        "a",
        "an",
        "statement",
        "this",
        "that",
        "it",
        "was",
        "therefore",
        "so",
        "answer",
        "value",
        "label",
        "verdict",
        "likely",
        "probably",
        "clearly",
        "definitely",
        "also",
        "still",
        "here",
        "evaluates",
        "to",
        "as",
        "marked",
        "judged",
        "to",
        "be",
    ]
)
_MARK_BEFORE = re.compile(r"(\[[ xX✓✔]?\]|[✓✔✅☑✗✘❌☒])\s*$")
_NOT_BEFORE = re.compile(r"(?:\bnot|¬|!|~)\s*\(?\s*$", re.IGNORECASE)
_VERDICT_BEFORE = re.compile(r"^\W*(true|false|unsure|unknown|yes|no)\s*[:|=>-]+[\s>|]*$", re.I)
_HEADING = re.compile(
    r"^\W*(?:the\s+)?(?:following\s+(?:are|is)\s+)?(?:all\s+)?(true|false|unsure|unknown|uncertain"
    r"|not true|unclear)\b(?:\s+(?:grounded\s+)?(?:statements?|atoms?|predicates?|groundings?"
    r"|facts?|ones?))?\s*(?:\(\d+\))?\s*:?\W*$",
    re.IGNORECASE,
)
_PLAIN_LINE = re.compile(r"^[-*]? ?([\w-]+\([\w, -]*\))(?::| is) (\w+)\.?$")
"""The form that is asked for, read without further ado: most lines have it."""
_MOST_ARGUMENTS = 4


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

    A grounding without a verdict, or with two that contradict each other, is missing: nothing
    is ever taken to be false because it was not mentioned (DESIGN.md D10).
    """
    finder = _AtomFinder(atoms)
    said: dict[Atom, set[bool | None]] = {}
    unusable: list[str] = []
    lines = list(_after_plain_lines(plain_lines(flatten_json(reply)), finder, said))
    for line, call, verdicts in _judgements(lines, finder):
        atom = finder.find(call)
        if atom is None:
            unusable.append(f"{call}: not asked for, or not clear what is meant")
        elif not verdicts:
            unusable.append(f"no label in '{excerpt(line)}'")
        else:
            said.setdefault(atom, set()).update(verdicts)
    for atom in [atom for atom, verdicts in said.items() if len(verdicts) > 1]:
        unusable.append(f"{atom}: contradictory labels")
        del said[atom]
    if not said and not unusable:
        unusable.append(f"no labels in the reply: '{excerpt(reply)}'")
    labels = {atom: next(iter(said[atom])) for atom in atoms if atom in said}
    return ParsedLabels(labels, tuple(a for a in atoms if a not in labels), tuple(unusable))


def _after_plain_lines(
    lines: Iterable[str], finder: _AtomFinder, said: dict[Atom, set[bool | None]]
) -> Iterator[str]:
    """Take in what is written as asked for; pass on all other lines."""
    for line in lines:
        found = _PLAIN_LINE.match(line)
        atom = finder.by_text.get(found.group(1)) if found else None
        word = found.group(2).casefold() if found else ""
        if atom is not None and word in _VERDICTS:
            said.setdefault(atom, set()).add(_VERDICTS[word])
        else:
            yield line


def _judgements(
    lines: Iterable[str], finder: _AtomFinder
) -> Iterator[tuple[str, Call, list[bool | None]]]:
    """Every call in the reply with the verdicts that belong to it.

    ``true(ly)`` is no call, but ``holds(robot, cup)`` is one if ``holds`` was asked for.
    """
    heading: list[bool | None] = []
    for raw in lines:
        line = without_lead(raw)
        title = _HEADING.match(line)
        if title:
            heading = [_heading_verdict(title.group(1))]
            continue
        calls = [
            call
            for call in find_calls(line)
            if call.name.casefold() not in _VERDICTS or fold(call.name) in finder.names
        ]
        calls = calls or _nullary(line, finder.nullary)
        if not calls and line.endswith(":"):
            heading = []
        shared = _shared_verdict(line, calls)
        for number, call in enumerate(calls):
            before = line[calls[number - 1].end if number else 0 : call.start]
            after = line[call.end : calls[number + 1].start if number + 1 < len(calls) else None]
            yield line, call, _verdict(before, after) or shared or heading


def _heading_verdict(word: str) -> bool | None:
    return {"true": True, "false": False, "not true": False}.get(word.casefold())


def _shared_verdict(line: str, calls: Sequence[Call]) -> list[bool | None]:
    """``true: a(), b()``: one verdict in front of several groundings."""
    if not calls:
        return []
    front = _VERDICT_BEFORE.match(line[: calls[0].start])
    return [_VERDICTS[front.group(1).casefold()]] if front else []


def _nullary(line: str, known: frozenset[str]) -> list[Call]:
    """A grounding without arguments may come without parentheses."""
    found = re.match(r"^\W*([A-Za-z][\w-]*)\W*(?=[:=|]|\s-)", line) if known else None
    if found is None or fold(found.group(1)) not in known:
        return []
    return [Call(found.group(1), (), found.start(1), found.end(1))]


def _verdict(before: str, after: str) -> list[bool | None]:
    """The verdict on a grounding from what stands around it; empty if there is none."""
    negated = _NOT_BEFORE.search(before) is not None
    spoken = _spoken_verdict(after)
    mark = _MARK_BEFORE.search(before)
    if not spoken and mark:
        spoken = [_mark_verdict(mark.group(1))]
    if negated:
        return [not spoken[0]] if spoken and spoken[0] is not None else spoken or [False]
    return spoken


def _mark_verdict(mark: str) -> bool:
    return _VERDICTS.get(mark, mark.strip("[] ") != "") is True


def _spoken_verdict(after: str) -> list[bool | None]:
    """The first word that is a verdict, if nothing but small words comes before it."""
    after = after.lstrip("\"' )")
    if _NOT_FALSE.match(after):
        return [True]
    negation = _NOT.match(after)
    unsure = _UNSURE.search(after)
    if unsure and unsure.start() <= 12:
        return [None]
    if negation:
        return [False]
    for token in _TOKEN.findall(after):
        word = token.casefold()
        if word in _VERDICTS:
            return [_VERDICTS[word]]
        if word not in _SKIPPED:
            return []
    return []


class _AtomFinder:
    """Finds the grounding that a written atom stands for."""

    def __init__(self, atoms: Sequence[Atom]) -> None:
        self.by_text = {str(a): a for a in atoms}
        self.names = frozenset(fold(a.predicate) for a in atoms)
        self.nullary = frozenset(fold(a.predicate) for a in atoms if not a.terms)
        self._exact = {(a.predicate, a.terms): a for a in atoms}
        self._predicates = NameIndex(a.predicate for a in atoms)
        self._objects = NameIndex(term for a in atoms for term in a.terms)

    def find(self, call: Call) -> Atom | None:
        exact = self._exact.get((call.name, call.arguments))
        if exact is not None:
            return exact
        predicate = self._predicates.find(call.name)
        terms = [self._objects.find(value) for value in call.values]
        if predicate is None or None in terms:
            return None
        known = tuple(term for term in terms if term is not None)
        return self._exact.get((predicate, known)) or self._reordered(predicate, known)

    def _reordered(self, predicate: str, terms: tuple[str, ...]) -> Atom | None:
        if len(terms) > _MOST_ARGUMENTS:
            return None
        orders = {self._exact.get((predicate, order)) for order in itertools.permutations(terms)}
        fits = [atom for atom in orders if atom is not None]
        return fits[0] if len(fits) == 1 else None
