"""Trying out a model: who does not look, or does not listen, is found out."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from command_line import command
from seen_kitchen import embedded_model

from skillwrapper.cli.main import main
from skillwrapper.domains.discovery import bundled_domains, find_domain
from skillwrapper.domains.starting import start_project
from skillwrapper.embedded import server_faults as faults
from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FaultPlan
from skillwrapper.errors import ConfigurationError
from skillwrapper.runs.doctor import examine
from skillwrapper.runs.findings import Finding
from skillwrapper.runs.settings import ModelSettings
from skillwrapper.runs.specimens import read_specimen
from skillwrapper.vlm.protocol import (
    ModelReply,
    ModelRequest,
    ModelWrapper,
    Role,
    VisionLanguageModel,
)
from skillwrapper.world.observation import Picture
from skillwrapper.world.skills import SkillInstance

SPECIMEN = read_specimen(next(p for p in bundled_domains() if p.has("doctor")))


class OldPicture(ModelWrapper):
    """Sees the same picture whatever is shown: the first one it ever saw."""

    def __init__(self) -> None:
        super().__init__(embedded_model(0))
        self.first: tuple[Picture, ...] = ()

    def complete(self, request: ModelRequest) -> ModelReply:
        self.first = self.first or request.pictures
        shown = self.first if request.pictures else ()
        return super().complete(
            ModelRequest(
                request.role, request.system, request.prompt, shown * len(request.pictures)
            )
        )


def findings(model: VisionLanguageModel, fault: str | None = None) -> list[Finding]:
    plan = FaultPlan(1.0, (fault,)) if fault else FaultPlan()
    with VlmServer(model, ServerSettings(faults=plan)) as server:
        return list(examine(ModelSettings(name="openai:embedded", base_url=server.url)))


@pytest.fixture(autouse=True)
def _environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)


def test_a_model_that_sees_passes() -> None:
    found = findings(embedded_model(0))
    assert all(finding.passed for finding in found), found
    assert found[-1].detail == "right about 4 of 4 true, 20 of 20 false, 2 of 2 changed"


@pytest.mark.parametrize(
    ("fault", "why"),
    [
        (faults.ALL_FALSE, "it says false of everything"),
        (faults.ALL_TRUE, "it says true of everything"),
        (faults.DEAF, "whatever is shown and asked|the same of all"),
    ],
)
def test_who_does_not_look_or_listen_fails(fault: str, why: str) -> None:
    found = findings(embedded_model(0), fault)
    assert not found[-1].passed
    assert found[-1].check == "reading pictures"
    assert any(words in found[-1].detail for words in why.split("|"))


def test_who_always_sees_the_same_picture_fails() -> None:
    found = findings(OldPicture())
    assert not found[-1].passed
    assert "different pictures" in found[-1].detail


def test_what_is_said_of_the_bundled_pictures_is_true() -> None:
    """Replays the skills in the simulator: same drawing, same atoms by the expert."""
    package = find_domain("burger")
    environment, expert = package.make_environment(), package.expert
    environment.reset(seed=3)
    steps = [("Pick", "lettuce"), ("Place", "lettuce", "board"), ("Pick", "patty")]
    for name, *rest in steps:
        assert environment.execute(SkillInstance(name, ("robot", *rest))).success
    names = {predicate.name for predicate in SPECIMEN.predicates}
    for truth in SPECIMEN.truth:
        true = {atom for atom in expert.atoms(environment.get_state()) if atom.predicate in names}
        assert {atom for atom, holds in truth.items() if holds} == true
        outcome = environment.execute(SPECIMEN.success.instance)
    assert not outcome.success


def test_a_domain_without_pictures_says_so(tmp_path: Path) -> None:
    (tmp_path / "domain.yaml").write_text("name: x\n")
    with pytest.raises(ConfigurationError):
        list(examine(ModelSettings(name="embedded"), str(tmp_path)))


def test_the_command(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    plan = FaultPlan(1.0, (faults.ALL_FALSE,))
    with VlmServer(embedded_model(0), ServerSettings(faults=plan)) as server:
        line = ["doctor", "--model", "openai:embedded", "--base-url", server.url, "--timeout", "9"]
        monkeypatch.setattr(sys, "argv", ["skillwrapper", *line])
        with pytest.raises(SystemExit) as stopped:
            main()
    assert stopped.value.code == 2
    assert "wrong reading pictures: right about 0 of 4 true" in capsys.readouterr().out


@pytest.fixture
def cubes(tmp_path: Path) -> Path:
    """A new project: a robot, and no known answers."""
    start_project(tmp_path / "cubes")
    return tmp_path / "cubes"


def test_without_known_answers_a_model_must_be_at_one_with_itself(cubes: Path) -> None:
    found = list(examine(ModelSettings(name="embedded"), str(cubes)))
    assert all(finding.passed for finding in found), found
    assert [f.check for f in found[3:]] == [
        "inventing predicates",
        "asked twice",
        "asked one by one",
        "telling things apart",
    ]


class Fickle(ModelWrapper):
    """Says true once and false once, or the same of everything."""

    def __init__(self, words: tuple[str, ...]) -> None:
        super().__init__(embedded_model(0))
        self.words, self.times = words, 0

    def complete(self, request: ModelRequest) -> ModelReply:
        if request.role is not Role.EVALUATE:
            return super().complete(request)
        self.times += 1
        atoms = request.prompt.partition("## Statements\n")[2].partition("\n\n")[0]
        word = self.words[self.times % len(self.words)]
        return ModelReply(atoms.replace("- ", "").replace(")", f"): {word}"))


@pytest.mark.parametrize(
    ("words", "check", "why"),
    [
        (("true", "false"), "asked twice", "contradicts itself"),
        (("true",), "telling things apart", "says true of everything"),
    ],
)
def test_whoever_contradicts_themselves_or_does_not_look_is_found_out(
    words: tuple[str, ...], check: str, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("skillwrapper.runs.doctor.open_model", lambda *given: Fickle(words))
    picture = find_domain("burger").folder / "doctor" / "carrying.png"
    found = list(examine(ModelSettings(name="embedded"), "burger", [str(picture)]))
    assert why in next(f.detail for f in found if f.check == check and not f.passed)


def test_pictures_that_are_given_are_shown(
    cubes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "mine.png"
    start = find_domain(str(cubes)).make_environment().reset(seed=0)
    picture.write_bytes(start.picture().png)
    assert command("doctor", cubes, "--model", "embedded", "--picture", picture) == 0
    assert "labels are the same" in capsys.readouterr().out
    assert command("doctor", cubes, "--model", "embedded", "--picture", "no.png") == 2
    assert command("doctor", "--model", "embedded", "--picture", picture) == 2
    assert "expected a domain to go with it" in capsys.readouterr().err
