"""Spoiling replies on purpose: broken off, nonsense, misspelt names."""

from __future__ import annotations

import re

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.noise import NoiseProfile

_NONSENSE = (
    "As a language model I am unable to look at pictures.",
    "{'result': [}",
    "The quick brown fox jumps over the lazy dog.",
)
_NAME = re.compile(r"\b[a-z]\w{4,}(?=[,)(])")


def spoil(reply: str, profile: NoiseProfile, chance: Chance) -> str:
    """The reply, or what is left of it."""
    if chance.happens(profile.malformed):
        if chance.happens(0.5):
            return chance.pick(_NONSENSE)
        return reply[: max(1, int(len(reply) * chance.number()))]
    if chance.happens(profile.wrong_names):
        return _misspell(reply, chance)
    return reply


def _misspell(reply: str, chance: Chance) -> str:
    """One name, everywhere in the reply, without one of its letters."""
    names = sorted(set(_NAME.findall(reply)))
    if not names:
        return reply
    name = chance.pick(names)
    cut = 1 + chance.below(len(name) - 2)
    return re.sub(rf"\b{re.escape(name)}\b", name[:cut] + name[cut + 1 :], reply)
