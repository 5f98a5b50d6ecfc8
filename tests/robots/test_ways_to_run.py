"""The same episodes give the same model, whoever runs the skills."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.starting import start_project
from skillwrapper.errors import LimitReachedError, UserError
from skillwrapper.robots.by_hand import HandRobot
from skillwrapper.robots.process import ProcessRobot
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.by_hand import learn_by_hand
from skillwrapper.runs.launch import learn, learn_recorded
from skillwrapper.runs.recordings import import_recording
from skillwrapper.runs.settings import RunSettings
from skillwrapper.world.observation import Observation

SERVE = f"{sys.executable} -m skillwrapper serve-robot"


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("ways") / "cubes"
    start_project(folder)
    return folder


@pytest.fixture(scope="module")
def settings(project: Path) -> RunSettings:
    return RunSettings.model_validate(
        {"domain": str(project), "iterations": 2, "exploration": {"budget": 7}}
    )


@pytest.fixture(scope="module")
def live(project: Path, settings: RunSettings) -> Path:
    assert learn(settings, project.parent / "live").model.operators
    return project.parent / "live"


def model_of(run: Path) -> dict[str, bytes]:
    files = [*(run / "model").iterdir(), *(run / "iterations").rglob("*.*")]
    return {str(file.relative_to(run)): file.read_bytes() for file in files}


def test_another_process_gives_the_same_model(
    live: Path, settings: RunSettings, tmp_path: Path
) -> None:
    robot = ProcessRobot(f"{SERVE} {settings.domain}", "cubes", 30)
    assert robot.replayable
    learn(settings, tmp_path / "run", environment=robot)
    robot.stop()
    assert model_of(tmp_path / "run") == model_of(live)


class Hands:
    """A person at the keyboard, who has the fake robot at hand and makes mistakes.

    Every ``mistake``-th skill is reported wrongly and taken back; after ``patience`` questions the
    person leaves.
    """

    def __init__(self, domain: str, mistake: int = 5, patience: int = 10**6) -> None:
        self.world = find_domain(domain).make_environment()
        self.seen = self.world.reset(seed=0)
        self.instances = {str(i): i for i in self.world.domain.skill_instances}
        self.mistake, self.patience, self.asked = mistake, patience, 0
        self.wrong = False
        self.true_answer: tuple[str, str] | None = None

    def answer(self, question: str) -> str:
        self.patience -= 1
        if self.patience < 0:
            return "q"
        if question.startswith("Set up"):
            self.seen = self.world.reset(seed=0)
            return ""
        call = question.removeprefix("Run ").partition(". How")[0]
        if self.wrong:
            self.wrong = False
            return "u"
        if self.true_answer is not None and self.true_answer[0] == call:
            answer, self.true_answer = self.true_answer[1], None
            return answer
        outcome = self.world.execute(self.instances[call])
        self.seen = outcome.observation
        self.asked += 1
        right, other = ("s", "f") if outcome.success else ("f", "s")
        if self.asked % self.mistake == 0:
            self.wrong, self.true_answer = True, (call, right)
            return other
        return right


class Camera(HandRobot):
    """A person whose camera shows what the fake robot shows."""

    def __init__(self, hands: Hands) -> None:
        super().__init__(hands.answer, "true %o")
        self._hands = hands

    def look(self) -> Observation:
        return self._hands.seen


def test_by_hand_with_mistakes_taken_back_and_left_twice_gives_the_same_model(
    live: Path, settings: RunSettings, tmp_path: Path
) -> None:
    said: list[str] = []
    hands = Hands(settings.domain, mistake=6)
    for patience in (4, 7, 10**6):
        hands.patience = patience
        try:
            learn_by_hand(settings, tmp_path / "run", Camera(hands), said.append)
        except LimitReachedError:
            continue
    assert any(text.startswith("Taken back") for text in said)
    assert model_of(tmp_path / "run") == model_of(live)


def log_of(run: Path, folder: Path) -> Iterator[dict[str, str]]:
    """The rows of a recording of a run; its pictures go into the folder."""
    for number, episode in enumerate(RunArchive(run).episodes(), start=1):
        for done in episode.transitions:
            files = {}
            for when, seen in (("before", done.before), ("after", done.after)):
                (picture,) = seen.pictures
                (folder / f"{picture.sha256}.png").write_bytes(picture.png)
                files[when] = f"{picture.sha256}.png"
            yield {
                "episode": str(number),
                "skill": done.instance.skill,
                "arguments": " ".join(done.instance.arguments),
                "success": str(done.success),
                **files,
            }


@pytest.mark.parametrize("form", ["csv", "jsonl"])
def test_a_recording_gives_the_same_model(
    form: str, live: Path, settings: RunSettings, tmp_path: Path
) -> None:
    rows = list(log_of(live, tmp_path))
    log = tmp_path / f"log.{form}"
    if form == "csv":
        with log.open("w", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    else:
        log.write_text("".join(json.dumps(row) + "\n" for row in rows))
    import_recording(find_domain(settings.domain), log, tmp_path / "run")
    learn_recorded(tmp_path / "run", settings)
    assert model_of(tmp_path / "run") == model_of(live)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"skill": "Pik"}, "Pik"),
        ({"arguments": "arm red_cup"}, "red_cup"),
        ({"arguments": "arm box"}, "box"),
        ({"arguments": "arm"}, "expected different objects of the types (arm, cube)"),
        ({"success": "perhaps"}, "expected true or false, got 'perhaps'"),
        ({"after": "missing.png"}, "missing.png: no such picture"),
        ({"after": "log.jsonl"}, "expected a picture"),
        ({"after": ""}, "expected a picture"),
        ({"after": "large.png"}, "as before, got 33 x 7; scale them alike"),
        ({"before": "large.png"}, "as before, got 33 x 7; scale them alike"),
        ({"before": "top=log.png front=log.png"}, "no such picture"),
        ({"scene": "nowhere"}, "nowhere"),
        ({"episode": ""}, "episode"),
        ({"colour": "red"}, "colour"),
    ],
)
def test_a_wrong_recording_is_refused_as_a_whole(
    changed: dict[str, str], said: str, live: Path, settings: RunSettings, tmp_path: Path
) -> None:
    rows = list(log_of(live, tmp_path))[:3]
    Image.new("RGB", (33, 7)).save(tmp_path / "large.png")
    pick = next(row for row in log_of(live, tmp_path) if row["skill"] == "Pick")
    log = tmp_path / "log.jsonl"
    wrong = [*rows, {**pick, **changed}, rows[0]]
    log.write_text("".join(json.dumps(row) + "\n" for row in wrong))
    with pytest.raises(UserError, match=r"log\.jsonl:4: ") as caught:
        import_recording(find_domain(settings.domain), log, tmp_path / "run")
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
    assert [p.name for p in tmp_path.iterdir() if p.suffix not in (".png", ".jsonl")] == []
