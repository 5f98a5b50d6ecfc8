"""Each ablation changes what its name says, and nothing else."""

from __future__ import annotations

import pytest

from skillwrapper.evaluation.methods.learned import LearnedMethod
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.settings import RunSettings

WHOLE = RunSettings(
    domain="burger", seed=3, iterations=10, exploration=ExplorationSettings(budget=30)
)

CHANGES = (
    ("ours", {}),
    ("ours-5x15", {"iterations": (10, 5), "budget": (30, 15)}),
    ("ours-3x15", {"iterations": (10, 3), "budget": (30, 15)}),
    ("ours-15x5", {"iterations": (10, 15), "budget": (30, 5)}),
    ("random", {"explorer": ("planned", "random")}),
    ("paper-exploration", {"explorer": ("planned", "paper")}),
    ("no-heuristic", {"explorer": ("planned", "paper"), "choice": ("pareto", "uniform")}),
    ("fm-invent", {"invention": ("pairs", "batch")}),
)


@pytest.mark.parametrize(("name", "changes"), CHANGES)
def test_what_is_changed(name: str, changes: dict[str, tuple[object, object]]) -> None:
    method = METHODS[name]
    assert isinstance(method, LearnedMethod)
    before, after = WHOLE.model_dump(mode="json"), method.configure(WHOLE).model_dump(mode="json")
    assert _differences(before, after) == changes


def _differences(before: dict, after: dict) -> dict[str, tuple[object, object]]:  # type: ignore[type-arg]
    found: dict[str, tuple[object, object]] = {}
    for key, value in before.items():
        if isinstance(value, dict):
            found |= _differences(value, after[key])
        elif value != after[key]:
            found[key] = (value, after[key])
    return found


def test_registry() -> None:
    assert [method.name for method in METHODS.values()] == list(METHODS)
    assert len({method.title for method in METHODS.values()}) == len(METHODS) == 13
    assert all(m.source is None or m.source in METHODS for m in METHODS.values())
