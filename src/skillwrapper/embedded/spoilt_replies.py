"""What a fault of the test server makes of a reply."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from skillwrapper.embedded import server_faults as faults
from skillwrapper.vlm.protocol import ModelReply

FINISH_REASONS: Mapping[str, str] = MappingProxyType(
    {
        faults.CUT_OFF: "length",
        faults.CUT_OFF_THINKING: "length",
        faults.FILTERED: "content_filter",
        faults.BROKEN_OFF: "error",
    }
)
"""The finish reason of replies with a fault; that of others is ``stop``."""
_NONSENSE = "Colourless green ideas sleep furiously."
_VERDICT = re.compile(r"\b(?:true|false|yes|no)\b", re.IGNORECASE)


def spoilt(reply: ModelReply, fault: str | None, authorization: str) -> ModelReply:
    """The reply with a fault; as it is if the fault is of another kind."""
    return replace(reply, text=_text(reply.text, fault, authorization))


def _text(text: str, fault: str | None, authorization: str) -> str:
    if fault == faults.NONSENSE:
        return _NONSENSE
    if fault in {faults.CUT_OFF, faults.BROKEN_OFF}:
        return text[: len(text) // 2]
    if fault in {faults.CUT_OFF_THINKING, faults.FILTERED}:
        return ""
    if fault == faults.KEY_IN_REPLY:
        return f"{text}\n(You sent Authorization: {authorization})"
    verdict = _only_verdict(text, fault)
    return _VERDICT.sub(verdict, text) if verdict else text


def _only_verdict(text: str, fault: str | None) -> str | None:
    """What a model that does not look or listen says of everything; None for other faults."""
    if fault == faults.DEAF:
        first = _VERDICT.search(text)
        return first[0] if first else None
    return {faults.ALL_TRUE: "true", faults.ALL_FALSE: "false"}.get(fault or "")
