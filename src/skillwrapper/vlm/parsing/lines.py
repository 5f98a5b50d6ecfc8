"""From a reply as models write it to plain lines: no markdown, no thinking aloud, no odd signs."""

from __future__ import annotations

import re
import unicodedata

_LONGEST_REPLY = 200_000
_THINKING = re.compile(r"<(think|thinking|reasoning|scratchpad)>.*?(?:</\1>|\Z)", re.DOTALL | re.I)
_TAG = re.compile(r"</?(?:br|b|i|p|li|ul|ol|em|strong|code|pre|sub|sup|hr)\s?/?>", re.IGNORECASE)
_ESCAPED = re.compile(r"\\([_*()\[\]<>#-])")
_FENCE = re.compile(r"^[ \t>]*(?:```|~~~)[\w-]*[ \t]*$", re.MULTILINE)
_LEAD = re.compile(
    r"^\s*(?:[#>|\s]+|[-+•·‣▪»]\s*|\(?\d{1,3}[.):]+(?!\d)\s*|\([a-zA-Z]\)\s*|[a-zA-Z]\)\s+"
    r"|step\s*\d{1,3}\s*[.:)-]*\s*)",
    re.IGNORECASE,
)
_PLAIN_SIGNS = {
    **dict.fromkeys("\u201c\u201d\u00ab\u00bb", '"'),
    **dict.fromkeys("\u2018\u2019", "'"),
    **dict.fromkeys("\u2010\u2011\u2012\u2013\u2014\u2015\u2212", "-"),
    **dict.fromkeys("\u2192\u21d2", "->"),
    **dict.fromkeys("*`", ""),
}
_PLAIN = str.maketrans(_PLAIN_SIGNS)
_DEEPEST_LEAD = 5


def plain_lines(reply: str) -> list[str]:
    """The lines of a reply without markup; empty lines are kept, code fences become empty."""
    text = unicodedata.normalize("NFKC", reply[:_LONGEST_REPLY])
    text = _FENCE.sub("", _THINKING.sub("\n", text))
    text = _TAG.sub("", _ESCAPED.sub(r"\1", text).translate(_PLAIN))
    if "\n" not in text.strip():  # line breaks that were escaped once too often
        text = text.replace("\\n", "\n")
    return [line.strip() for line in text.splitlines()]


def without_lead(line: str) -> str:
    """A line without its list marker, number, heading or table bar."""
    for _ in range(_DEEPEST_LEAD):
        shorter = _LEAD.sub("", line, count=1)
        if shorter == line:
            break
        line = shorter
    return line.strip()


def leading_number(line: str) -> int | None:
    """The number a line is listed under, if any."""
    found = re.match(r"^[\s\-#]*\(?(\d{1,3})[.):]", line)
    return int(found.group(1)) if found else None


def excerpt(line: str, length: int = 80) -> str:
    """A line short enough for a message."""
    line = " ".join(line.split())
    return line if len(line) <= length else line[: length - 3] + "..."
