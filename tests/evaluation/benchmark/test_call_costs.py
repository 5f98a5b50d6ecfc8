"""What calls took: added up over interruptions, and unknown if any part is."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.evaluation.benchmark.call_costs import (
    NOTHING,
    CallCosts,
    learning_costs,
    solving_costs,
)
from skillwrapper.runs.archive import RunArchive
from skillwrapper.usage import Usage
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.store import CallStatus, CallStore, StoredCall


def keep(path: Path, *costs: tuple[int | None, float | None]) -> RunArchive:
    """A folder with a call for each pair of iteration and cost."""
    folder = RunArchive(path)
    with CallStore(folder.layout.calls) as store:
        for number, (iteration, cost) in enumerate(costs):
            usage = Usage(100, 10, cost, 2.0)
            key = str(number)
            store.add(
                StoredCall(
                    key, key, CallStatus.ANSWERED, Role.EVALUATE, iteration, "m", "{}", 0,
                    "", "", (), "yes", usage,
                )
            )  # fmt: skip
        store.count_served(Role.EVALUATE, 1)
    return folder


def test_learning_and_solving_are_told_apart(tmp_path: Path) -> None:
    folder = keep(tmp_path, (1, 0.25), (2, 0.5), (None, 0.125))
    # What a run that goes on meets again is no further call.
    assert learning_costs(folder) == CallCosts(2, pytest.approx(0.75), 200, 20, 4.0)
    assert solving_costs(folder, 1, "openai:x") == CallCosts(1, pytest.approx(0.125), 100, 10, 2.0)


def test_one_unknown_cost_makes_the_sum_unknown(tmp_path: Path) -> None:
    folder = keep(tmp_path, (1, 0.25), (1, None))
    costs = learning_costs(folder)
    assert costs is not None
    assert (costs.calls, costs.cost) == (2, None)
    assert solving_costs(folder, 4, "openai:x").cost is None


def test_without_calls(tmp_path: Path) -> None:
    assert learning_costs(None) is None
    assert learning_costs(RunArchive(tmp_path)) is None
    assert solving_costs(None, 0, "openai:x") == NOTHING
    assert solving_costs(None, 5, "embedded") == CallCosts(5, 0.0, None, None, None)
