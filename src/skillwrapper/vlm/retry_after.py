"""How long a provider asks to wait: in headers, as seconds or a date, or in its words."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Mapping
from email.utils import parsedate_to_datetime

_SAID = re.compile(
    r"(?:try again|retry|retrying|wait|available|reset\w*)(?: again)?(?: in| after| for)?:? ?"
    r"(?:(\d{1,3})h ?)?(?:(\d{1,4})m(?:in(?:utes?)?)?(?!s) ?)?"
    r"(?:(\d{1,6}(?:\.\d{1,9})?) ?(ms|s\b|sec))?",
    re.IGNORECASE,
)
_DELAY = re.compile(r"retry_?delay\W{1,6}(\d{1,6}(?:\.\d{1,9})?)s", re.IGNORECASE)


def wait_asked_for(headers: Mapping[str, str], said: str, now: float | None = None) -> float | None:
    """Seconds to wait; None if the provider does not say.

    Args:
        headers: of the reply, with names in lower case or case-insensitive.
        said: the words of the error.
        now: seconds since the epoch; the present by default.
    """
    present = time.time() if now is None else now
    for name, unit in (("retry-after-ms", 0.001), ("retry-after", 1.0)):
        value = headers.get(name, "")
        wait = _seconds(value, unit)
        if wait is None and value:
            wait = _until(value, present)
        if wait is not None:
            return wait
    return _in_words(said)


def _seconds(value: str, unit: float) -> float | None:
    try:
        number = float(value) * unit
    except ValueError:
        return None
    return max(0.0, number) if math.isfinite(number) else None


def _until(date: str, now: float) -> float | None:
    try:
        return max(0.0, parsedate_to_datetime(date).timestamp() - now)
    except (ValueError, TypeError, OverflowError):
        return None


def _in_words(said: str) -> float | None:
    delay = _DELAY.search(said)
    if delay:
        return float(delay[1])
    for found in _SAID.finditer(said):
        hours, minutes, number, unit = found.groups()
        if hours or minutes or number:
            rest = float(number or 0) * (0.001 if (unit or "").lower() == "ms" else 1.0)
            return 3600.0 * int(hours or 0) + 60.0 * int(minutes or 0) + rest
    return None
