"""What calls cost, by the price list of ``genai-prices``; what it does not list is unknown.

A price that is not known is unknown, which is not zero.
"""

from __future__ import annotations

from collections.abc import Callable

CallCost = Callable[[int | None, int | None], float | None]
"""US dollars for one call, from its input tokens (prompt and pictures) and output tokens
(reasoning included); None if a number of tokens is unknown."""


def price_of(model: str, address: str) -> CallCost | None:
    """What calls of a model cost at its seller; None if that is unknown.

    Args:
        model: e.g. ``gpt-5``, ``gpt-5-2025-08-07`` or ``openai/gpt-5``.
        address: of the endpoint. Elsewhere than at a known seller, a name says nothing about the
            price.
    """
    # Imported late: the list takes a fifth of a second to load.
    from genai_prices import Usage, calc_price  # noqa: PLC0415

    def cost(input_tokens: int | None, output_tokens: int | None) -> float | None:
        if input_tokens is None or output_tokens is None:
            return None
        usage = Usage(input_tokens=input_tokens, output_tokens=output_tokens)
        return float(calc_price(usage, model, provider_api_url=address).total_price)

    try:
        cost(1, 1)
    except LookupError:
        return None
    return cost


def nothing(input_tokens: int | None, output_tokens: int | None) -> float | None:
    """The cost of what costs nothing: our own models and recordings."""
    return 0.0
