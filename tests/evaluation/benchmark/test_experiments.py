"""Experiment files and folders: what is accepted, and what is refused with which words."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from lamp_shop import write_lamp_shop

from skillwrapper.errors import ConfigurationError, RunFolderError, UserError
from skillwrapper.evaluation.benchmark.experiment_files import read_experiment
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.benchmark.experiments import Experiment
from skillwrapper.evaluation.methods.cell import Cell
from skillwrapper.evaluation.methods.registry import METHODS
from skillwrapper.evaluation.methods.skillwrapper import OURS_OFTEN_RESET, OURS_ONCE_A_SCENE

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


@pytest.mark.parametrize("name", ["table1", "exploration", "noise", "smoke", "data_efficiency"])
def test_shipped_experiments(name: str) -> None:
    experiment = read_experiment(SHIPPED / f"{name}.yaml")
    assert experiment.name == name
    if name in {"table1", "smoke"}:
        # The kitchen has one scene only.
        assert set(METHODS) - set(experiment.methods) == {
            OURS_ONCE_A_SCENE.name,
            OURS_OFTEN_RESET.name,
        }
    if name == "table1":
        assert len(experiment.cells) == 110


MISTAKES = (
    ("methods: [ours", "methods: [our", r":2: unknown method 'our'; did you mean 'ours'\?"),
    ("seeds:", "seed:", r":3: unknown key 'seed'; did you mean 'seeds'\?"),
    ("iterations: 2", "iteration: 2", r":6: unknown key .*did you mean 'iterations'\?"),
    ("iterations: 2", "iterations: 0", r":6: .*greater than or equal to 1, got 0"),
    ("gpt5", "gpt4", r":4: unknown noise 'gpt4'; did you mean 'gpt5'\?"),
    ("[0, 1]", "[1, 1]", r":3: expected different seeds, got 1 twice"),
    ("[0, 1]", str(list(range(20_000))), r":3: 'seeds': expected at most 1000 of them, got"),
    (
        "[0, 1]\nnoise: [0, 0.05, gpt5]",
        f"{list(range(1000))}\nnoise: [0, 0.1, 0.2, gpt5]",
        r":3: expected at most 10000 cells .*, got 12000",
    ),
    ("[0, 1]", "[0, -1]", r":3: 'seeds\.1': expected greater than or equal to 0, got -1"),
    ("[0, 1]", "[0, yes]", r":3: 'seeds\.1': expected a whole number, got True"),
    ("[0, 1]", "[0, '1']", r":3: 'seeds\.1': expected a whole number, got '1'"),
    ("[0, 1]", "[]", r":3: 'seeds': expected at least 1 of them, got \[\]"),
    (
        "name: small",
        "name: ../small",
        r":1: 'name': expected text of the form .*, got '\.\./small'",
    ),
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
    said = rf"experiment\.yaml holds another experiment \({what}.*choose another"
    with pytest.raises(RunFolderError, match=said):
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
    with pytest.raises(RunFolderError, match=r"result\.json:1: expected a value for 'cell'"):
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


MOVED = (
    ("  budget: 3\n", r":6: .*'budget' is now 'exploration\.budget'"),
    ("  time_limit: 3\n", r":6: .*'time_limit' is now 'planner\.time_limit'"),
    ("  model: openai:gpt-5\n", r":6: .*now 'model\.name', e\.g\. 'model: \{name: openai:gpt-5\}'"),
    ("  model: {noise: gpt5}\n", r":6: .*expected the noise as 'noise: \[\.\.\.\]'"),
)


@pytest.mark.parametrize(("line", "message"), MOVED)
def test_settings_that_stood_elsewhere(file: Path, line: str, message: str) -> None:
    file.write_text(SMALL.replace("  iterations: 2\n", line))
    with pytest.raises(UserError, match=message):
        read_experiment(file)


def test_settings_from_several_places(file: Path, tmp_path: Path) -> None:
    """D22: one tree for runs and experiments; the file, over it --config, over both --set."""
    (tmp_path / "more.yaml").write_text("iterations: 3\nexploration: {budget: 7}\n")
    changes = ("exploration.budget=8", "planner.time_limit=4")
    settings = read_experiment(file, tmp_path / "more.yaml", changes).settings
    assert (settings.iterations, settings.exploration.budget) == (3, 8)
    assert settings.planner.time_limit == 4
    run = settings.run("burger", 5, "gpt5")
    assert (run.seed, run.exploration.budget, run.model.noise) == (5, 8, "gpt5")
    with pytest.raises(UserError, match=r"--set: unknown setting 'planner\.timelimit'.*time_limit"):
        read_experiment(file, None, ["planner.timelimit=4"])
    (tmp_path / "more.yaml").write_text("\niteratons: 3\n")
    with pytest.raises(UserError, match=r"more\.yaml:2: unknown setting 'iteratons'.*'iterations'"):
        read_experiment(file, tmp_path / "more.yaml")


@pytest.mark.parametrize("left", ["nothing", "leftover", "experiment"])
def test_killed_in_its_first_moments(file: Path, tmp_path: Path, left: str) -> None:
    """Fault 14: whatever a kill left of making the folder, the same command goes on."""
    out = tmp_path / "out"
    out.mkdir()
    if left == "leftover":
        (out / ".experiment.yaml.17.tmp").write_text("name: sm")
    if left == "experiment":
        whole = ExperimentFolder.create_or_resume(tmp_path / "whole", read_experiment(file))
        (out / "experiment.yaml").write_text((whole.path / "experiment.yaml").read_text())
    folder = ExperimentFolder.create_or_resume(out, read_experiment(file))
    assert len(folder.problems("burger").problems) == 4


def test_a_file_of_something_else_as_problems(file: Path, tmp_path: Path) -> None:
    (tmp_path / "secret.yaml").write_text("password: hunter2\n")
    file.write_text(SMALL.replace("{easy: 2", "{file: secret.yaml, easy: 2"))
    with pytest.raises(
        ConfigurationError, match=r"small\.yaml:7: .*expected a file of pr"
    ) as caught:
        read_experiment(file)
    assert "hunter2" not in str(caught.value)


def test_domains_are_references(file: Path, tmp_path: Path) -> None:
    write_lamp_shop(tmp_path / "shop")
    file.write_text(SMALL.replace("seeds:", "domains: [burger, ./shop]\nseeds:"))
    experiment = read_experiment(file)
    assert experiment.domains == ("burger", str(tmp_path / "shop"))
    names = {cell.name for cell in experiment.cells}
    assert len(names) == len(experiment.cells)
    assert all("/" not in name for name in names)
    folder = ExperimentFolder.create_or_resume(tmp_path / "out", experiment)
    assert folder.problems(str(tmp_path / "shop")).problems == ()
