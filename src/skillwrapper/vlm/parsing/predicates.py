"""Reading proposed predicates out of a reply."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from skillwrapper.symbols.predicates import Predicate
from skillwrapper.vlm.parsing.calls import argument_value, find_calls
from skillwrapper.vlm.parsing.lines import excerpt, plain_lines, without_lead
from skillwrapper.vlm.parsing.names import NameIndex, fold
from skillwrapper.vlm.parsing.structured import flatten_json

_LABEL = re.compile(
    r"^(?:(?:the\s+)?(?:best\s+|new\s+|final\s+|proposed\s+|next\s+|second\s+|first\s+)*"
    r"(?:predicate|candidate|proposal|answer|name|signature|option)s?"
    r"(?:\s+(?:name|candidate|signature))?\s*#?\s*\d{0,2})\s*[:=-]+\s*",
    re.IGNORECASE,
)
_NAME = r"[A-Za-z][\w-]*(?: [A-Za-z][\w-]*){0,5}"
_SIGNATURE = re.compile(rf"^[\"']?({_NAME})[ ]?\(((?:[^()\n]|\([^()\n]*\))*+)\)[\"']?\s*")
_NULLARY = re.compile(r"^[\"']?([A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)+)[\"']?\s*(?=[:=|]|-\s|->)")
_LISP = re.compile(r"^\(([A-Za-z][\w-]*)((?:\s+\??[A-Za-z][\w-]*(?:\s+-\s+[\w-]+)?)*+)\s*\)\s*")
_SEPARATOR = re.compile(r"^(?:[:=|;.-]|->|=>|:=|means\b|is true (?:if|when|iff)\b)[\s:=|>-]*")
_MEANING = re.compile(
    r"^(?:semantics?|semantic meaning|meaning|definition|description|explanation|true when)"
    r"\s*[:=-]+\s*",
    re.IGNORECASE,
)
_LONGEST_NAME = 60
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
    resolver = _TypeResolver(names)
    found: dict[tuple[str, tuple[str, ...]], Predicate] = {}
    unusable = []
    for proposal in _proposals(plain_lines(flatten_json(reply))):
        predicate = _check(proposal, resolver)
        if isinstance(predicate, str):
            unusable.append(excerpt(predicate, 200))
        else:
            found.setdefault((predicate.name, predicate.types), predicate)
    if not found and not unusable:
        unusable.append(f"no predicate in the reply: '{excerpt(reply)}'")
    return ParsedPredicates(tuple(found.values()), tuple(unusable))


def _proposals(lines: Sequence[str]) -> Iterator[_Proposal]:
    texts = [_LABEL.sub("", without_lead(line), count=1).strip() for line in lines]
    for number, text in enumerate(texts):
        read = _read_signature(text)
        if read is None:
            continue
        name, parameters, rest = read
        semantics = _semantics_of(rest)
        if semantics is None:
            semantics = "" if rest.strip("|\"',.: ") else _semantics_below(texts[number + 1 :])
        if semantics or rest == "":
            yield _Proposal(name, parameters, semantics or "")


def _read_signature(text: str) -> tuple[str, tuple[str, ...], str] | None:
    """Name, parameters and what follows, if a line begins with a predicate."""
    named = _SIGNATURE.match(text)
    if named:
        inside = re.split(r"[,;]", named.group(2))
        parameters = tuple(part.strip() for part in inside if part.strip())
        return named.group(1), parameters, text[named.end() :]
    lisp = _LISP.match(text)
    if lisp:
        typed = re.findall(r"\??[A-Za-z][\w-]*(?:\s+-\s+[\w-]+)?", lisp.group(2))
        return lisp.group(1), tuple(typed), text[lisp.end() :]
    nullary = _NULLARY.match(text)
    if nullary:
        return nullary.group(1), (), text[nullary.end() :]
    return None


def _semantics_of(rest: str) -> str | None:
    """The meaning behind a separator, or None if there is no separator."""
    separator = _SEPARATOR.match(rest)
    return _tidy(rest[separator.end() :]) if separator else None


def _semantics_below(texts: Sequence[str]) -> str | None:
    """The meaning in one of the next lines: labelled, or the next line of prose."""
    near = [text for text in texts[: _LOOK_AHEAD + 1] if text][:_LOOK_AHEAD]
    labelled = next((text for text in near if _MEANING.match(text)), None)
    if labelled is not None:
        return _tidy(labelled)
    if near and " " in near[0] and not find_calls(near[0]) and near[0][-1] not in ":?":
        return _tidy(near[0])
    return None


def _tidy(text: str) -> str:
    text = _MEANING.sub("", " ".join(text.split()), count=1)
    return text.strip().strip("|\"' ").strip()


def _check(proposal: _Proposal, resolver: _TypeResolver) -> Predicate | str:
    name = re.sub(r"\W+", "_", proposal.name.strip(), flags=re.ASCII).strip("_")
    written = f"{name}({', '.join(proposal.parameters)})"
    if not re.match(r"^[A-Za-z]", name) or len(name) > _LONGEST_NAME:
        return f"{written}: expected a short name that starts with a letter"
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


class _TypeResolver:
    """Finds the allowed type that a written parameter stands for."""

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
        declared = re.split(r"\s+-\s+|:|\s+of type\s+|\s+as\s+", parameter, maxsplit=1)
        inner = re.search(r"\(([^()]*)\)", parameter)
        readings = [inner.group(1)] if inner else []
        readings += [argument_value(part) for part in reversed(declared)]
        return [text for text in readings if text]

    def _by_word(self, parameter: str) -> str | None:
        """``the_second_pickupable``: exactly one type among the words."""
        words = {fold(w).rstrip("0123456789") for w in re.split(r"[\W_]+", parameter)}
        found = {self._meant[name] for name in self._meant if fold(name) in words}
        return found.pop() if len(found) == 1 else None

    def _by_initial(self, parameter: str) -> str | None:
        """``?r``, ``?p1``: exactly one type begins with it."""
        letters = fold(parameter).rstrip("0123456789")
        if not 1 <= len(letters) <= 4:
            return None
        found = {t for t in self._names.times if fold(t).startswith(letters)}
        return found.pop() if len(found) == 1 else None
