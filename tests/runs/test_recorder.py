"""Recording episodes so that a crash loses at most the skill in flight."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lamps import LampEnvironment, domain_file, lamp_domain, seen

from skillwrapper.errors import RobotError, RunFolderError
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.recorder import EpisodeRecorder, read_episode
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world import Domain, Episode, Observation, Scene, SkillInstance, Transition

LIGHT_LEFT = SkillInstance("Light", ("hand", "left"))
LIGHT_RIGHT = SkillInstance("Light", ("hand", "right"))
OUT_LEFT = SkillInstance("PutOut", ("hand", "left"))
SEQUENCE = (LIGHT_LEFT, LIGHT_RIGHT, OUT_LEFT, LIGHT_RIGHT)


@pytest.fixture
def domain(tmp_path: Path) -> Domain:
    return lamp_domain(tmp_path)


@pytest.fixture
def folder(tmp_path: Path) -> RunFolder:
    config = RunSettings(domain="lamps")
    return RunFolder.create_or_resume(tmp_path / "run", config, domain_file(tmp_path))


class Run:
    """Runs episode 1 and remembers what it was asked and told."""

    def __init__(
        self,
        folder: RunFolder,
        environment: LampEnvironment,
        sequence: tuple[SkillInstance, ...] = SEQUENCE,
    ) -> None:
        self.recorder = EpisodeRecorder(folder, environment)
        self.sequence = sequence
        self.starts: list[tuple[Scene, Observation]] = []
        self.told: list[Transition] = []

    def choose(self, scene: Scene, start: Observation) -> tuple[SkillInstance, ...]:
        self.starts.append((scene, start))
        return self.sequence

    def __call__(self) -> Episode:
        return self.recorder.run(1, 7, None, self.choose, self.told.append)


def crash_after(folder: RunFolder, domain: Domain, skills: int) -> None:
    with pytest.raises(RobotError, match="broke down"):
        Run(folder, LampEnvironment(domain, stops_after=skills))()


def test_an_episode_is_executed_and_recorded(folder: RunFolder, domain: Domain) -> None:
    run = Run(folder, LampEnvironment(domain))
    episode = run()
    assert [t.instance for t in episode.transitions] == list(SEQUENCE)
    assert [t.success for t in episode.transitions] == [True, False, True, True]
    assert episode.transitions[0].before == seen(seed=7)
    assert episode.transitions[0].after == episode.transitions[1].before == seen("left", seed=7)
    assert (episode.scene, episode.seed) == (domain.scene(), 7)
    assert run.told == list(episode.transitions)
    assert read_episode(folder, 1) == episode


def test_the_record_can_be_read_without_us(folder: RunFolder, domain: Domain) -> None:
    Run(folder, LampEnvironment(domain))()
    header, *entries = map(json.loads, folder.episode(1).read_text().splitlines())
    assert header["sequence"][0] == "Light(hand, left)"
    assert header["seed"] == 7
    assert entries[1] == {
        "skill": "Light",
        "arguments": ["hand", "right"],
        "success": False,
        "message": "no power",
        "after": [{"camera": "main", "sha256": seen("left", seed=7).pictures[0].sha256}],
    }


def test_what_is_recorded_is_not_executed_again(folder: RunFolder, domain: Domain) -> None:
    first = Run(folder, LampEnvironment(domain))()
    again = Run(folder, LampEnvironment(domain, stops_after=0))
    assert again() == first
    assert again.told == []
    assert again.starts == [(first.scene, seen(seed=7))]


@pytest.mark.parametrize("skills", [0, 1, 3])
def test_a_partial_episode_is_continued(
    folder: RunFolder, domain: Domain, skills: int, tmp_path: Path
) -> None:
    """The environment is brought to where the record ends, and goes on from there."""
    crash_after(folder, domain, skills)
    environment = LampEnvironment(domain)
    resumed = Run(folder, environment)
    episode = resumed()
    assert environment.executed == list(SEQUENCE)
    assert resumed.told == list(episode.transitions[skills:])
    whole = RunFolder.create_or_resume(
        tmp_path / "whole", RunSettings(domain="lamps"), domain_file(tmp_path)
    )
    assert Run(whole, LampEnvironment(domain))() == episode
    assert whole.episode(1).read_bytes() == folder.episode(1).read_bytes()


@pytest.mark.parametrize("cut", [1, 40])
def test_a_line_cut_by_a_crash_is_executed_again(
    folder: RunFolder, domain: Domain, cut: int
) -> None:
    whole = Run(folder, LampEnvironment(domain))()
    record = folder.episode(1)
    data = record.read_bytes()
    record.write_bytes(data[:-cut])
    resumed = Run(folder, LampEnvironment(domain))
    assert resumed() == whole
    assert resumed.told == [whole.transitions[-1]]
    assert record.read_bytes() == data


def test_a_cut_header_starts_afresh(folder: RunFolder, domain: Domain) -> None:
    whole = Run(folder, LampEnvironment(domain))()
    record = folder.episode(1)
    record.write_bytes(record.read_bytes()[:30])
    assert Run(folder, LampEnvironment(domain))() == whole


def test_an_environment_that_starts_otherwise_is_refused(folder: RunFolder, domain: Domain) -> None:
    crash_after(folder, domain, 1)

    class Repainted(LampEnvironment):
        def observe(self) -> Observation:
            return seen(*self._lit, seed=99)

    with pytest.raises(RobotError, match="shows another picture"):
        Run(folder, Repainted(domain))()


def test_an_environment_that_goes_another_way_is_refused(folder: RunFolder, domain: Domain) -> None:
    crash_after(folder, domain, 2)
    before = folder.episode(1).read_bytes()

    class Brighter(LampEnvironment):
        """Has power for both lamps."""

        def execute(self, instance: SkillInstance):
            outcome = super().execute(instance)
            return outcome if outcome.success else super().execute(OUT_LEFT)

    with pytest.raises(RobotError, match=r"Light\(hand, right\) went another way"):
        Run(folder, Brighter(domain))()
    assert folder.episode(1).read_bytes() == before


def test_an_environment_that_looks_otherwise_on_the_way_is_refused(
    folder: RunFolder, domain: Domain
) -> None:
    crash_after(folder, domain, 1)

    class Repainted(LampEnvironment):
        def execute(self, instance: SkillInstance):
            self._seed = 99
            return super().execute(instance)

    with pytest.raises(RobotError, match=r"Light\(hand, left\) went another way"):
        Run(folder, Repainted(domain))()


def test_what_cannot_be_repeated_ends_where_the_record_ends(
    folder: RunFolder, domain: Domain
) -> None:
    """A robot cannot bring the world back to where it was."""
    crash_after(folder, domain, 2)

    class Robot(LampEnvironment):
        replayable = False

    environment = Robot(domain)
    episode = Run(folder, environment)()
    assert [t.instance for t in episode.transitions] == list(SEQUENCE[:2])
    assert environment.executed == []
    assert environment.resets == []


def test_another_choice_than_recorded_is_refused(folder: RunFolder, domain: Domain) -> None:
    Run(folder, LampEnvironment(domain))()
    with pytest.raises(RunFolderError, match="another sequence was recorded"):
        Run(folder, LampEnvironment(domain), SEQUENCE[::-1])()


def test_there_is_nothing_to_read_before_it_is_recorded(folder: RunFolder) -> None:
    with pytest.raises(RunFolderError, match="expected a recorded episode"):
        read_episode(folder, 1)
