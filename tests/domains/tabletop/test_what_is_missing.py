from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.domains.tabletop import extra, robot_models
from skillwrapper.errors import MissingDependencyError


def test_without_mujoco_it_is_said_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "mujoco", None)
    with pytest.raises(MissingDependencyError, match=r"pip install 'skillwrapper\[sim\]'"):
        extra.mujoco.__wrapped__()


def test_without_the_models_it_is_said_how_to_fetch_them(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(robot_models.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(MissingDependencyError, match="skillwrapper setup-sim"):
        robot_models.model_file("panda")
