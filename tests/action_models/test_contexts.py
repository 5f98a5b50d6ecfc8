"""One action with conditional effects, and several without: they say the same."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import command
from hypothesis import HealthCheck, assume, given, settings
from planning_domains import BELLS, LAMPS, OBJECTS, POST, strips_of, walk
from random_planning_domains import OBJECTS as RANDOM_OBJECTS
from random_planning_domains import World, worlds

from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.models import DomainModel
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.steps import State
from skillwrapper.action_models.strips import Strips, parse_strips
from skillwrapper.action_models.trace_files import print_trace

_Outcome = tuple[str, tuple[str, ...], State]


def _outcomes(domain: Strips, state: State, objects: dict[str, str]) -> list[_Outcome]:
    """What may be done, under the name that was given, and what comes of it; each as often."""
    return sorted(
        (
            (name.split("-")[0], arguments, domain.actions[name].apply(state, arguments))
            for name, arguments in domain.applicable(state, objects)
        ),
        key=lambda outcome: (outcome[0], outcome[1], sorted(outcome[2])),
    )


def _both(model: DomainModel) -> tuple[Strips, Strips]:
    one = parse_strips(print_model(model), "one.pddl")
    return one, parse_strips(print_model(model, "separate"), "several.pddl")


@pytest.mark.parametrize("text", [LAMPS, POST, BELLS], ids=["lamps", "post", "bells"])
def test_both_say_the_same(text: str, tmp_path: Path) -> None:
    true = strips_of(text, tmp_path)
    steps = list(walk(true, 800, seed=1, failures=False))
    model = learn_action_models(true.skeleton, steps)
    one, several = _both(model)
    assert "(when" not in print_model(model, "separate")
    assert len(several.actions) > len(one.actions)
    objects = OBJECTS[true.skeleton.name]
    for state in {step.before for step in steps}:
        assert _outcomes(several, state, objects) == _outcomes(one, state, objects)


@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(worlds())
def test_in_random_domains(world: World) -> None:
    steps = [s for s in world.steps(world.states) if s.success]
    assume(any(when for when, _ in world.true.actions["act"].effects) and steps)
    everything = ActionModelSettings(negatives="all")
    one, several = _both(learn_action_models(world.true.skeleton, steps, everything))
    for state in world.states:
        assert _outcomes(several, state, RANDOM_OBJECTS) == _outcomes(one, state, RANDOM_OBJECTS)


def test_bells_ring_in_two_ways(tmp_path: Path) -> None:
    true = strips_of(BELLS, tmp_path)
    model = learn_action_models(true.skeleton, walk(true, 800, seed=1, failures=False))
    _, several = _both(model)
    pulls = [a for name, a in several.actions.items() if name.startswith("pull-")]
    silent = [a for a in pulls if ((), (True, ("rings", "?b"))) not in a.effects]
    assert {(False, ("wound", "?b"))} <= set(silent[0].preconditions)
    assert ":conditional-effects" not in several.skeleton.requirements


def test_names_that_are_taken_are_left_alone(tmp_path: Path) -> None:
    text = BELLS.replace("(:action still", "(:action pull-1")
    true = strips_of(text, tmp_path)
    model = learn_action_models(true.skeleton, walk(true, 800, seed=1, failures=False))
    _, several = _both(model)
    assert several.actions["pull-1"].preconditions == ((True, ("rings", "?b")),)
    assert "pull-2" in several.actions


@pytest.mark.filterwarnings("ignore")  # of its parser
@pytest.mark.parametrize("form", ["conditional", "separate"])
def test_unified_planning_reads_it(form: str, tmp_path: Path) -> None:
    files = pytest.importorskip("unified_planning.io")
    true = strips_of(LAMPS, tmp_path)
    (tmp_path / "walk").write_text(print_trace(list(walk(true, 300, seed=1, failures=False))))
    given = ("learn-operators", tmp_path / "walk", "--domain", tmp_path / "domain.pddl")
    assert command(*given, "--effects", form, "--out", tmp_path / "out") == 0
    problem = files.PDDLReader().parse_problem(str(tmp_path / "out" / "domain.pddl"))
    conditional = [e for a in problem.actions for e in a.effects if e.is_conditional()]
    assert bool(conditional) is (form == "conditional")
    assert (len(problem.actions) > 3) is (form == "separate")
