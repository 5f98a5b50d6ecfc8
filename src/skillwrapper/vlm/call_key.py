"""The identity of a model call: two calls with the same key may share one reply."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping

from skillwrapper.vlm.protocol import ModelRequest


def question_key(request: ModelRequest) -> str:
    """SHA-256 of what is asked, whichever model is asked: role, prompts, pictures, repetition."""
    parts = {
        "role": str(request.role),
        "system": request.system,
        "prompt": request.prompt,
        "pictures": [[picture.camera, picture.sha256] for picture in request.pictures],
        "repetition": request.repetition,
    }
    return _digest(parts)


def call_key(
    model: str, parameters: Mapping[str, str | int | float | bool], request: ModelRequest
) -> str:
    """SHA-256 of what is asked, of whom, and with which settings."""
    parts = {
        "model": model,
        "parameters": dict(parameters),
        "question": question_key(request),
    }
    return _digest(parts)


def _digest(parts: Mapping[str, object]) -> str:
    text = json.dumps(parts, sort_keys=True, ensure_ascii=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()
