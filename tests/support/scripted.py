"""A model for tests: answers by a function, and remembers what it was asked."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from skillwrapper.vlm.protocol import ModelReply, ModelRequest


@dataclass
class ScriptedModel:
    answer: Callable[[ModelRequest], str]
    requests: list[ModelRequest] = field(default_factory=list)
    lock: threading.Lock = field(default_factory=threading.Lock)

    @property
    def name(self) -> str:
        return "scripted"

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        return {}

    def complete(self, request: ModelRequest) -> ModelReply:
        with self.lock:
            self.requests.append(request)
        return ModelReply(self.answer(request))


def section(prompt: str, title: str) -> list[str]:
    """The list items under a heading of a prompt."""
    lines = prompt.split(f"## {title}\n", 1)[1].split("\n## ", 1)[0].splitlines()
    return [line[2:] for line in lines if line.startswith("- ")]
