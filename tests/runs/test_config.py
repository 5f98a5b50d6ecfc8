from __future__ import annotations

import pytest
from pydantic import ValidationError

from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.learning.settings import LearningSettings
from skillwrapper.runs.config import ModelSettings, RunConfig
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.settings import AssistantSettings

BASE = RunConfig(domain="burger")


@pytest.mark.parametrize(
    "other",
    [
        RunConfig(domain="burger"),
        RunConfig(domain="burger", iterations=99),
        RunConfig(domain="burger", model=ModelSettings(base_url="http://localhost:1")),
        RunConfig(domain="burger", model=ModelSettings(assistant=AssistantSettings(parallel=8))),
    ],
)
def test_what_does_not_change_what_is_learned_may_differ(other: RunConfig) -> None:
    assert BASE.difference(other) == ""
    assert other.difference(BASE) == ""


@pytest.mark.parametrize(
    ("other", "where"),
    [
        (RunConfig(domain="panda"), "domain"),
        (RunConfig(domain="burger", seed=1), "seed"),
        (
            RunConfig(domain="burger", exploration=ExplorationSettings(budget=30)),
            "exploration.budget",
        ),
        (
            RunConfig(domain="burger", learning=LearningSettings(threshold=0.5)),
            "learning.threshold",
        ),
        (RunConfig(domain="burger", model=ModelSettings(name="openai:gpt-5")), "model.name"),
        (
            RunConfig(domain="burger", model=ModelSettings(assistant=AssistantSettings(votes=3))),
            "model.assistant.votes",
        ),
        (
            RunConfig(domain="burger", model=ModelSettings(roles={Role.EVALUATE: "openai:x"})),
            "model.roles.evaluate",
        ),
    ],
)
def test_what_does_must_not(other: RunConfig, where: str) -> None:
    """Also a role that has a model of its own in one of them only."""
    assert BASE.difference(other).startswith(f"{where}: ")
    assert other.difference(BASE).startswith(f"{where}: ")


def test_the_difference_says_both_values() -> None:
    assert BASE.difference(RunConfig(domain="burger", seed=7)) == "seed: 0 there, 7 now"


def test_settings_survive_plain_data() -> None:
    config = RunConfig(
        domain="burger", seed=3, model=ModelSettings(roles={Role.INVENT: "a", Role.PROPOSE: "b"})
    )
    assert RunConfig.model_validate(config.model_dump(mode="json")) == config


@pytest.mark.parametrize("wrong", [{"iterations": 0}, {"seeds": 1}, {"learning": {"h": 1}}])
def test_mistakes_are_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        RunConfig.model_validate({"domain": "burger", **wrong})


def test_every_iteration_of_every_run_has_a_layout_of_its_own() -> None:
    seeds = {
        RunConfig(domain="burger", seed=seed).layout_seed(iteration)
        for seed in range(5)
        for iteration in range(1, 100)
    }
    assert len(seeds) == 5 * 99
