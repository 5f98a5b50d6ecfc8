"""Experiment files and folders: what is accepted, and what is refused with which words."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from skillwrapper.errors import ConfigurationError, RunFolderError, UserError
from skillwrapper.evaluation.benchmark.experiment_files import read_experiment
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.registry import METHODS

SHIPPED = Path(__file__).parents[3] / "experiments"

SMALL = """\
name: small
methods: [ours, system, expert]
seeds: [0, 1]
noise: [0, 0.05, gpt5]
settings:
  iterations: 2
problems: {easy: 2, hard: 1, impossible: 1}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "small.yaml"
    path.write_text(SMALL)
    return path


def test_cells_of_a_file(file: Path) -> None:
    experiment = read_experiment(file)
    assert experiment.noise == ("none", "0.05", "gpt5")
    assert experiment.settings.iterations == 2
    names = [cell.name for cell in experiment.cells]
    assert len(names) == len(set(names)) == 18
    assert names[:3] == ["ours-burger-s0-none", "expert-burger-s0-none", "system-burger-s0-none"]
    source = experiment.source_of(Cell("system", "burger", 1, "gpt5"))
    assert source == Cell("ours", "burger", 1, "gpt5")
    assert experiment.source_of(Cell("expert", "burger", 1, "gpt5")) is None


@pytest.mark.parametrize("name", ["table1", "noise", "smoke"])
def test_shipped_experiments(name: str) -> None:
    experiment = read_experiment(SHIPPED / f"{name}.yaml")
    assert experiment.name == name
    if name in {"table1", "smoke"}:
        assert set(experiment.methods) == set(METHODS)
    if name == "table1":
        assert len(experiment.cells) == 100


MISTAKES = (
    ("methods: [ours", "methods: [our", r":2: unknown method 'our'; did you mean 'ours'\?"),
    ("seeds:", "seed:", r":3: unknown key 'seed'; did you mean 'seeds'\?"),
    ("iterations: 2", "iteration: 2", r":6: unknown key .*did you mean 'iterations'\?"),
    ("iterations: 2", "iterations: 0", r":6: .*greater than or equal to 1, got 0"),
    ("gpt5", "gpt4", r":4: unknown noise 'gpt4'; did you mean 'gpt5'\?"),
    ("[0, 1]", "[1, 1]", r":3: expected different seeds, got 1 twice"),
    ("[ours, system", "[system", r":2: 'system' learns from what 'ours' executes; .*add it"),
    ("name: small", "domains: [burgr]\nname: s", r":1: unknown domain 'burgr'.*'burger'"),
    ("easy: 2", "file: none.yaml", r":7: expected a file of problems, found none at"),
)


@pytest.mark.parametrize(("old", "new", "message"), MISTAKES)
def test_mistakes_in_a_file(file: Path, old: str, new: str, message: str) -> None:
    file.write_text(SMALL.replace(old, new, 1))
    with pytest.raises(UserError, match=message) as caught:
        read_experiment(file)
    assert str(caught.value).startswith(str(file))


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="cannot be read"):
        read_experiment(tmp_path / "none.yaml")


@pytest.fixture
def folder(file: Path, tmp_path: Path) -> ExperimentFolder:
    return ExperimentFolder.create_or_resume(tmp_path / "out", read_experiment(file))


def test_folder_remembers_the_experiment(file: Path, folder: ExperimentFolder) -> None:
    experiment = read_experiment(file)
    assert folder.experiment() == experiment
    assert [p.name for p in folder.problems("burger").problems] == [
        "easy-01",
        "easy-02",
        "hard-01",
        "impossible-01",
    ]
    assert ExperimentFolder.create_or_resume(folder.path, experiment) == folder
    assert ExperimentFolder.open(folder.path) == folder


CHANGES = (
    ("seeds: [0, 1]", "seeds: [0]", "seeds: "),
    ("iterations: 2", "iterations: 3", "settings: "),
    ("easy: 2", "easy: 1", "problems: "),
)


@pytest.mark.parametrize(("old", "new", "what"), CHANGES)
def test_folder_refuses_another_experiment(
    file: Path, folder: ExperimentFolder, old: str, new: str, what: str
) -> None:
    file.write_text(SMALL.replace(old, new))
    before = _contents(folder.path)
    with pytest.raises(RunFolderError, match=rf"holds another experiment \({what}.*choose another"):
        ExperimentFolder.create_or_resume(folder.path, read_experiment(file))
    assert _contents(folder.path) == before


def test_folder_with_something_else(tmp_path: Path, file: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("dear")
    with pytest.raises(RunFolderError, match="is not empty and holds no experiment"):
        ExperimentFolder.create_or_resume(tmp_path / "mine", read_experiment(file))
    with pytest.raises(RunFolderError, match="expected the folder of an experiment"):
        ExperimentFolder.open(tmp_path / "mine")


def test_only_one_process_at_a_time(folder: ExperimentFolder) -> None:
    with (
        folder.reserved(),
        pytest.raises(RunFolderError, match="another process is running this experiment"),
        ExperimentFolder.open(folder.path).reserved(),
    ):
        pytest.fail("reserved twice")
    with folder.reserved():
        pass


def test_damaged_result(folder: ExperimentFolder) -> None:
    cell = folder.experiment().cells[0]
    folder.cell(cell).mkdir(parents=True)
    (folder.cell(cell) / "result.json").write_text("{}")
    with pytest.raises(RunFolderError, match="expected the result of a cell"):
        list(folder.results())


def test_own_problem_file(tmp_path: Path, file: Path, folder: ExperimentFolder) -> None:
    (tmp_path / "mine.yaml").write_text(folder.problem_file("burger").read_text())
    file.write_text(SMALL.replace("{easy: 2", "{file: mine.yaml, easy: 1"))
    experiment = read_experiment(file)
    assert experiment.problems.file == str(tmp_path / "mine.yaml")
    again = ExperimentFolder.create_or_resume(tmp_path / "other", experiment)
    assert len(again.problems("burger").problems) == 3


def test_rates_are_names() -> None:
    experiment = Experiment(name="x", methods=("ours",), noise=(0.10, "none"))  # type: ignore[arg-type]
    assert experiment.noise == ("0.1", "none")


def _contents(path: Path) -> list[tuple[str, bytes]]:
    def files() -> Iterator[Path]:
        return (p for p in sorted(path.rglob("*")) if p.is_file())

    return [(str(p), p.read_bytes()) for p in files()]
