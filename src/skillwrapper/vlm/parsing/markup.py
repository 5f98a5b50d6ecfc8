"""Lines as models write them, without markup and odd signs."""

from __future__ import annotations

import html
import re
import unicodedata
from typing import NamedTuple

from skillwrapper.vlm.parsing.memory import remembering

_NEW_LINE_TAG = re.compile(r"</?(?:br|p|li|ul|ol|tr|table|thead|tbody|div)\s?/?>", re.IGNORECASE)
_CELL_TAG = re.compile(r"</t[dh]>\s?", re.IGNORECASE)
_TAG = re.compile(
    r"</?(?:b|i|em|strong|code|pre|sub|sup|hr|td|th|span|u|tool_call|tools|json)\s?/?>", re.I
)
_DELETED = re.compile(
    r"~~[^~\n]{1,400}~~|<(?:del|s|strike)>[^<\n]{0,400}</(?:del|s|strike)>", re.IGNORECASE
)
_ESCAPED = re.compile(r"\\([_*()\[\]<>#|-])")
_FENCE = re.compile(r"(?:> ?)?(?:```|~~~)[\w+-]{0,20}")
_LEADS = re.compile(
    r"(?:[#>| ]++|[-+\u2022\u2023\u25aa\u25cf\u25e6](?![>(\w]) ?|[-+](?=\w)|\([a-zA-Z]\) "
    r"|[(\[]\d{1,3}[)\]] ?|\(?\d{1,3}[.):]{1,2}(?!\d) ?|[a-zA-Z]\) "
    r"|step ?\d{1,3} ?[.:)-]{0,3} ?){1,5}+",
    re.IGNORECASE,
)
_NUMBER = re.compile(r"[ #-]{0,9}\(?(\d{1,3})[.):]")
_BOLD = re.compile(r"[-+># \d.)]{0,12}(?:\*\*|__)")
_SIGNS = {
    **dict.fromkeys(
        "\u201c\u201d\u201e\u201f\u00ab\u00bb\u300c\u300d\u300e\u300f\u3010\u3011", '"'
    ),
    **dict.fromkeys("\u300a\u300b\u3008\u3009\u2033\u301d\u301e\u301f", '"'),
    **dict.fromkeys("\u2018\u2019\u201a\u201b\u2039\u203a\u2032\u00b4", "'"),
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015\u2212\u2043\u2e3a\u2e3b\ufe58", "-"),
    **dict.fromkeys("\u2192\u21d2\u279c\u27a1\u27f6\u27f9\u21a6\u2794\u279e\u25b8\u25b6", "->"),
    **dict.fromkeys("\u3001\u060c\u066b", ","),
    **dict.fromkeys("\u3002\uff61\u0964", "."),
    **dict.fromkeys("\u061b\u037e", ";"),
    "\u061f": "?",
    "\ufe0f": "",
}
_PLAIN_SIGNS = str.maketrans(_SIGNS)
_CIRCLED = str.maketrans({chr(0x2460 + n): f"{n + 1}. " for n in range(20)})
_KEY = re.compile(r"([A-Za-z][A-Za-z _-]{1,30}?) ?#?\d{0,3} ?[:=] ?(?=(.*+))")


class Line(NamedTuple):
    """One line of a reply.

    Attributes:
        text: what it says, without list marker, number or heading sign; blanks are single.
        whole: the same with all of them.
        number: what it is listed under, if it is.
        listed: whether it has a list marker, a number or a table bar.
        titled: whether it is marked as a heading.
        bold: whether it begins in bold.
        key: what stands before its first colon, if that is a few words.
        value: what stands behind that colon.
    """

    text: str
    whole: str
    number: int | None = None
    listed: bool = False
    titled: bool = False
    bold: bool = False
    key: str = ""
    value: str = ""


def without_tags(text: str) -> str:
    """A text without HTML: its rows and items are lines, its cells stand between bars."""
    if "&" in text:
        text = html.unescape(text)
    if "~~" in text or "<" in text:
        text = _DELETED.sub("", text)
    if "<" in text:
        text = _TAG.sub("", _CELL_TAG.sub(" | ", _NEW_LINE_TAG.sub("\n", text)))
    return text


def _plain_line(written: str) -> Line:
    """One line without markup; the fence of a code block is an empty line."""
    text = written
    if not text.isascii():
        text = unicodedata.normalize("NFKC", text.translate(_CIRCLED)).translate(_PLAIN_SIGNS)
    text = text.strip()
    if ("```" in text or "~~~" in text) and _FENCE.fullmatch(text):
        return Line("", "")
    bold = ("**" in text or "__" in text) and _BOLD.match(text) is not None
    if "\\" in text:
        text = _ESCAPED.sub(r"\1", text)
    if "*" in text or "`" in text:
        text = text.replace("*", "").replace("`", "")
    whole = _with_single_blanks(text)
    text = _without_lead(whole)
    if text == whole and not bold and ":" not in text and "=" not in text:
        return Line(text, whole)
    number = _NUMBER.match(whole) if len(text) < len(whole) else None
    field = _KEY.match(text)
    return Line(
        text,
        whole,
        int(number.group(1)) if number else None,
        len(text) < len(whole),
        whole.startswith("#"),
        bold,
        field.group(1) if field else "",
        field.group(2) if field else "",
    )


plain_line = remembering(_plain_line, len)


def without_lead(line: Line) -> Line:
    """What a line says, whatever it is listed under."""
    return Line(line.text, line.text, titled=line.titled, bold=line.bold)


def _with_single_blanks(text: str) -> str:
    if text.isascii() and "  " not in text and "\t" not in text:
        return text.strip()
    return " ".join(text.split())


def _without_lead(line: str) -> str:
    """A line without its list marker, number, heading sign or table bar."""
    leads = _LEADS.match(line)
    return line[leads.end() :].strip() if leads else line
