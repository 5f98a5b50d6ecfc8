"""The package as programs meet it: names, how heavy they are, and the examples of the docs."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import skillwrapper

PAGE = Path(__file__).parents[1] / "docs" / "python.md"


def test_every_public_name_is_there_and_nothing_else() -> None:
    assert sorted(skillwrapper.__all__) == skillwrapper.__all__
    assert set(skillwrapper.__all__) == {*skillwrapper._HOMES, "__version__"}
    for name in skillwrapper.__all__:
        found = getattr(skillwrapper, name)
        assert getattr(found, "__doc__", None)
    assert set(skillwrapper.__all__) <= set(dir(skillwrapper))
    with pytest.raises(AttributeError, match="has no attribute 'lern'"):
        skillwrapper.lern  # noqa: B018


def test_importing_is_light() -> None:
    """Nothing but the standard library, and that without what only learning needs."""
    code = "import sys, skillwrapper; print([m for m in sys.modules if '.' not in m])"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    for heavy in ("numpy", "pydantic", "PIL", "openai", "jinja2", "yaml", "rich", "typer"):
        assert f"'{heavy}'" not in loaded


def test_the_command_line_loads_no_client_and_no_library_of_a_few_commands() -> None:
    """Every command would start half a second later, and stop later when it is told at once."""
    code = "import sys, skillwrapper.cli.main; print(list(sys.modules))"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    for rare in ("openai", "httpx2", "ray", "matplotlib", "mujoco", "scipy", "gymnasium"):
        assert f"'{rare}'" not in loaded


def test_the_page_names_every_public_name() -> None:
    text = PAGE.read_text()
    rare = {"AbstractState", "Domain", "Environment", "LearningResult", "ModelRequest", "Outcome"}
    rare |= {"RobotEnvironment", "SkillInstance", "__version__", "read_transitions"}
    missing = [name for name in skillwrapper.__all__ if name not in text]
    assert set(missing) <= rare


def test_the_examples_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In order, in one namespace, in an empty folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("builtins.print", lambda *parts: None)
    space: dict[str, object] = {"__name__": "page"}
    for block in re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL):
        exec(compile(block, str(PAGE), "exec"), space)
    lamps = space["lamps"]
    assert isinstance(lamps, skillwrapper.LearningResult)
    assert [p.signature for p in lamps.model.predicates] == ["lit(?lamp)"]
    assert lamps.figures.inconsistencies == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["lamps.yaml", "run"]
