"""What the paper reports of a real GPT-5, to stand beside figures of ours."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final


@dataclass(frozen=True)
class PaperRow:
    """A row of the paper's table of results: mean and standard deviation of each figure.

    Attributes:
        easy: solved, in percent.
        budget_easy: planning budget; None for methods without.
        hard: solved, in percent.
        budget_hard: planning budget; None for methods without.
        impossible: recognised, in percent.
    """

    easy: tuple[float, float]
    budget_easy: tuple[float, float] | None
    hard: tuple[float, float]
    budget_hard: tuple[float, float] | None
    impossible: tuple[float, float]


_OURS = PaperRow((74.0, 3.7), (2.7, 0.4), (40.0, 3.2), (6.3, 0.4), (100, 0))

PAPER_FIGURES: Final[Mapping[str, Mapping[str, PaperRow]]] = MappingProxyType(
    {
        "burger": MappingProxyType(
            {
                "expert-read": PaperRow((81.0, 3.7), (1.9, 0.4), (58.1, 3.9), (4.2, 0.4), (100, 0)),
                "system": PaperRow((79.0, 3.7), (2.6, 0.2), (22.0, 12.9), (7.8, 1.3), (42.0, 7.5)),
                "vila": PaperRow((46.0, 16.2), None, (13.9, 11.6), None, (20.0, 10.9)),
                "random": PaperRow((4.0, 2.0), (9.6, 0.2), (0, 0), (10.0, 0), (100, 0)),
                "fm-invent": PaperRow(
                    (23.3, 16.5), (7.7, 1.7), (1.7, 2.4), (9.7, 0.2), (63.3, 26.2)
                ),
                "no-heuristic": PaperRow(
                    (76.0, 4.9), (2.5, 0.9), (24.0, 19.6), (7.8, 1.8), (80, 20.9)
                ),
                "ours-5x15": _OURS,
                "ours": _OURS,
            }
        )
    }
)
"""Rows by domain and method (paper, Results in Robotouille Environment). The paper's own method
has 5 x 15 executions."""

PAPER_NOTE: Final = (
    "The paper's columns are of a real GPT-5 with problems and pictures of its own, and of 5 x 15 "
    "executions; ours are of the model named above."
)
