"""What models cost. A price that is not known is unknown, which is not zero."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from urllib.parse import urlsplit

# A preview is another model, with a price of its own.
_DATED = re.compile(r"-(?:\d{4}-\d{2}-\d{2}|\d{8}|latest)$")
_MILLION = 1_000_000


@dataclass(frozen=True)
class Price:
    """US dollars for a million tokens.

    Attributes:
        input: of prompt and pictures.
        output: of the reply, reasoning included.
        checked: the day on which the seller's page said so, as YYYY-MM-DD; empty if nobody looked.
    """

    input: float
    output: float
    checked: str = ""

    def cost(self, input_tokens: int | None, output_tokens: int | None) -> float | None:
        """Dollars for a call; None if a number of tokens is unknown."""
        if input_tokens is None or output_tokens is None:
            return None
        return (input_tokens * self.input + output_tokens * self.output) / _MILLION


# Standard list prices for prompts of up to 200,000 tokens, without discounts for batches or cached
# prompts. Sources: openai.com/api/pricing, ai.google.dev/gemini-api/docs/pricing and
# anthropic.com/pricing, as collected with the day of the last check by
# github.com/pydantic/genai-prices (state of August 2026). What is not listed there is unknown here.
LIST_PRICES: Mapping[str, Price] = MappingProxyType(
    {
        "gpt-5": Price(1.25, 10.0, "2025-11-13"),
        "gpt-5-mini": Price(0.25, 2.0, "2025-11-13"),
        "gpt-5-nano": Price(0.05, 0.4, "2025-11-13"),
        "gpt-5.1": Price(1.25, 10.0, "2025-11-13"),
        "gpt-5.2": Price(1.75, 14.0, "2025-12-11"),
        "gpt-5.4": Price(2.5, 15.0, "2026-03-06"),
        "gpt-5.4-mini": Price(0.75, 4.5, "2026-03-18"),
        "gpt-5.5": Price(5.0, 30.0, "2026-04-24"),
        "gpt-4.1": Price(2.0, 8.0, "2025-07-04"),
        "gpt-4.1-mini": Price(0.4, 1.6, "2025-07-04"),
        "gpt-4.1-nano": Price(0.1, 0.4, "2025-07-04"),
        "gpt-4o": Price(2.5, 10.0, "2025-07-04"),
        "gpt-4o-mini": Price(0.15, 0.6, "2025-07-04"),
        "o3": Price(2.0, 8.0, "2025-07-12"),
        "o4-mini": Price(1.1, 4.4, "2025-07-04"),
        "gemini-2.5-pro": Price(1.25, 10.0, "2025-10-31"),
        "gemini-2.5-flash": Price(0.3, 2.5, "2025-10-31"),
        "gemini-2.5-flash-lite": Price(0.1, 0.4, "2025-10-31"),
        "claude-sonnet-4-5": Price(3.0, 15.0, "2026-07-29"),
        "claude-haiku-4-5": Price(1.0, 5.0, "2026-07-29"),
        "claude-opus-4-1": Price(15.0, 75.0, "2026-07-29"),
        "claude-opus-4-5": Price(5.0, 25.0, "2026-07-29"),
        "claude-opus-5": Price(5.0, 25.0, "2026-07-29"),
    }
)

_SELLERS = ("openai.com", "googleapis.com", "anthropic.com", "openrouter.ai")


def list_price(model: str, base_url: str | None) -> Price | None:
    """The list price of a model; None if it is unknown.

    Args:
        model: e.g. ``gpt-5``, ``gpt-5-2025-08-07`` or ``openai/gpt-5``.
        base_url: address of the endpoint; None for that of the environment, or OpenAI's own.
            Elsewhere than at the sellers of these models, a name says nothing about the price.
    """
    address = base_url or os.environ.get("OPENAI_BASE_URL")
    host = urlsplit(address).hostname if address else "api.openai.com"
    if host is None or not any(host == s or host.endswith(f".{s}") for s in _SELLERS):
        return None
    name = model.rpartition("/")[2]
    return LIST_PRICES.get(name) or LIST_PRICES.get(_DATED.sub("", name))
