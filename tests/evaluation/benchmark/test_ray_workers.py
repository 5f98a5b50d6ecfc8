"""Cells as Ray tasks: two workers on this machine, one of them killed in the middle."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from crashing_task import crash_once

from skillwrapper.errors import MissingDependencyError
from skillwrapper.evaluation.benchmark.ray_workers import RayWorkers, open_ray_workers
from skillwrapper.evaluation.methods.cell import Cell


def test_ray_not_installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with (
        pytest.raises(MissingDependencyError, match=r"pip install 'skillwrapper\[ray\]'"),
        open_ray_workers(tmp_path, "local"),
    ):
        pytest.fail("opened without Ray")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_killed_worker_loses_nothing(tmp_path: Path) -> None:
    ray = pytest.importorskip("ray")
    tests = os.pathsep.join(
        (str(Path(__file__).parents[2] / "support"), os.environ.get("PYTHONPATH", ""))
    )
    ray.init(
        num_cpus=2,
        include_dashboard=False,
        log_to_driver=False,
        runtime_env={"env_vars": {"PYTHONPATH": tests}},
    )
    try:
        team = RayWorkers(tmp_path, ray, crash_once)
        cells = [Cell("ours", "burger", seed, "none") for seed in range(4)]
        for cell in cells:
            team.submit(cell)
        outcomes = [team.next() for _ in cells]
    finally:
        ray.shutdown()
    assert {o.cell for o in outcomes} == set(cells)
    assert not any(o.error for o in outcomes)
    assert all((tmp_path / cell.name).exists() for cell in cells)
    assert (tmp_path / "crashed-1").exists()
