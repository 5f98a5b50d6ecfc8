"""The package as others get it: a wheel, installed away from the repository."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from collections.abc import Sequence
from pathlib import Path
from zipfile import ZipFile

import pytest

REPOSITORY = Path(__file__).parents[1]
EXAMPLE = REPOSITORY / "examples" / "greenhouse"


_COMMANDS = """
import json, sys
from skillwrapper.cli.main import app
for line in json.loads(sys.argv[1]):
    app(line, standalone_mode=False)
"""


class Installed:
    """An environment that holds the wheel and its dependencies, and nothing of the repository."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        environment = folder / "environment"
        venv.create(environment, with_pip=False)
        self._bin = environment / "bin"
        packages = next(environment.glob("lib/python*/site-packages"))
        # Dependencies are taken from where the tests run; a plain path does not bring along the
        # editable installation that is there too.
        (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n")
        source, wheels = _copy_of_source(folder / "source"), folder / "wheels"
        wheels.mkdir()
        build = "import sys; from setuptools import build_meta; build_meta.build_wheel(sys.argv[1])"
        self._do([sys.executable, "-c", build, wheels], source)
        with ZipFile(next(wheels.glob("skillwrapper-*.whl"))) as wheel:
            wheel.extractall(packages)  # all that installing a wheel without scripts is

    def python(self, *arguments: object) -> str:
        """Standard output of its interpreter."""
        return self._do([self._bin / "python", *arguments])

    def skillwrapper(self, *lines: Sequence[object]) -> str:
        """Standard output of commands, in one process."""
        told = json.dumps([list(map(str, line)) for line in lines])
        return self.python("-c", _COMMANDS, told)

    def _do(self, command: Sequence[object], where: Path | None = None) -> str:
        free = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
        done = subprocess.run(
            [str(part) for part in command],
            cwd=where or self._folder,
            env=free,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout


def _copy_of_source(target: Path) -> Path:
    """What a wheel is built from, without what earlier builds have left beside it."""
    leftovers = shutil.ignore_patterns("*.egg-info", "__pycache__")
    shutil.copytree(REPOSITORY / "src", target / "src", ignore=leftovers)
    for name in ("pyproject.toml", "README.md"):
        shutil.copy(REPOSITORY / name, target / name)
    return target


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Installed:
    return Installed(tmp_path_factory.mktemp("away"))


def test_it_is_not_the_repository_that_answers(installed: Installed) -> None:
    place = installed.python("-c", "import skillwrapper; print(skillwrapper.__file__)")
    assert not Path(place.strip()).is_relative_to(REPOSITORY)


@pytest.fixture(scope="module")
def greenhouse(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example, away from the repository as well."""
    folder = tmp_path_factory.mktemp("own") / "greenhouse"
    shutil.copytree(EXAMPLE, folder, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def test_it_learns_verifies_reports_and_compares(
    installed: Installed, greenhouse: Path, tmp_path: Path
) -> None:
    """On a domain in a folder; on a bundled one it learns."""
    run, problems, out = tmp_path / "run", tmp_path / "problems.yaml", tmp_path / "tiny"
    file = tmp_path / "tiny.yaml"
    file.write_text(
        f"name: tiny\nmethods: [random]\ndomains: [{greenhouse}]\nseeds: [0]\n"
        "settings: {iterations: 1, exploration: {budget: 4}}\n"
        "problems: {file: problems.yaml}\n"
    )
    said = installed.skillwrapper(
        ("learn", greenhouse, "--out", run, "--iterations", 1, "--budget", 8),
        ("verify", run, "--json"),
        ("report", run),
        ("learn", "burger", "--out", tmp_path / "burger", "--iterations", 1, "--budget", 4),
        ("problems", greenhouse, "--easy", 1, "--hard", 0, "--impossible", 0, "--out", problems),
        ("experiment", "run", file, "--out", out),
        ("experiment", "table", out, "--format", "json"),
    )
    assert '"precision"' in said
    assert (run / "report.html").is_file()
    assert (tmp_path / "burger" / "model" / "domain.pddl").is_file()
    assert '"method": "random"' in said
