from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import ValidationError

from skillwrapper.errors import ConfigurationError, UserError
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.runs.settings import FREE, ModelSettings, RunSettings
from skillwrapper.runs.settings_layers import SettingsLayers
from skillwrapper.runs.settings_tree import Setting, list_settings
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.settings import AskingSettings

BASE = RunSettings(domain="burger")


@pytest.mark.parametrize(
    "other",
    [
        RunSettings(domain="burger"),
        RunSettings(domain="burger", iterations=99),
        RunSettings(domain="burger", model=ModelSettings(base_url="http://localhost:1")),
        RunSettings(domain="burger", model=ModelSettings(asking=AskingSettings(parallel=8))),
    ],
)
def test_what_does_not_change_what_is_learned_may_differ(other: RunSettings) -> None:
    assert BASE.difference(other) == ""
    assert other.difference(BASE) == ""


@pytest.mark.parametrize(
    ("other", "where"),
    [
        (RunSettings(domain="panda"), "domain"),
        (RunSettings(domain="burger", seed=1), "seed"),
        (
            RunSettings(domain="burger", exploration=ExplorationSettings(budget=30)),
            "exploration.budget",
        ),
        (
            RunSettings(domain="burger", learning=LearningSettings(threshold=0.5)),
            "learning.threshold",
        ),
        (RunSettings(domain="burger", model=ModelSettings(name="openai:gpt-5")), "model.name"),
        (
            RunSettings(domain="burger", model=ModelSettings(asking=AskingSettings(votes=3))),
            "model.asking.votes",
        ),
        (
            RunSettings(domain="burger", model=ModelSettings(roles={Role.EVALUATE: "openai:x"})),
            "model.roles.evaluate",
        ),
    ],
)
def test_what_does_must_not(other: RunSettings, where: str) -> None:
    """Also a role that has a model of its own in one of them only."""
    assert BASE.difference(other).startswith(f"{where}: ")
    assert other.difference(BASE).startswith(f"{where}: ")


def test_the_difference_says_both_values() -> None:
    assert BASE.difference(RunSettings(domain="burger", seed=7)) == "seed: 0 there, 7 now"


def test_settings_survive_plain_data() -> None:
    config = RunSettings(
        domain="burger", seed=3, model=ModelSettings(roles={Role.INVENT: "a", Role.PROPOSE: "b"})
    )
    assert RunSettings.model_validate(config.model_dump(mode="json")) == config


@pytest.mark.parametrize("wrong", [{"iterations": 0}, {"seeds": 1}, {"learning": {"h": 1}}])
def test_mistakes_are_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        RunSettings.model_validate({"domain": "burger", **wrong})


def test_every_iteration_of_every_run_has_a_layout_of_its_own() -> None:
    seeds = {
        RunSettings(domain="burger", seed=seed).layout_seed(iteration)
        for seed in range(5)
        for iteration in range(1, 100)
    }
    assert len(seeds) == 5 * 99


KNOWN = list_settings(RunSettings)


@pytest.mark.parametrize("one", KNOWN, ids=lambda one: one.name)
def test_every_setting_says_what_it_means(one: Setting) -> None:
    """With the unit of every number, and which values there are."""
    assert one.meaning
    assert "<" not in one.expected
    assert "none from" not in one.expected
    assert one.required or one.name.startswith(("model", "calls")) or one.default is not None
    if "number" in one.expected:
        assert one.unit


def test_defaults_are_those_of_the_models() -> None:
    found = {one.name: one.default for one in KNOWN}
    assert found["exploration.budget"] == 15
    assert found["model.endpoint.timeout"] == 120.0
    assert found["scenes"] == []
    for name in FREE:
        assert any(one.name == name or one.name.startswith(f"{name}.") for one in KNOWN)


def layers(text: str = "", path: Path | None = None) -> SettingsLayers[RunSettings]:
    made = SettingsLayers(RunSettings)
    if path is not None:
        path.write_text(text)
        made.add_file(YamlDocument.read(path))
    return made


def test_later_layers_win(tmp_path: Path) -> None:
    file = "domain: lamps\nseed: 1\niterations: 7\nlearning: {attempts: 4, candidates: 2}\n"
    made = layers(file, tmp_path / "run.yaml")
    made.add("seed", 2, "--seed")
    made.assign("learning.attempts=5")
    made.assign("model.noise=0.05")
    made.assign("model.roles.invent=openai:gpt-5")
    made.assign("scenes=[left, right]")
    made.assign("calls.max_cost=null")
    settings = made.build()
    assert (settings.domain, settings.seed, settings.iterations) == ("lamps", 2, 7)
    assert (settings.learning.attempts, settings.learning.candidates) == (5, 2)
    assert settings.model.noise == "0.05"
    assert settings.model.roles == {Role.INVENT: "openai:gpt-5"}
    assert settings.scenes == ("left", "right")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("learning.atempts=5", "--set: unknown setting 'learning.atempts'; did you mean 'learning"),
        ("attempts=5", "--set: unknown setting 'attempts'"),
        ("learning=5", "--set: unknown setting 'learning'"),
        ("learning.attempts", "--set: expected NAME=VALUE"),
        ("=5", "--set: expected NAME=VALUE"),
        (
            "learning.attempts=zero",
            "--set learning.attempts: 'learning.attempts': expected a whole",
        ),
        ("learning.attempts=0", "expected greater than or equal to 1, got 0"),
        ("learning.attempts=", "expected a whole number, got None"),
        ("learning.invention=pears", "expected 'pairs' or 'batch', got 'pears'"),
        ("learning.prune=perhaps", "expected true or false"),
        ("scenes=bench", "expected a list"),
        ("scenes=[", "expected a value as in YAML"),
        ("model.roles.judge=x", "judge"),
    ],
)
def test_mistakes_say_where_and_what_was_expected(text: str, message: str) -> None:
    def build() -> None:
        made = layers()
        made.add("domain", "lamps", "DOMAIN")
        made.assign(text)
        made.build()

    with pytest.raises(UserError) as raised:
        build()
    assert message in str(raised.value)
    assert str(raised.value).startswith("--set")
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "domain: a\nlearning:\n  atempts: 3\n",
            r"run\.yaml:3: unknown key 'learning.atempts'; did",
        ),
        ("domain: a\nlearning:\n  attempts: no\n", r"run\.yaml:3: 'learning.attempts': expected"),
        ("- domain\n", r"run\.yaml:1: expected settings with their values"),
        ("seed: 3\n", r"run\.yaml:1: expected a value for 'domain', got none"),
        ("seed: 3\nseed: 4\n", r"run\.yaml:2: .*given twice"),
    ],
)
def test_mistakes_in_a_file_have_a_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(ConfigurationError, match=message):
        layers(text, tmp_path / "run.yaml").build()
