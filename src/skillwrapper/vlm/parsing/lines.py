"""From a reply as models write it to the lines that the parsers read."""

from __future__ import annotations

from skillwrapper.vlm.answers import answer_of, clean_text
from skillwrapper.vlm.parsing.markup import Line, plain_line, without_tags
from skillwrapper.vlm.parsing.records import join_records
from skillwrapper.vlm.parsing.structured import flatten_json

LONGEST_REPLY = 60_000
"""Characters, reasoning aside; no answer to any of our questions comes near."""


def reply_lines(reply: str) -> list[Line]:
    """The lines of a reply's answer; what is written as records is one line each.

    Records are objects in JSON, rows of tables and blocks like ``Name: ...`` over
    ``Meaning: ...``. Empty lines are kept, code fences become empty. A reply that is longer than
    any sensible one is read up to a limit.
    """
    text = answer_of(reply)
    if len(text) > LONGEST_REPLY:
        text = text[:LONGEST_REPLY].rpartition("\n")[0]
    text = clean_text(flatten_json(without_tags(text)))
    if "\n" not in text.strip():  # line breaks that were escaped once too often
        text = text.replace("\\n", "\n")
    return join_records(list(map(plain_line, text.split("\n"))))


def excerpt(line: str, length: int = 80) -> str:
    """A line short enough for a message."""
    line = " ".join(line[: 20 * length].split())
    return line if len(line) <= length else line[: length - 3] + "..."
