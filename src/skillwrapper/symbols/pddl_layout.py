"""How the text of PDDL is laid out, whatever is written in it."""

from __future__ import annotations

from collections.abc import Iterable


def conjunction(parts: Iterable[str]) -> str:
    """``(and ...)``."""
    return f"(and {' '.join(parts)})"


def block(title: str, lines: Iterable[str]) -> list[str]:
    """A section of a domain or a problem, as lines."""
    return [f"  ({title}", *(f"    {line}" for line in lines), "  )"]


def clause(title: str, parts: Iterable[str]) -> list[str]:
    """A part of an action, as lines."""
    return [f"    {title} (and", *(f"      {part}" for part in parts), "    )"]


def comment(text: str) -> str:
    """A text as a comment that ends a line; nothing for nothing."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return f" ; {line}" if line else ""
