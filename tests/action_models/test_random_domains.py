"""What is learned in random domains: sound whatever was seen, exact once all was."""

from __future__ import annotations

from hypothesis import assume, given, settings
from hypothesis import strategies as st
from random_planning_domains import OBJECTS, World, worlds

from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.steps import State, Step
from skillwrapper.action_models.strips import Strips, parse_strips

EVERYTHING = ActionModelSettings(negatives="all")


def _learned(world: World, steps: list[Step]) -> Strips:
    assume(any(step.success for step in steps))
    model = learn_action_models(world.true.skeleton, steps, EVERYTHING)
    return parse_strips(print_model(model), "learned.pddl")


def _applicable(domain: Strips, state: State) -> set[tuple[str, tuple[str, ...]]]:
    return set(domain.applicable(state, OBJECTS))


@settings(max_examples=150, deadline=None)
@given(worlds(), st.data())
def test_what_applies_truly_applies_and_what_worked_is_told(
    world: World, data: st.DataObject
) -> None:
    states = data.draw(st.lists(st.sampled_from(list(world.states)), min_size=1, max_size=6))
    steps = [s for s in world.steps(states) if data.draw(st.booleans())]
    learned = _learned(world, steps)
    for state in {step.before for step in steps}:
        assert _applicable(learned, state) <= _applicable(world.true, state)
    for step in steps:
        if step.success:
            assert (step.action, step.arguments) in _applicable(learned, step.before)
            assert learned.actions[step.action].apply(step.before, step.arguments) == step.after


@settings(max_examples=150, deadline=None)
@given(worlds(), st.booleans())
def test_everything_seen_gives_the_true_domain(world: World, failures: bool) -> None:
    steps = [s for s in world.steps(world.states) if failures or s.success]
    learned = _learned(world, steps)
    for state in world.states:
        applicable = _applicable(world.true, state)
        assert _applicable(learned, state) == applicable
        for name, arguments in applicable:
            after = world.true.actions[name].apply(state, arguments)
            assert learned.actions[name].apply(state, arguments) == after
