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

import pytest

REPOSITORY = Path(__file__).parents[1]
EXAMPLE = REPOSITORY / "examples" / "greenhouse"


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
        pip = (sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet")
        self._do([*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", wheels, source])
        wheel = next(wheels.glob("skillwrapper-*.whl"))
        self._do([*pip, "install", "--no-deps", "--target", packages, wheel])

    def python(self, *arguments: object) -> str:
        """Standard output of its interpreter."""
        return self._do([self._bin / "python", *arguments])

    def skillwrapper(self, *arguments: object) -> str:
        """Standard output of a command."""
        return self.python("-m", "skillwrapper", *arguments)

    def _do(self, command: Sequence[object]) -> str:
        free = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
        done = subprocess.run(
            [str(part) for part in command],
            cwd=self._folder,
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


def test_learns_verifies_and_reports(
    installed: Installed, greenhouse: Path, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    installed.skillwrapper("learn", greenhouse, "--out", run, "--iterations", 2)
    assert "precision" in installed.skillwrapper("verify", run, "--json")
    installed.skillwrapper("report", run)
    assert (run / "report.html").is_file()


def test_learns_a_bundled_domain(installed: Installed, tmp_path: Path) -> None:
    size = ("--iterations", 1, "--budget", 4)
    installed.skillwrapper("learn", "burger", "--out", tmp_path / "run", *size)
    assert (tmp_path / "run" / "model" / "domain.pddl").is_file()


def test_runs_an_experiment(installed: Installed, greenhouse: Path, tmp_path: Path) -> None:
    problems, file = tmp_path / "problems.yaml", tmp_path / "tiny.yaml"
    few = ("--easy", 1, "--hard", 0, "--impossible", 0)
    installed.skillwrapper("problems", greenhouse, *few, "--out", problems)
    file.write_text(
        f"name: tiny\nmethods: [random]\ndomains: [{greenhouse}]\nseeds: [0]\n"
        "settings: {iterations: 1, exploration: {budget: 4}}\n"
        "problems: {file: problems.yaml}\n"
    )
    out = tmp_path / "tiny"
    installed.skillwrapper("experiment", "run", file, "--out", out)
    table = json.loads(installed.skillwrapper("experiment", "table", out, "--format", "json"))
    assert [method["method"] for method in table["methods"]] == ["random"]
