"""The words and signs with which models judge, and what a stretch of text says by them.

A verdict is True, False, or None for "it cannot be told". A stretch that says two things says
nothing: ``Said.AMBIGUOUS``.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from enum import Enum, StrEnum
from typing import NamedTuple

from skillwrapper.vlm.parsing.languages import MARKS_OF_SCRIPTS, words_for
from skillwrapper.vlm.parsing.names import words_of


class Family(StrEnum):
    """Of which kind a verdict is; some only count where the rest of a reply bears them out."""

    WORD = "word"
    LETTER = "letter"
    DIGIT = "digit"
    MARK = "mark"
    CROSS = "x"
    BOX = "box"


_STRONG = frozenset((Family.WORD, Family.MARK, Family.BOX))


class Verdict(NamedTuple):
    """A judgement: True, False or None, and how it was written."""

    value: bool | None
    family: Family = Family.WORD


class Said(Enum):
    """What a stretch of text says if it is no verdict."""

    NOTHING = "nothing"
    FILLING = "small words"
    NUMBER = "a number"
    AMBIGUOUS = "two things"


Reading = Verdict | Said

_TRUE = "true yes holds hold correct satisfied affirmative fulfilled met case"
_FALSE = "false no untrue incorrect unsatisfied wrong"
_UNSURE = (
    "unsure unknown uncertain unclear undetermined indeterminate undecided ambiguous maybe possibly"
    " perhaps none null n/a na undeterminable"
)
_WORDS: dict[str, Verdict] = {
    **dict.fromkeys(words_for("true"), Verdict(True)),
    **dict.fromkeys(words_for("false"), Verdict(False)),
    **dict.fromkeys(words_for("unsure"), Verdict(None)),
    **{word: Verdict(True) for word in _TRUE.split()},
    **{word: Verdict(False) for word in _FALSE.split()},
    **{word: Verdict(None) for word in _UNSURE.split()},
    **dict.fromkeys(("t", "y"), Verdict(True, Family.LETTER)),
    **dict.fromkeys(("f", "n"), Verdict(False, Family.LETTER)),
    "1": Verdict(True, Family.DIGIT),
    "0": Verdict(False, Family.DIGIT),
    **dict.fromkeys("x☒", Verdict(False, Family.CROSS)),
    **dict.fromkeys("✓✔✅👍🟢⭕√", Verdict(True, Family.MARK)),
    **dict.fromkeys("✗✘❌👎🔴✖\u00d7🚫", Verdict(False, Family.MARK)),
    **dict.fromkeys("⚠?❓❔🤷", Verdict(None, Family.MARK)),
    "☑": Verdict(True, Family.BOX),
    "☐": Verdict(False, Family.BOX),
}
_FOREIGN = frozenset[str]().union(*map(words_for, ("true", "false", "unsure")))
_ALONE = _FOREIGN.union(words_of("yes no met hold right wrong none na"))
"""Words that are verdicts only where they stand for themselves: "no item" is none."""
_NOT = words_for("negation").union(
    words_of("not isn't isnt aren't doesn't doesnt don't never wasn't ain't ¬")
)
_SMALL = words_for("small").union(
    words_of(
        "is are be being was the a an statement atom predicate grounding fact this that it its "
        "it's therefore thus hence so answer value label verdict truth result conclusion status "
        "judgement judgment final my likely probably clearly definitely certainly obviously also "
        "still here evaluates evaluated to as marked judged considered deemed labelled labeled "
        "indeed currently now should must does do in picture image scene for i say think"
    )
)
_NOUNS = frozenset(
    words_of("statements atoms predicates groundings facts ones following all grounded these")
)
_ENDINGS = words_for("ending")
_CAUSE = words_for("reason").union(words_of("because since as for given due based according"))
_REASON = _CAUSE.union(words_of("the it there i in here"))
_CONDITION = frozenset(
    words_of(
        "if unless when whenever only except provided assuming or until once iff whether than "
        "enough positive negative positives negatives alarm before beforehand earlier previously "
        "initially originally formerly"
    )
)
_CORRECTION = frozenset(
    words_of(
        "wait actually correction sorry hmm oops scratch strike rather instead or if unless "
        "provided assuming depending"
    )
)
_CHATTER = frozenset(words_of("here let sure certainly of okay ok below i'll i'd thanks as now"))
_OTHERS = frozenset(["others", "other", "rest", "remaining", "everything", "else"])
_SUPPOSED = words_for("condition").union(
    words_of("if unless whether assuming suppose supposing either neither when")
)
_LINKS = words_for("link").union(("and", "or", "nor", "&", "/", "and/or", "as well as"))
_INFERENCE = re.compile(
    r"\b(?:impl(?:y|ies)|entails?|iff|if and only if|whenever)\b", re.IGNORECASE
)
_UNSURE_PHRASE = re.compile(
    r"\b(?:(?:can(?:not|'t| not)|could(?: not|n't)|unable|impossible|hard|difficult)"
    r"(?: be)?(?: to)? (?:tell|told|say|said|see|seen|determined?|judged?|decided?|assess(?:ed)?"
    r"|verif(?:y|ied)|confirm(?:ed)?)"
    r"|not (?:sure|certain|clear|visible|determinable|known|mentioned|stated|specified|enough)"
    r"|insufficient|either way)\b",
    re.IGNORECASE,
)
_CHOICE_WORD = r"(?:true|false|yes|no|unsure|unknown|uncertain)"
_CHOICE = re.compile(
    rf"[(\[<]?\b{_CHOICE_WORD}(?: ?(?:[/|]|\bor\b) ?{_CHOICE_WORD}\b){{1,3}}[)\]>]?\??", re.I
)
_SEGMENT = re.compile(r"[,;:|()\[\]{}\"=]|(?:(?<= )|^)-{1,3}(?= |$)|-{0,2}>|[.!](?= |$)")
_MARKS = "".join(word for word in _WORDS if not word.isalnum() and len(word) == 1)
_LETTER = rf"(?:[^\W_]|[{MARKS_OF_SCRIPTS}])"
_WORD = re.compile(rf"n/a|{_LETTER}++(?:['-]{_LETTER}++){{0,8}}|[{_MARKS}¬]", re.I)
_SENTENCE_END = re.compile(r"[.;!?](?= |$)")
_BOX = re.compile(r"\[ ?([xX✓✔]?) ?\]")
_NOT_IN_FRONT = re.compile(r"(?:\bnot(?: |(?=\())|[¬~]|(?:^|(?<=[ (]))!) ?\(?$", re.IGNORECASE)
_ANSWER_NUMBER = re.compile(r"a\d{1,3}")
_LONGEST = 400
_PHRASE_STARTS_BY = 24
_CLAUSE, _FEW = 60, 3


def is_verdict(word: str) -> bool:
    """Whether a word says that something is true, is false or cannot be told."""
    return word.casefold() in _WORDS


def is_nothing_but_verdict(text: str) -> bool:
    """Whether a text gives a verdict, and neither reasons nor anything else."""
    return len(text) < _LONGEST and isinstance(_phrase(_words(text)), Verdict)


def is_supposed(text: str) -> bool:
    """Whether text in front of a statement makes it no claim: ``if S``."""
    words = text[-40:].casefold().split()[-4:]
    return not _SUPPOSED.isdisjoint(word.strip("(,:;\"'") for word in words)


def ends_sentence(text: str) -> bool:
    """Whether a sentence ends in the text between two statements."""
    return _SENTENCE_END.search(text[-_LONGEST:]) is not None


def is_link(text: str) -> bool:
    """Whether text between two statements makes one claim of them: ``S or T is true``."""
    return text[:20].strip(" ,").casefold() in _LINKS


def is_inference(text: str) -> bool:
    """Whether text between two statements infers one from the other: ``S is false implies T``."""
    return _INFERENCE.search(text[:_LONGEST]) is not None


def borne_out(said: Sequence[Reading]) -> frozenset[Family]:
    """The kinds of verdicts that count in a reply that says all this.

    Letters and digits count where no word is used: letters if there are several, digits if there
    are no numbers but 0 and 1. Crosses count beside ticks, and empty boxes beside ticked ones.
    """
    times = Counter(said)
    verdicts = [reading for reading in times if isinstance(reading, Verdict)]
    letters = sum(times[v] for v in verdicts if v.family is Family.LETTER)
    worded = any(v.family is Family.WORD and v.value is not None for v in verdicts)
    ticked = any(v.family in {Family.MARK, Family.BOX} and v.value is True for v in verdicts)
    boxed = Verdict(True, Family.BOX) in verdicts
    counts = {
        Family.WORD: True,
        Family.MARK: True,
        Family.LETTER: not worded and letters > 1,
        Family.DIGIT: not worded and Said.NUMBER not in times,
        Family.CROSS: ticked,
        Family.BOX: boxed,
    }
    return frozenset(family for family, is_so in counts.items() if is_so)


def said_behind(text: str) -> Reading:
    """What the text behind a statement says of it.

    The verdict comes first, small words aside; what follows may give reasons. If it says something
    else as well, takes it back, makes it depend on something or asks, the text says two things.
    """
    first: Reading = Said.NOTHING
    for segment in _segments(text):
        said = _said(segment)
        if isinstance(first, Verdict):
            if _contradicts(first, said, segment):
                return Said.AMBIGUOUS
        elif said is not Said.FILLING:
            if not isinstance(said, Verdict):
                return said
            first = said
    return first


def said_in_front(text: str) -> tuple[Reading, bool]:
    """What the text in front of a statement says of it, and whether the statement is negated.

    Only words and marks that stand right before it count: ``true: S``, ``[x] S``, ``It is false
    that S``.
    """
    negation = _NOT_IN_FRONT.search(text[-12:])
    if negation:
        text = text[: len(text) - len(negation.group())]
        if _NOT_IN_FRONT.search(text[-12:]):
            return Said.AMBIGUOUS, True
    found: Reading = Said.NOTHING
    for segment in reversed(_segments(text[-_LONGEST:])):
        said = _said(segment, in_front=True)
        if said is Said.FILLING:
            continue
        if not isinstance(said, Verdict):
            return (said if said is Said.AMBIGUOUS else found), negation is not None
        if isinstance(found, Verdict) and said.value is not found.value:
            return Said.AMBIGUOUS, negation is not None
        found = said
    return found, negation is not None


def said_alone(text: str) -> Reading:
    """What a line without a statement says of one next to it."""
    said = said_behind(text)
    if not isinstance(said, Verdict) or said.family in {Family.DIGIT, Family.CROSS}:
        return Said.NOTHING
    if "?" in text[:_LONGEST] or not _OTHERS.isdisjoint(_words(text[:_LONGEST])):
        return Said.NOTHING
    return said if _is_judgement(text) else Said.NOTHING


def _is_judgement(text: str) -> bool:
    """Whether a line gives a verdict, perhaps with a reason: "Yes, here they are" does not."""
    pieces = [_words(segment) for segment in _segments(text)]
    first = next(n for n, words in enumerate(pieces) if _phrase(words) is not Said.FILLING)
    verdict_at = next((n for n, word in enumerate(pieces[first]) if word in _WORDS), None)
    behind = pieces[first][verdict_at + 1 :][:1] if verdict_at is not None else []
    following = pieces[first + 1][:1] if len(pieces) > first + 1 else []
    return _REASON.issuperset(behind) and _CHATTER.isdisjoint(following)


def said_as_heading(text: str, *, titled: bool) -> Reading:
    """What a heading like ``True:`` or ``The following statements are false`` says.

    Args:
        text: the line.
        titled: whether the line is marked as a heading.
    """
    words = _words(text[:_LONGEST]) if len(text) < _LONGEST else []
    plural = not _NOUNS.isdisjoint(words)
    if not (titled or plural or text.endswith(":")) or not _OTHERS.isdisjoint(words):
        return Said.NOTHING
    said = _phrase([word for word in words if word not in _NOUNS and not word.isdigit()])
    return said if isinstance(said, Verdict) and said.family is not Family.LETTER else Said.NOTHING


def _segments(text: str) -> list[str]:
    """The pieces between signs; verdicts that one is to choose from are left out."""
    text = text[:_LONGEST]
    if "[" in text:
        text = _BOX.sub(lambda box: " ☑ " if box.group(1) else " ☐ ", text)
    if "/" in text or "|" in text or " or " in text:
        text = _CHOICE.sub(" ", text)
    return [segment for part in _SEGMENT.split(text) if (segment := part.strip())]


def _words(text: str) -> list[str]:
    return [word.casefold() for word in _WORD.findall(text)]


def _said(segment: str, *, in_front: bool = False) -> Reading:
    words = _words(segment)
    if in_front:
        words = [word for word in words if not word.isdigit()]
    said = _phrase(words, in_front=in_front)
    if said is Said.NOTHING:
        phrase = _UNSURE_PHRASE.search(segment)
        if phrase and phrase.start() <= _PHRASE_STARTS_BY:
            return Said.AMBIGUOUS if in_front else Verdict(None)
    return said


def _phrase(words: Sequence[str], *, in_front: bool = False) -> Reading:
    """What words say: small ones, perhaps a negation, then a verdict."""
    negated = False
    for number, word in enumerate(words):
        rest = words[number + 1 :]
        is_negation = word in _NOT and bool(rest)
        if word in _WORDS and rest[:1] != ["longer"] and not is_negation:
            verdict = _WORDS[word]
            if in_front and (
                verdict.family in {Family.LETTER, Family.CROSS} or not _SMALL.issuperset(rest)
            ):
                return Said.NOTHING
            return _judged(word, verdict, rest, negated=negated)
        if is_negation or word in _NOT or word == "no":
            negated = not negated
        elif word.isdigit() and all(w.isdigit() for w in words):
            return Said.NUMBER
        elif word not in _SMALL and word != "longer" and not _ANSWER_NUMBER.fullmatch(word):
            return Said.NOTHING
    return Said.NOTHING if negated else Said.FILLING


def _judged(word: str, verdict: Verdict, rest: Sequence[str], *, negated: bool) -> Reading:
    """A verdict with what stands behind it in the same piece."""
    rest = [] if _ENDINGS.issuperset(rest) else rest
    following = _WORDS.get(rest[0], verdict) if rest else verdict
    depends = _CONDITION.intersection(rest[:1]) or {"if", "unless", "or"}.intersection(rest[:4])
    if "?" in rest or depends or following.value is not verdict.value or _is_taken_back(rest):
        return Said.AMBIGUOUS
    if rest and verdict.family not in _STRONG:
        return Said.NUMBER if verdict.family is Family.DIGIT else Said.NOTHING
    if rest and word in _ALONE and rest[0] not in _REASON:
        return Said.NOTHING
    if negated and (verdict.value is None or word in {"yes", "no"}):
        return Said.AMBIGUOUS
    return Verdict(not verdict.value) if negated else verdict


def _is_taken_back(rest: Sequence[str]) -> bool:
    """Whether words behind a verdict deny it, rather than giving reasons: ``true it is not``."""
    reasons = next((n for n, word in enumerate(rest) if word in _CAUSE), len(rest))
    return not _NOT.isdisjoint(rest[:reasons])


def _contradicts(first: Verdict, said: Reading, segment: str) -> bool:
    """Whether a later piece takes back or changes what was said first: ``да, но нет``."""
    if isinstance(said, Verdict):
        return said.family in _STRONG and said.value is not first.value
    words = _words(segment[:_CLAUSE])
    others = {word for word in words if _WORDS.get(word, first).value is not first.value}
    ending = set(words[-1:]) if len(words) <= _FEW else set()
    denied = first.value is True and not _NOT.isdisjoint(ending)
    begins = set(words[:1]) & (others & _FOREIGN | _CORRECTION)
    return said is Said.AMBIGUOUS or bool(begins or ending & others) or denied
