"""Known vocabularies, right labels: explorers alone, until the model makes no mistake."""

from __future__ import annotations

import pytest
from pottery import POTTERY, STATES, explore, mistakes

from skillwrapper.exploration.explorers import RandomExplorer
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.world import SkillInstance


@pytest.mark.slow
def test_pictures_that_never_repeat_deeds_that_cannot_be_undone_and_some_that_change_nothing() -> (
    None
):
    """Firing takes six skills in a row; seeds 0 to 7 took 87 to 117 executions."""
    reasons: list[str] = []
    planned = PlannedExplorer(POTTERY, ExplorationSettings(), seed=6)
    executions = explore(planned, 130, told=reasons.append)
    assert executions is not None
    assert sum("tests whether" in reason for reason in reasons) > 20


def test_chance_does_not_find_it() -> None:
    chance = RandomExplorer(POTTERY, None, ExplorationSettings(), seed=0)  # type: ignore[arg-type]
    assert explore(chance, 220) is None


def test_an_empty_model_is_mistaken_wherever_something_works() -> None:
    found = mistakes(AbstractModel(POTTERY, (), ()))
    assert {instance.skill for _, instance in found} == {s.name for s in POTTERY.skills}
    assert len(found) < len(STATES) * len(POTTERY.skill_instances)
    assert all(isinstance(instance, SkillInstance) for _, instance in found)
