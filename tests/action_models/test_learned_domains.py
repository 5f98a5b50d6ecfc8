"""What is learned from walks in small domains, beside what is true there."""

from __future__ import annotations

from pathlib import Path

import pytest
from planning_domains import (
    BELLS,
    FERRY,
    LAMPS,
    LOCKS,
    MINE,
    OBJECTS,
    POST,
    STARTS,
    VALVES,
    instances,
    strips_of,
    walk,
)

from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.models import DomainModel
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.strips import Strips, read_strips


def _printed(model: DomainModel, folder: Path) -> Strips:
    path = folder / "learned.pddl"
    path.write_text(print_model(model))
    return read_strips(path)


def _states(domain: Strips) -> set[frozenset[str]]:
    """All states that can be reached, by trying everything."""
    objects, start = OBJECTS[domain.skeleton.name], STARTS[domain.skeleton.name]
    found, left = {start}, [start]
    while left:
        state = left.pop()
        for name, arguments in domain.applicable(state, objects):
            after = domain.actions[name].apply(state, arguments)
            if after not in found:
                found.add(after)
                left.append(after)
    return found


@pytest.mark.parametrize(
    "text",
    [FERRY, LAMPS, LOCKS, POST, BELLS, VALVES],
    ids=["boats", "lamps", "locks", "post", "bells", "valves"],
)
@pytest.mark.parametrize("failures", [False, True], ids=["successes", "failures"])
def test_the_learned_domain_is_the_true_one(text: str, failures: bool, tmp_path: Path) -> None:
    true = strips_of(text, tmp_path)
    objects = OBJECTS[true.skeleton.name]
    steps = list(walk(true, 2500, seed=1, failures=failures))
    learned = _printed(learn_action_models(true.skeleton, steps), tmp_path)
    for state in _states(true):
        applicable = set(true.applicable(state, objects))
        assert set(learned.applicable(state, objects)) == applicable
        for name, arguments in applicable:
            after = learned.actions[name].apply(state, arguments)
            assert after == true.actions[name].apply(state, arguments)


def test_what_was_seen_is_accounted_for(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    for size in (1, 5, 20, 80):
        steps = list(walk(true, size, seed=2, failures=False))
        learned = _printed(learn_action_models(true.skeleton, steps), tmp_path)
        for step in steps:
            found = set(learned.applicable(step.before, OBJECTS["boats"]))
            assert (step.action, step.arguments) in found
            assert learned.actions[step.action].apply(step.before, step.arguments) == step.after


def test_what_no_condition_tells_apart_is_counted(tmp_path: Path) -> None:
    true = strips_of(BELLS, tmp_path)
    before, rung = STARTS["bells"], STARTS["bells"] | {"rings b"}
    steps = [Step("pull", ("b",), True, before, after) for after in (before, rung)]
    assert learn_action_models(true.skeleton, steps).actions["pull"].unexplained == 1
    assert learn_action_models(true.skeleton, steps[:1]).actions["pull"].unexplained == 0


def test_an_action_that_never_worked_is_left_out(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    state = STARTS["boats"]
    model = learn_action_models(true.skeleton, [Step("wait", (), False, state, state)])
    assert "wait" not in model.actions
    assert "(:action wait" not in print_model(model)


def test_order_does_not_matter_and_repetition_adds_nothing(tmp_path: Path) -> None:
    true = strips_of(LAMPS, tmp_path)
    steps = list(walk(true, 60, seed=3, failures=True))
    once = print_model(learn_action_models(true.skeleton, steps))
    assert print_model(learn_action_models(true.skeleton, [*reversed(steps), *steps])) == once


def test_failures_refute_what_merely_always_held(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    model = learn_action_models(true.skeleton, walk(true, 1500, seed=1, failures=True))
    land = model.actions["land"]
    assert "(full ?b)" in map(str, land.refuted)
    assert "(full ?b)" not in map(str, land.preconditions)
    few = learn_action_models(
        true.skeleton,
        walk(true, 1500, seed=1, failures=True),
        ActionModelSettings(enough_failures=10_000),
    )
    assert "(full ?b)" in map(str, few.actions["land"].preconditions)


def test_a_change_beyond_the_arguments_is_counted(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    before = STARTS["boats"]
    odd = Step("brew", (), True, before, before | {"storm", "full b1"})
    assert learn_action_models(true.skeleton, [odd]).actions["brew"].unexplained == 1


@pytest.mark.parametrize("level", ["none", "reasoned", "declared", "all"])
def test_levels_of_negative_preconditions(level: str, tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    settings = ActionModelSettings.model_validate({"negatives": level})
    calm = learn_action_models(
        true.skeleton, walk(true, 300, seed=1, failures=False), settings
    ).actions["sail"]
    tried = learn_action_models(
        true.skeleton, walk(true, 1500, seed=1, failures=True), settings
    ).actions["sail"]
    wanted = "(not (storm))"
    assert (wanted in map(str, calm.preconditions)) is (level in ("declared", "all"))
    assert (wanted in map(str, tried.preconditions)) is (level != "none")


def test_instances_include_equal_arguments(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    assert ("sail", ("b1", "p", "p")) in instances(true, OBJECTS["boats"])


def test_a_property_that_was_never_there_is_kept_out_of_an_action(tmp_path: Path) -> None:
    true = strips_of(MINE, tmp_path)
    start = STARTS["mine"]
    blasted = true.actions["blast"].apply(start, ("a",))
    steps = [Step("blast", ("a",), True, start, blasted)]
    kept = learn_action_models(true.skeleton, steps).actions["blast"]
    assert "(not (gold ?x))" in map(str, kept.preconditions)
    offered = Step("stay", (), True, start | {"loose b"}, start | {"loose b"})
    told = learn_action_models(true.skeleton, [*steps, offered]).actions["blast"]
    assert "(not (gold ?x))" not in map(str, told.preconditions)
    none = ActionModelSettings(negatives="none")
    bold = learn_action_models(true.skeleton, steps, none).actions["blast"]
    assert "(not (gold ?x))" not in map(str, bold.preconditions)


def test_failures_that_violate_much_refute_nothing_that_is_needed(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    for seed in range(5):
        steps = list(walk(true, 400, seed=seed, failures=True))
        learned = _printed(learn_action_models(true.skeleton, steps), tmp_path)
        for state in {step.before for step in steps}:
            found = set(learned.applicable(state, OBJECTS["boats"]))
            assert found <= set(true.applicable(state, OBJECTS["boats"]))
