"""Verdicts in languages other than English: read where they are plain, never guessed."""

from __future__ import annotations

import pytest

from skillwrapper.symbols import Atom
from skillwrapper.vlm.parsing import parse_labels
from skillwrapper.vlm.parsing.languages import LANGUAGES

HELD, CUT = Atom("holding", ("robot", "patty")), Atom("is_cut", ("lettuce",))
VALUES = {"true": True, "false": False, "unsure": None}
WORDS = [
    pytest.param(word, value, id=f"{name}, {word}")
    for name, language in LANGUAGES.items()
    for kind, value in VALUES.items()
    for word in getattr(language, kind).split()
]


def test_the_languages_are_many() -> None:
    assert len(LANGUAGES) >= 25


@pytest.mark.parametrize(("word", "value"), WORDS)
def test_every_word_is_read_in_every_manner(word: str, value: bool | None) -> None:
    for reply in (
        f"{HELD}: {word}\n{CUT}: {word}",
        f"- **{HELD}** \u2014 {word.title()}.\n- **{CUT}** \u2014 {word.title()}.",
        f"{HELD}\n{word}\n\n{CUT}\n{word}",
        f"| {HELD} | {word} |\n| {CUT} | {word} |",
        f'{{"{HELD}": "{word}", "{CUT}": "{word}"}}',
    ):
        assert parse_labels(reply, (HELD, CUT)).labels == {HELD: value, CUT: value}, reply


@pytest.mark.parametrize(
    ("reply", "value"),
    [
        (f"{HELD} ist wahr, weil die Hand etwas hält.", True),
        (f"{HELD} est fausse : la main est vide", False),
        (f"{HELD}: Sí, el robot lo sostiene", True),
        (f"{HELD}は偽です。", False),
        (f"{HELD}为真。", True),
        (f"{HELD}는 참입니다.", True),
        (f"{HELD}: सही है", True),
        (f"{HELD}: नहीं, रोबोट का हाथ खाली है", False),
        (f"{HELD}: हाँ।", True),
        (f"{HELD}: nicht wahr", False),
        (f"{HELD}: không đúng", False),
        (f"{HELD}: לא נכון", False),
        (f"{HELD}: nem hamis", True),
        (f"{HELD} non è vero", False),
        (f"答案\uff1a{HELD}\uff1a假", False),
        (f"falsch: {HELD}", False),
    ],
)
def test_what_is_plain_is_read(reply: str, value: bool) -> None:
    assert parse_labels(reply, (HELD, CUT)).labels == {HELD: value}


@pytest.mark.parametrize(
    "reply",
    [
        f"{HELD}: सही नहीं",
        f"{HELD}: सत्य नहीं है",
        f"{HELD}: wahr ist das nicht",
        f"{HELD}: true it is not",
        f"{HELD}: correct, it isn't",
        f"{HELD}: doğru değil",
        f"{HELD}: wahr oder falsch",
        f"{HELD}: vrai ou faux ?",
        f"{HELD}: 是/否",
        f"{HELD}: wahr, nein falsch",
        f"{HELD}: да, но нет",
        f"{HELD}: true, but no",
        f"{HELD}: pas forcément vrai",
        f"Wenn {HELD} wahr, {CUT}: falsch",
        f"Si {HELD} vrai, {CUT}: faux",
        f"如果 {HELD} 真, {CUT}: 假",
        f"Если {HELD} верно, {CUT}: ложь",
        f"अगर {HELD} सही, {CUT}: गलत",
        f"{HELD} oder {CUT} ist wahr",
        f"{HELD} ou {CUT} : vrai",
        f"nicht klar: {HELD}",
    ],
)
def test_what_can_be_read_in_two_ways_is_missing(reply: str) -> None:
    assert parse_labels(reply, (HELD, CUT)).labels == {}
