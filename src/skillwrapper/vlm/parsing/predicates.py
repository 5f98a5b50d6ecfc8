"""Reading proposed predicates out of a reply."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache

from skillwrapper.symbols.predicates import WORDS_OF_LOGIC, Predicate
from skillwrapper.vlm.parsing.calls import argument_readings, find_calls
from skillwrapper.vlm.parsing.lines import excerpt, reply_lines
from skillwrapper.vlm.parsing.names import NameIndex, fold

_LABEL = re.compile(
    r"(?:the )?(?:(?:best|new|final|proposed|next|second|first) ){0,3}"
    r"(?:predicate|candidate|proposal|answer|name|signature|option|def|define)s?"
    r"(?: (?:name|candidate|signature))? ?#? ?\d{0,2} ?[:=-]{1,3} ?|(?:def|define) ",
    re.IGNORECASE,
)
_NAME = re.compile(r"[\"']?([A-Za-z][\w-]{0,80}(?: [A-Za-z][\w-]{0,80}){0,5})[\"']? ?")
_NULLARY = re.compile(
    r"[\"']?([A-Za-z][A-Za-z0-9]{0,40}(?:_[A-Za-z0-9]{1,40}){1,8})[\"']? ?(?=[:=|]|- |->)"
)
_BARE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]{0,40}(?:_[A-Za-z0-9]{1,40}){1,8}")
_SEPARATOR = re.compile(
    r"[\"']? ?(?:[:=|;.-]|#{1,3}|//|->|=>|:=|means\b|iff\b|is true (?:if|when|iff)\b)[ :=|>-]{0,8}"
)
_MEANING = re.compile(
    r"(?:semantics?|semantic meaning|meaning|definition|description|explanation|true when)"
    r" ?[:=-]{1,3} ?",
    re.IGNORECASE,
)
_WORD = re.compile(r"\w++", re.ASCII)
_WORD_PART = re.compile(r"[^\W_]++")
_LONGEST_NAME = 60
_LONGEST_HEAD = 100
_BRACKET = re.compile(r"[(\[]")
_LOOK_AHEAD = 3


@dataclass(frozen=True)
class ParameterNames:
    """What a model may call the parameters of a new predicate.

    Attributes:
        times: how often each allowed type may be used.
        aliases: other names and the allowed types they stand for: parameters of the skill,
            arguments of the witnesses.
    """

    times: Mapping[str, int]
    aliases: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class ParsedPredicates:
    """What a reply proposed: predicates, and what could not be used, with the reason."""

    predicates: tuple[Predicate, ...]
    unusable: tuple[str, ...]


@dataclass(frozen=True)
class _Proposal:
    name: str
    parameters: tuple[str, ...]
    semantics: str


def parse_predicates(reply: str, names: ParameterNames) -> ParsedPredicates:
    """Read lines like ``name(?type, ?type): meaning``. Never raises."""
    resolver = _resolver(tuple(names.times.items()), tuple(names.aliases.items()))
    found: dict[tuple[str, tuple[str, ...]], Predicate] = {}
    unusable = []
    for proposal in _proposals([line.text for line in reply_lines(reply)]):
        predicate = _check(proposal, resolver)
        if isinstance(predicate, str):
            unusable.append(excerpt(predicate, 200))
        else:
            found.setdefault((predicate.name, predicate.types), predicate)
    if not found and not unusable:
        unusable.append(f"no predicate in the reply: '{excerpt(reply)}'")
    return ParsedPredicates(tuple(found.values()), tuple(unusable))


def says_nothing(reply: str) -> bool:
    """Whether a reply ends in the word by which it says that nothing has changed. Never raises."""
    lines = [re.findall(r"\w+", line.text.casefold()) for line in reply_lines(reply)]
    return next((words for words in reversed(lines) if words), []) == ["nothing"]


def _proposals(lines: Sequence[str]) -> Iterator[_Proposal]:
    for number, line in enumerate(lines):
        if "(" not in line and "[" not in line and "_" not in line:
            continue  # prose: neither a bracket nor a name of several words
        text = _content(line)
        read = _read_signature(text)
        if read is None:
            name = text.strip("\"' ")
            if _BARE_NAME.fullmatch(name):
                semantics = _labelled_meaning(_below(lines, number))
                yield from [_Proposal(name, (), semantics)] if semantics else []
            continue
        name, parameters, rest = read
        rest = rest.lstrip("\"' ")
        separator = _SEPARATOR.match(rest)
        semantics = _tidy(rest[separator.end() :]) if separator else ""
        if not semantics and not rest.strip("|\"',.:;=-> "):
            below = _below(lines, number)
            semantics = _labelled_meaning(below) or _meaning_in_prose(below)
            yield _Proposal(name, parameters, semantics)
        elif semantics:
            yield _Proposal(name, parameters, semantics)


def _content(line: str) -> str:
    """A line without the word that says what it is, and without quotes."""
    return _without(_LABEL, line.lstrip("\"' "))


def _below(lines: Sequence[str], number: int) -> list[str]:
    """The next lines, in which a meaning may stand."""
    return [_content(line) for line in lines[number + 1 : number + 2 + _LOOK_AHEAD]]


def _read_signature(text: str) -> tuple[str, tuple[str, ...], str] | None:
    """Name, parameters and what follows, if a line begins with a predicate."""
    opening = _BRACKET.search(text, 0, _LONGEST_HEAD)
    bracket = opening.start() if opening else -1
    named = _NAME.match(text) if opening else None
    if named and named.end() == bracket and text[bracket] == "(":
        calls = find_calls(f"p{text[bracket:]}")
        if calls and calls[0].start == 0:
            return named.group(1), calls[0].arguments, text[bracket + calls[0].end - 1 :]
    elif bracket == 0 or (named and named.end() == bracket):  # Lisp, or square brackets
        calls = find_calls(text)
        if calls and calls[0].start == 0:
            return calls[0].name, calls[0].arguments, text[calls[0].end :]
    nullary = _NULLARY.match(text)
    return (nullary.group(1), (), text[nullary.end() :]) if nullary else None


def _labelled_meaning(texts: Sequence[str]) -> str:
    """The meaning on one of the next lines, behind or below a word like ``Meaning:``."""
    near = [text for text in texts if text][:_LOOK_AHEAD]
    for number, text in enumerate(near):
        if _MEANING.match(text):
            return _tidy(text) or _meaning_in_prose(near[number + 1 :])
    return ""


def _meaning_in_prose(texts: Sequence[str]) -> str:
    """The meaning on the next line, if that is prose."""
    line = next((text for text in texts if text), "")
    is_prose = " " in line and not find_calls(line) and line[-1] not in ":?"
    return _tidy(line.removeprefix(":").removeprefix("- ")) if is_prose else ""


def _without(pattern: re.Pattern[str], text: str) -> str:
    """A text without what a pattern finds at its beginning."""
    found = pattern.match(text)
    return text[found.end() :].strip() if found else text


def _tidy(text: str) -> str:
    return _without(_MEANING, text.strip("|\"' ")).strip("|\"' ")


def _check(proposal: _Proposal, resolver: _TypeResolver) -> Predicate | str:
    name = "_".join(_WORD.findall(proposal.name)).strip("_")
    written = f"{name}({', '.join(proposal.parameters)})"
    if wanted := _wanted_of_name(name):
        return f"{written}: expected {wanted}"
    if not proposal.semantics:
        return f"{written}: expected a meaning after a colon, got none"
    if len(proposal.parameters) > 2:
        return f"{written}: expected at most two parameters, got {len(proposal.parameters)}"
    types = []
    for parameter in proposal.parameters:
        type_name = resolver.resolve(parameter)
        if type_name is None:
            return f"{written}: '{parameter}' is none of the allowed parameters"
        types.append(type_name)
    for type_name in types:
        if types.count(type_name) > resolver.times(type_name):
            return f"{written}: '{type_name}' is used too often"
    return Predicate(name, tuple(types), proposal.semantics)


@lru_cache(maxsize=64)
def _resolver(
    times: tuple[tuple[str, int], ...], aliases: tuple[tuple[str, str], ...]
) -> _TypeResolver:
    return _TypeResolver(ParameterNames(dict(times), dict(aliases)))


def _wanted_of_name(name: str) -> str:
    """What a name ought to be; nothing if it is so."""
    if name.lower() in WORDS_OF_LOGIC:
        return "a name of its own, got a word of logic"
    is_short = name[:1].isalpha() and len(name) <= _LONGEST_NAME
    return "" if is_short else "a short name that starts with a letter"


class _TypeResolver:
    """Finds the allowed type that a written parameter stands for; remembers what it found."""

    def __init__(self, names: ParameterNames) -> None:
        self._names = names
        self._meant = {**names.aliases, **{t: t for t in names.times}}
        self._index = NameIndex(self._meant)

    def times(self, type_name: str) -> int:
        return self._names.times[type_name]

    def resolve(self, parameter: str) -> str | None:
        """Declared types (``?x - robot``, ``x: robot``) count first, then the name itself."""
        for text in self._readings(parameter):
            found = self._index.find(text)
            if found is not None:
                return self._meant[found]
        return self._by_word(parameter) or self._by_initial(parameter)

    @staticmethod
    def _readings(parameter: str) -> list[str]:
        _, opening, remark = parameter.partition("(")
        remarks = (remark.partition(")")[0],) if opening else ()
        return [*remarks, *argument_readings(parameter)]

    def _by_word(self, parameter: str) -> str | None:
        """``the_second_pickupable``: exactly one type among the words."""
        words = {fold(w).rstrip("0123456789") for w in _WORD_PART.findall(parameter)}
        found = {self._meant[name] for name in self._meant if fold(name) in words}
        return found.pop() if len(found) == 1 else None

    def _by_initial(self, parameter: str) -> str | None:
        """``?r``, ``?p1``: exactly one type begins with it."""
        letters = fold(parameter).rstrip("0123456789")
        if not 1 <= len(letters) <= 4:
            return None
        found = {t for t in self._names.times if fold(t).startswith(letters)}
        return found.pop() if len(found) == 1 else None
