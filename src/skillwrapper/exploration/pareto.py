"""The Pareto set of scored candidates."""

from __future__ import annotations

from collections.abc import Sequence


def pareto_set(scores: Sequence[tuple[float, ...]]) -> tuple[int, ...]:
    """Indices of the candidates that no other one beats; exact ties all stay (DESIGN.md D16).

    One beats another if it is at least as good in every score and better in one.
    """
    return tuple(
        i for i, own in enumerate(scores) if not any(_beats(other, own) for other in scores)
    )


def _beats(first: tuple[float, ...], second: tuple[float, ...]) -> bool:
    return first != second and all(a >= b for a, b in zip(first, second, strict=True))
