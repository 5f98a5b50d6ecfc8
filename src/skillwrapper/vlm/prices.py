"""What models cost. A price that is not known is unknown, which is not zero."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from urllib.parse import urlsplit

_DATED = re.compile(r"-(?:\d{4}-\d{2}-\d{2}|\d{8}|latest|preview)$")
_MILLION = 1_000_000


@dataclass(frozen=True)
class Price:
    """US dollars for a million tokens.

    Attributes:
        input: of prompt and pictures.
        output: of the reply, reasoning included.
    """

    input: float
    output: float

    def cost(self, input_tokens: int | None, output_tokens: int | None) -> float | None:
        """Dollars for a call; None if a number of tokens is unknown."""
        if input_tokens is None or output_tokens is None:
            return None
        return (input_tokens * self.input + output_tokens * self.output) / _MILLION


# List prices without discounts for batches or cached prompts, as published in autumn 2025.
LIST_PRICES: Mapping[str, Price] = MappingProxyType(
    {
        "gpt-5": Price(1.25, 10.0),
        "gpt-5-mini": Price(0.25, 2.0),
        "gpt-5-nano": Price(0.05, 0.4),
        "gpt-4.1": Price(2.0, 8.0),
        "gpt-4.1-mini": Price(0.4, 1.6),
        "gpt-4.1-nano": Price(0.1, 0.4),
        "gpt-4o": Price(2.5, 10.0),
        "gpt-4o-mini": Price(0.15, 0.6),
        "o3": Price(2.0, 8.0),
        "o4-mini": Price(1.1, 4.4),
        "gemini-2.5-pro": Price(1.25, 10.0),
        "gemini-2.5-flash": Price(0.3, 2.5),
        "claude-sonnet-4-5": Price(3.0, 15.0),
        "claude-haiku-4-5": Price(1.0, 5.0),
        "claude-opus-4-1": Price(15.0, 75.0),
    }
)

_SELLERS = ("openai.com", "googleapis.com", "anthropic.com", "openrouter.ai")


def list_price(model: str, base_url: str | None) -> Price | None:
    """The list price of a model; None if it is unknown.

    Args:
        model: e.g. ``gpt-5``, ``gpt-5-2025-08-07`` or ``openai/gpt-5``.
        base_url: address of the endpoint; None for OpenAI's own. Elsewhere than at the sellers
            of these models, a name says nothing about the price.
    """
    host = urlsplit(base_url).hostname if base_url else "api.openai.com"
    if host is None or not any(host == s or host.endswith(f".{s}") for s in _SELLERS):
        return None
    name = model.rpartition("/")[2]
    return LIST_PRICES.get(name) or LIST_PRICES.get(_DATED.sub("", name))
