"""What a sentence denies: ``not on the board`` speaks of the board, and says that it is not there.

Undecided rather than wrong: where something is denied, or only possible, wanted or over, and it is
not clear what, nothing is taken to be said.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from enum import Enum

from skillwrapper.embedded.concepts import Concept

Span = tuple[int, int]

_NOT = (
    r"not|no|no longer|without|rather than|instead of|non|un(?=-)"
    r"|\w+n['\N{RIGHT SINGLE QUOTATION MARK}]t"
)
_OTHERWISE = (
    r"never|cannot|nothing|none|nobody|no ?one|nowhere|neither|nor|except|but|unless|lacks?|lacking"
    r"|absent|absence|fail(?:s|ed)? to|off|away|left (?:its|the|his)|removed|taken out|out of"
    r"|far from|hardly|barely|scarcely|rarely|seldom|refus(?:es?|ed|ing)|avoid(?:s|ed|ing)?"
    r"|no more|zero|false that|missing|gone|other than|clear of|free(?= of\b|\W*$)"
    r"|insufficient(?:ly)?|too \w+ to|exempt|stranger|contrary|forbidden|prohibited|banned"
    r"|dropp(?:ed|ing)|let go|releas(?:es?|ed|ing)|stop(?:s|ped|ping)?|ceas(?:es?|ed|ing)"
    r"|(?:lift|took|take|pull|push|slid|fell|fallen|mov|remov|clear)(?:es|s|n|ed|ing)?"
    r" (?:\w+ ){0,3}?from"
    r"|prevent(?:s|ed|ing)?|reject(?:s|ed)?|den(?:y|ies|ied)|declin(?:es?|ed)|impossible|unable"
    r"|(?<=free of )(?:the )?(?:robot|hand|gripper|arm)|(?<=free from )(?:the )?(?:robot|hand)"
)
_NOT_SO_NOW = (
    r"can(?! (?:clearly )?(?:be )?seen)|could|may|might|must|should|shall|will|would|about to"
    r"|ready (?:to|for)|able to|going to|needs? to|supposed to|meant to|to be|used to|formerly"
    r"|previously|almost|nearly|half|halfway|partly|partially|sometimes|tr(?:ies|ying) to"
    r"|attempt(?:s|ing)? to|wants? to|expected|ought|belongs?|only in|imagin\w+|await\w*|pre(?=-)"
    r"|pretend\w*|seems? to have been|soon|later|before (?:long|it|being|the)|planned|intended|due"
    r"|(?:was|were|had been) (?=on|in|at|under|near|held|placed)"
)
_ELSEWHERE = (
    r"under(?:neath)?|below|beneath|behind|beyond|apart|excluded|separated?|detached|other side"
    r"|way to|reach(?:es|ed|ing)?|candidate|for (?:the|a)|hanging|hovering"
)
_IN_DOUBT = (
    r"un(?:true|likely|certain|clear)|wrong|doubt\w*|hypothetical\w*|opposite|less than"
    r"|incomplete\w*|only on|lost|los(?:es|ing)|g[ia]ve(?:s|n)? up|giving up"
    r"|quit(?:s|ting)?|finish(?:es|ed|ing)?"
)
_NOT_PATTERN = re.compile(rf"\b(?:{_NOT})\b", re.IGNORECASE)
_DENIAL = re.compile(
    rf"\b(?:{_NOT}|{_OTHERWISE}|{_NOT_SO_NOW}|{_ELSEWHERE}|{_IN_DOUBT})\b", re.IGNORECASE
)
_BESIDE_THE_POINT = re.compile(
    r"\b(?:with|and|without) (?:nothing|anything|no(?: other)? \w+|any(?:thing)? other \w+)"
    r"(?: else)?(?: \w+)? (?:in )?between(?: \w+)?|\bnot only\b|\bwhether or not\b",
    re.IGNORECASE,
)
_FILLING = re.compile(
    r"\W*\b(?:an?|the|any|its|one|yet|been|being|be|have|has|having|with|in|very|fully|currently"
    r"|already|longer)\b",
    re.IGNORECASE,
)
_MOST_FILLING = 4


class Said(Enum):
    """What a text says of a concept."""

    YES = "yes"
    NOTHING = "nothing"
    DENIED = "denied"
    """It speaks of the concept and denies something, and perhaps the concept."""
    UNCLEAR = "unclear"
    """It does not speak of the concept, and denies something."""


def what_is_said(concept: Concept, opposite: Concept | None, text: str) -> Said:
    """Whether a text says that a concept holds.

    Args:
        concept: by the words that give it away; these may hold a denial of their own.
        opposite: the concept that holds when it does not, if there is one: ``not raw``.
        text: a sentence, or the words of a name.
    """
    clear = _BESIDE_THE_POINT.sub(" ", text)
    own = [match.span() for match in concept.pattern.finditer(clear)]
    turned = set(_turned(opposite, clear)) if opposite is not None else set()
    open_denials = [
        denial
        for denial in (match.span() for match in _DENIAL.finditer(clear))
        if denial not in turned and not _is_part(denial, own, concept, clear)
    ]
    if own or turned:
        return Said.DENIED if open_denials else Said.YES
    return Said.UNCLEAR if open_denials else Said.NOTHING


def _turned(opposite: Concept, text: str) -> Iterator[Span]:
    """Denials that stand directly before what gives the opposite away."""
    for denial in _NOT_PATTERN.finditer(text):
        place = denial.end()
        for _ in range(_MOST_FILLING):
            after = re.compile(r"\W*").match(text, place)
            if after is not None and opposite.pattern.match(text, after.end()):
                yield denial.span()
                break
            filling = _FILLING.match(text, place)
            if filling is None:
                break
            place = filling.end()


def _is_part(denial: Span, own: list[Span], concept: Concept, text: str) -> bool:
    """Whether a denial is one of the words that give a concept away, and does not merely stand
    between them.
    """
    if not any(_overlap(denial, span) for span in own):
        return False
    start, end = denial
    masked = f"{text[:start]}{'x' * (end - start)}{text[end:]}"
    return not any(_overlap(denial, m.span()) for m in concept.pattern.finditer(masked))


def _overlap(one: Span, other: Span) -> bool:
    return one[0] < other[1] and other[0] < one[1]
