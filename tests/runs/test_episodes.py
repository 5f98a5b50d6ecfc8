"""Recording episodes so that a crash loses at most the skill in flight."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lamps import LampEnvironment, lamp_domain, seen

from skillwrapper.errors import FileError, RobotError, RunFolderError
from skillwrapper.exploration.explorer import NextSkill
from skillwrapper.runs.archive import ArchiveWriter, RunArchive, make_archive
from skillwrapper.runs.episodes import EpisodeRunner, EpisodeSoFar
from skillwrapper.runs.events import EpisodeStarted, RunEvent, SkillExecuted
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world import Domain, Episode, Observation, SkillInstance, Transition

LIGHT_LEFT = SkillInstance("Light", ("hand", "left"))
LIGHT_RIGHT = SkillInstance("Light", ("hand", "right"))
OUT_LEFT = SkillInstance("PutOut", ("hand", "left"))
SEQUENCE = (LIGHT_LEFT, LIGHT_RIGHT, OUT_LEFT, LIGHT_RIGHT)
SETTINGS = RunSettings(domain="lamps")


@pytest.fixture
def domain(tmp_path: Path) -> Domain:
    return lamp_domain(tmp_path)


@pytest.fixture
def archive(tmp_path: Path, domain: Domain) -> RunArchive:
    return make_archive(tmp_path / "run", SETTINGS, domain)


class Run:
    """Runs episode 1, recorded by an archive, and remembers what it was asked and told."""

    def __init__(
        self,
        archive: RunArchive,
        environment: LampEnvironment,
        sequence: tuple[SkillInstance, ...] = SEQUENCE,
    ) -> None:
        self.archive = archive
        self.writer = ArchiveWriter(archive)
        self.runner = EpisodeRunner(environment, self.tell)
        self.sequence = sequence
        self.asked: list[Observation] = []
        self.told: list[Transition] = []
        self.started = 0

    def tell(self, event: RunEvent) -> None:
        self.writer(event)
        self.started += isinstance(event, EpisodeStarted)
        if isinstance(event, SkillExecuted):
            self.told.append(event.transition)

    def choose(self, done: EpisodeSoFar) -> NextSkill:
        self.asked.append(done.observation)
        position = len(done.transitions)
        return NextSkill(self.sequence[position] if position < len(self.sequence) else None)

    def __call__(self) -> Episode:
        recorded = self.archive.episode(1)
        if recorded is not None:
            return self.runner.follow(1, 1, recorded, "default", self.choose)
        return self.runner.run(1, 1, 7, "default", self.choose)


def crash_after(archive: RunArchive, domain: Domain, skills: int) -> None:
    with pytest.raises(RobotError, match="broke down"):
        Run(archive, LampEnvironment(domain, stops_after=skills))()


def test_an_episode_is_executed_and_recorded(archive: RunArchive, domain: Domain) -> None:
    run = Run(archive, LampEnvironment(domain))
    episode = run()
    assert [t.instance for t in episode.transitions] == list(SEQUENCE)
    assert [t.success for t in episode.transitions] == [True, False, True, True]
    assert episode.transitions[0].before == seen(seed=7)
    assert episode.transitions[0].after == episode.transitions[1].before == seen("left", seed=7)
    assert (episode.scene.names, episode.seed) == (("hand", "left", "right"), 7)
    assert run.told == list(episode.transitions)
    recorded = archive.episode(1)
    assert recorded is not None
    assert recorded.to_episode() == episode


def test_every_skill_is_chosen_after_the_one_before_was_seen(
    archive: RunArchive, domain: Domain
) -> None:
    run = Run(archive, LampEnvironment(domain))
    episode = run()
    assert run.asked == [seen(seed=7), *(t.after for t in episode.transitions)]


def test_the_record_can_be_read_without_us(archive: RunArchive, domain: Domain) -> None:
    Run(archive, LampEnvironment(domain))()
    header, *entries = map(json.loads, archive.layout.episode(1).read_text().splitlines())
    assert header["scene"] == {"name": "default", "objects": ["hand", "left", "right"]}
    assert header["seed"] == 7
    assert entries[1] == {
        "skill": "Light",
        "arguments": ["hand", "right"],
        "success": False,
        "message": "no power",
        "after": [{"camera": "main", "sha256": seen("left", seed=7).pictures[0].sha256}],
    }


def test_what_is_recorded_is_not_executed_again(archive: RunArchive, domain: Domain) -> None:
    first = Run(archive, LampEnvironment(domain))()
    again = Run(archive, LampEnvironment(domain, stops_after=0))
    assert again() == first
    assert (again.told, again.started) == ([], 0)
    assert again.asked == [seen(seed=7), *(t.after for t in first.transitions)]


@pytest.mark.parametrize("skills", [0, 1, 3])
def test_a_partial_episode_is_continued(
    archive: RunArchive, domain: Domain, skills: int, tmp_path: Path
) -> None:
    """The environment is brought to where the record ends, and goes on from there."""
    crash_after(archive, domain, skills)
    environment = LampEnvironment(domain)
    resumed = Run(archive, environment)
    episode = resumed()
    assert environment.executed == list(SEQUENCE)
    assert resumed.told == list(episode.transitions[skills:])
    whole = make_archive(tmp_path / "whole", SETTINGS, domain)
    assert Run(whole, LampEnvironment(domain))() == episode
    assert whole.layout.episode(1).read_bytes() == archive.layout.episode(1).read_bytes()


@pytest.mark.parametrize("cut", [1, 40])
def test_a_line_cut_by_a_crash_is_executed_again(
    archive: RunArchive, domain: Domain, cut: int
) -> None:
    whole = Run(archive, LampEnvironment(domain))()
    record = archive.layout.episode(1)
    data = record.read_bytes()
    record.write_bytes(data[:-cut])
    resumed = Run(archive, LampEnvironment(domain))
    assert resumed() == whole
    assert resumed.told == [whole.transitions[-1]]
    assert record.read_bytes() == data


def test_a_cut_header_starts_afresh(archive: RunArchive, domain: Domain) -> None:
    whole = Run(archive, LampEnvironment(domain))()
    record = archive.layout.episode(1)
    record.write_bytes(record.read_bytes()[:30])
    assert Run(archive, LampEnvironment(domain))() == whole


def test_an_environment_that_starts_otherwise_is_refused(
    archive: RunArchive, domain: Domain
) -> None:
    crash_after(archive, domain, 1)

    class Repainted(LampEnvironment):
        def observe(self) -> Observation:
            return seen(*self._lit, seed=99)

    with pytest.raises(RobotError, match="shows another picture"):
        Run(archive, Repainted(domain))()


def test_an_environment_that_goes_another_way_is_refused(
    archive: RunArchive, domain: Domain
) -> None:
    crash_after(archive, domain, 2)
    before = archive.layout.episode(1).read_bytes()

    class Brighter(LampEnvironment):
        """Has power for both lamps."""

        def execute(self, instance: SkillInstance):
            outcome = super().execute(instance)
            return outcome if outcome.success else super().execute(OUT_LEFT)

    with pytest.raises(RobotError, match=r"Light\(hand, right\) went another way"):
        Run(archive, Brighter(domain))()
    assert archive.layout.episode(1).read_bytes() == before


def test_an_environment_that_looks_otherwise_on_the_way_is_refused(
    archive: RunArchive, domain: Domain
) -> None:
    crash_after(archive, domain, 1)

    class Repainted(LampEnvironment):
        def execute(self, instance: SkillInstance):
            self._seed = 99
            return super().execute(instance)

    with pytest.raises(RobotError, match=r"Light\(hand, left\) went another way"):
        Run(archive, Repainted(domain))()


def test_what_cannot_be_repeated_ends_where_the_record_ends(
    archive: RunArchive, domain: Domain
) -> None:
    """A robot cannot bring the world back to where it was."""
    crash_after(archive, domain, 2)

    class Robot(LampEnvironment):
        replayable = False

    environment = Robot(domain)
    episode = Run(archive, environment)()
    assert [t.instance for t in episode.transitions] == list(SEQUENCE[:2])
    assert environment.executed == []
    assert environment.resets == []


@pytest.mark.parametrize("other", [SEQUENCE[::-1], SEQUENCE[:2]])
def test_another_choice_than_recorded_is_refused(
    archive: RunArchive, domain: Domain, other: tuple[SkillInstance, ...]
) -> None:
    Run(archive, LampEnvironment(domain))()
    with pytest.raises(RunFolderError, match=r"was recorded, and this version chooses"):
        Run(archive, LampEnvironment(domain), other)()


def test_there_is_nothing_to_read_before_it_is_recorded(archive: RunArchive) -> None:
    assert archive.episode(1) is None


@pytest.mark.parametrize(
    ("line", "old", "new", "message"),
    [
        (2, '"Light"', '"Lihgt"', "1: |jsonl:2: unknown skill 'Lihgt'; did you mean 'Light'"),
        (2, '["hand", "left"]', '["left", "hand"]', "jsonl:2: .*expected different objects"),
        (1, '"left", "right"', '"left", "cellar"', "jsonl:1: expected objects of the domain, got"),
        (3, "true", "1", "jsonl:3: 'success': expected true or false, got 1"),
        (
            3,
            '"sha256": "',
            '"sha256": "../',
            r"jsonl:3: 'after.0.sha256': expected text of the form",
        ),
        (1, '"seed": 7', '"seed": "7"', "jsonl:1: 'seed': expected a whole number"),
    ],
)
def test_damage_is_named_with_its_line(
    archive: RunArchive, domain: Domain, line: int, old: str, new: str, message: str
) -> None:
    Run(archive, LampEnvironment(domain), (LIGHT_LEFT, OUT_LEFT))()
    path = archive.layout.episode(1)
    lines = path.read_text().splitlines()
    assert old in lines[line - 1]
    lines[line - 1] = lines[line - 1].replace(old, new, 1)
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(FileError, match=message):
        archive.episode(1)
