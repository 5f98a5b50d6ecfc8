"""Damaged runs: whatever happens to a file, readers say so in one sentence, and resuming mends it.

The kind comes from a trial in which 234 of 990 mutated run files ended in tracebacks.
"""

from __future__ import annotations

import random
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path

import pytest
from benchmarks.damage import damage
from hypothesis import given, settings
from hypothesis import strategies as st
from lamps import LampAssistant, LampEnvironment, lamp_domain
from typer.testing import CliRunner

from skillwrapper.cli.main import app
from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import SkillWrapperError, UserError
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.algorithm import EarlierRun, LearningAlgorithm
from skillwrapper.runs.archive import ArchiveWriter, RunArchive, make_archive
from skillwrapper.runs.launch import learn
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings

LAMPS = RunSettings(
    domain="lamps",
    iterations=2,
    exploration=ExplorationSettings(budget=6, least_length=6, candidates=3),
)
READERS = ("show", "show --json", "show --pddl", "calls", "report", "verify", "plan")


class FewStates(BurgerEnvironment):
    """A kitchen of which only the first states are looked at."""

    @cached_property
    def _first(self) -> tuple[object, ...]:
        return super().reachable_states()[:3]

    def reachable_states(self, start=None):
        return self._first

    def successor(self, state, instance):
        success, after = super().successor(state, instance)
        return (success, after) if after in self._first else (False, state)


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short run of the bundled kitchen that leaves inconsistencies and predicates."""
    path = tmp_path_factory.mktemp("damage") / "run"
    asked = {"iterations": 2, "exploration.budget": 12, "model.noise": "gpt5"}
    learn({"domain": "burger", "seed": 2, "learning.attempts": 1, **asked}, path)
    return path


@pytest.fixture(scope="module")
def lamps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("lamps") / "run"
    run_lamps(path)
    return path


def run_lamps(path: Path) -> LearningResult:
    """Learn in a folder, or go on there."""
    domain = lamp_domain(path.parent)
    archive = make_archive(path, LAMPS, domain)
    earlier = EarlierRun(archive.episode, archive.layout.finished_iterations())
    watching = [ArchiveWriter(archive)]
    return LearningAlgorithm(
        LAMPS, LampEnvironment(domain), LampAssistant(), watching, earlier
    ).run()


@contextmanager
def damaged(original: Path, seed: int) -> Iterator[Path]:
    """A copy of a run of which one file is damaged."""
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run"
        shutil.copytree(original, path)
        folders = sorted({file.parent for file in path.rglob("*") if file.is_file()})
        files = sorted(file for file in chance.choice(folders).iterdir() if file.is_file())
        damage(chance.choice(files), chance)
        yield path


def arguments(reader: str, run: Path) -> list[str]:
    name, *options = reader.split()
    if name == "report":
        options = ["--out", str(run.parent / "page.html"), "--episodes", "1"]
    if name == "plan":
        picture = min(run.glob("images/*.png"), default=run)
        options = ["--init", str(picture), "--goal", str(picture), "--time-limit", "1"]
    return [name, str(run), *options]


@pytest.mark.parametrize("reader", READERS)
def test_a_whole_run_can_be_read(
    kitchen: Path, reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(DomainPackage, "make_environment", lambda package: FewStates())
    shutil.copytree(kitchen, tmp_path / "run")
    done = CliRunner().invoke(app, arguments(reader, tmp_path / "run"))
    assert done.exit_code == 0, (done.output, done.exception)


@settings(max_examples=20, deadline=None, derandomize=True, database=None)
@given(seed=st.integers(0, 10**9), reader=st.sampled_from(READERS))
def test_readers_say_what_is_damaged_in_one_sentence(kitchen: Path, seed: int, reader: str) -> None:
    with damaged(kitchen, seed) as run, pytest.MonkeyPatch.context() as patch:
        patch.setattr(DomainPackage, "make_environment", lambda package: FewStates())
        done = CliRunner().invoke(app, arguments(reader, run))
    if not isinstance(done.exception, SystemExit | None):
        assert isinstance(done.exception, SkillWrapperError), done.exc_info
        assert "\n" not in str(done.exception)


@settings(max_examples=20, deadline=None, derandomize=True, database=None)
@given(seed=st.integers(0, 10**9))
def test_resuming_mends_a_damaged_run_or_says_why_not(lamps: Path, seed: int) -> None:
    """A run that was mended is what it was; one that cannot be is named in one sentence."""
    with damaged(lamps, seed) as run:
        refusal = ""
        try:
            run_lamps(run)
        except UserError as error:
            refusal = str(error)
        assert "\n" not in refusal
        if refusal:
            return
        whole, mended = RunArchive.open(lamps), RunArchive.open(run)
        assert mended.latest().model == whole.latest().model
        for one, other in zip(mended.iterations(), whole.iterations(), strict=True):
            assert (one.summary, one.certificate) == (other.summary, other.certificate)
            assert (one.decisions, one.labels) == (other.decisions, other.labels)
