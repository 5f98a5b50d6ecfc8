"""What trying out a model shows."""

from __future__ import annotations

from dataclasses import dataclass

_CHOOSE_ANOTHER = "reword its template (learn --prompts), or choose another model"


@dataclass(frozen=True)
class Finding:
    """What one check showed.

    Attributes:
        check: what was tried.
        passed: whether it went well.
        detail: what was seen; if it did not go well, also what to do.
    """

    check: str
    passed: bool
    detail: str


def of_no_use(check: str, unusable: tuple[str, ...]) -> Finding:
    """Replies that could not be read."""
    why = unusable[0] if unusable else "nothing in it was of use"
    return Finding(check, False, f"the replies cannot be used ({why}); {_CHOOSE_ANOTHER}")
