"""What templates may use of texts and lists, and how large what they make may become.

A filter or method is there only if what it makes, and the time it takes, follow from the sizes of
what it is given.
"""

from __future__ import annotations

import re

from jinja2.exceptions import SecurityError

LONGEST_TEXT = 2_000_000
"""Characters of a rendered prompt, and of any text or list that a template makes."""
# fmt: off
FILTERS = frozenset({
    "abs", "attr", "batch", "capitalize", "count", "d", "default", "dictsort", "e", "escape",
    "filesizeformat", "first", "float", "format", "forceescape", "groupby", "indent", "int",
    "items", "join", "last", "length", "list", "lower", "map", "max", "min", "reject",
    "rejectattr", "replace", "reverse", "round", "safe", "select", "selectattr", "sort",
    "string", "sum", "title", "tojson", "trim", "truncate", "unique", "upper", "urlencode",
    "wordcount",
})
METHODS = frozenset({
    "capitalize", "casefold", "count", "endswith", "find", "format", "get", "index",
    "isalnum", "isalpha", "isdigit", "islower", "isnumeric", "isspace", "istitle", "isupper",
    "items", "keys", "lower", "lstrip", "partition", "removeprefix", "removesuffix", "rfind",
    "rindex", "rpartition", "rsplit", "rstrip", "split", "splitlines", "startswith", "strip",
    "swapcase", "title", "upper", "values",
})
# fmt: on
"""Of texts, lists and other plain values; ``format`` only for forms that ``check_form`` lets by."""
MULTIPLYING = frozenset({"indent", "join", "replace"})
"""Filters that may make as much as the product of what they are given."""
_SIZE_OF_A_PART = 10
_WIDE = re.compile(r"%[^A-Za-z%]{0,9}(?:\d{4}|\*)|\{[^{}]{0,99}(?:\d{4}|\{)")
"""A form that fills a value up to a thousand places, or to as many as another value says."""


class TooMuchError(SecurityError):
    """A template that takes too many steps, or makes something too large."""


def weight(value: object) -> int:
    """How many characters a value has, all the way down; beyond the most, not exactly.

    What is no text counts as ten: about what it becomes as text.
    """
    total, waiting = 0, [value]
    while waiting and total <= LONGEST_TEXT:
        part = waiting.pop()
        total += len(part) if isinstance(part, str | bytes) else _SIZE_OF_A_PART
        if isinstance(part, dict):
            waiting += [*part.keys(), *part.values()]
        elif isinstance(part, list | tuple | set | frozenset):
            waiting += part
    return total


def extent(argument: object) -> int:
    """What an argument adds to the size of what a filter makes: numbers count for themselves."""
    if isinstance(argument, int | float):
        return int(min(abs(argument), LONGEST_TEXT + 1))
    return weight(argument)


def size_made(operator: str, left: object, right: object) -> int:
    """How large the sum (``+``) or product (``*``) of two values is; numbers have no size."""
    if operator == "+":
        return weight(left) + weight(right)
    times = next((value for value in (left, right) if isinstance(value, int)), 0)
    collections = [value for value in (left, right) if isinstance(value, str | list | tuple)]
    return max((weight(value) * times for value in collections), default=0)


def check_form(text: str) -> None:
    """Refuse a form for values that would fill them up without bound.

    Raises:
        TooMuchError: for a width of a thousand or more, or one that is a value itself.
    """
    if _WIDE.search(text):
        raise TooMuchError("a form that fills up to a thousand places or more")
