"""The checks of what an environment says that it can do beside running skills."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Sequence
from typing import Any

from skillwrapper.errors import ConfigurationError, UserError
from skillwrapper.world.capabilities import (
    Enumerable,
    Judged,
    Replayable,
    Settable,
    Simulable,
    Truthful,
    require,
    supports,
)
from skillwrapper.world.examined import Examined, expect, expect_error
from skillwrapper.world.skills import SkillInstance, ground_skills

_PURPOSE = "its check"


def check_capabilities(examined: Examined, seed: int, sample: int) -> None:
    """Put an environment through the checks of all its capabilities.

    Args:
        examined: the environment; is reset.
        seed: of the resets and of the states that are chosen.
        sample: how many of the reachable states are looked at more closely.

    Raises:
        ConformanceError: names the first check that failed, the method, what was expected and
            what came.
    """
    environment = examined.environment
    if supports(environment, Judged):
        _check_goals(require(environment, Judged, _PURPOSE))
    if not supports(environment, Settable):
        return
    settable = require(environment, Settable, _PURPOSE)
    examined.reset("settable", seed)
    states = _some_states(settable, seed, sample)
    _check_set_state(settable, states)
    _check_data(settable, states)
    if supports(environment, Replayable):
        _check_layout(examined, settable, states, seed)
    if supports(environment, Simulable):
        _check_successor(settable, require(environment, Simulable, _PURPOSE), states)
    if supports(environment, Truthful):
        _check_atoms(require(environment, Truthful, _PURPOSE), states)
    _check_pure(examined, settable, states)


def _instances(environment: Settable) -> tuple[SkillInstance, ...]:
    return ground_skills(environment.domain.skills, environment.scene.objects)


def _some_states(environment: Settable, seed: int, sample: int) -> Sequence[Any]:
    """Some of the reachable states, or where random skills lead."""
    if supports(environment, Enumerable):
        states = require(environment, Enumerable, _PURPOSE).reachable_states()
        _check_reachable(require(environment, Enumerable, _PURPOSE), states)
        return random.Random(seed).sample(list(states), min(sample, len(states)))
    states = [environment.get_state()]
    chance, instances = random.Random(seed), _instances(environment)
    for _ in range(sample):
        environment.execute(chance.choice(instances))
        if environment.get_state() not in states:
            states.append(environment.get_state())
    return states


def _check_goals(environment: Judged) -> None:
    goals = environment.goals
    expect(
        bool(goals) and len(set(goals)) == len(goals),
        "judged",
        f"goals: expected different names, got {goals}",
    )
    for goal in goals:
        answer = environment.is_reached(goal)
        expect(
            isinstance(answer, bool),
            "judged",
            f"is_reached('{goal}'): expected true or false, got {answer!r}",
        )
    what = "is_reached('no such goal')"
    expect_error(UserError, "judged", what, lambda: environment.is_reached("no such goal"))


def _check_reachable(environment: Enumerable, states: Sequence[Any]) -> None:
    what = "reachable_states()"
    expect(bool(states), "reachable", f"{what}: expected at least the start, got no state")
    known = set(states)
    expect(len(known) == len(states), "reachable", f"{what}: expected each state once, got more")
    last = states[-1]
    first = next(iter(environment.reachable_states(last)), None)
    expect(
        first == last, "reachable", f"reachable_states({last}): expected that first, got {first}"
    )
    instances = _instances(environment)
    for state in states:
        for instance in instances:
            _, following = environment.successor(state, instance)
            expect(
                following in known,
                "reachable",
                f"{what}: expected {following}, to which {instance} leads, got no such state",
            )


def _check_set_state(environment: Settable, states: Sequence[Any]) -> None:
    pictures_repeat = supports(environment, Replayable)
    for state in states:
        seen = environment.set_state(state)
        got = environment.get_state()
        expect(got == state, "set state", f"get_state(): expected {state} as was set, got {got}")
        if pictures_repeat:
            same = seen.key == environment.observe().key == environment.set_state(state).key
            message = f"set_state({state}): expected the same pictures each time, got others"
            expect(same, "set state", message)


def _check_layout(
    examined: Examined, environment: Settable, states: Sequence[Any], seed: int
) -> None:
    state, what = states[0], f"set_state({states[0]}, seed={seed})"
    first = environment.set_state(state, seed=seed).key
    environment.set_state(state, seed=seed + 1)
    again = environment.set_state(state, seed=seed).key
    expect(first == again, "seed of layout", f"{what}: expected one picture, got two")
    examined.reset("seed of layout", seed)
    after_reset = environment.set_state(state).key
    expect(
        first == after_reset,
        "seed of layout",
        f"{what}: expected the layout of reset(seed={seed}), got another",
    )


def _check_successor(environment: Settable, simulable: Simulable, states: Sequence[Any]) -> None:
    constant = environment.domain.failures_change_nothing
    instances = _instances(environment)
    for state in states:
        for instance in instances:
            success, following = simulable.successor(state, instance)
            environment.set_state(state)
            outcome = environment.execute(instance)
            expected, got = (outcome.success, environment.get_state()), (success, following)
            what = f"successor({state}, {instance})"
            expect(got == expected, "successor", f"{what}: expected {expected}, got {got}")
            if constant and not success:
                message = f"{what}: expected the same state after a failure, got {following}"
                expect(following == state, "failures change nothing", message)


def _check_pure(examined: Examined, environment: Settable, states: Sequence[Any]) -> None:
    """What is said to change nothing must change nothing."""
    present, other = states[0], states[-1]
    arguments: dict[str, tuple[Any, ...]] = {
        "successor": (other, _instances(environment)[0]),
        "true_atoms": (other,),
        "reachable_states": (other,),
        "state_to_data": (other,),
    }
    calls: dict[str, Callable[..., Any]] = {
        name: getattr(environment, name) for name in arguments if hasattr(environment, name)
    }
    environment.set_state(present)
    for name, call in calls.items():
        found = call(*arguments[name])
        if name == "true_atoms":
            list(found)
        got = examined.state
        expect(got == present, "changes nothing", f"{name}({other}): expected {present}, got {got}")


def _check_data(environment: Settable, states: Sequence[Any]) -> None:
    for state in states:
        data = json.loads(json.dumps(environment.state_to_data(state)))
        got = environment.state_from_data(data)
        what = f"state_from_data({data})"
        expect(got == state, "state data", f"{what}: expected {state}, got {got}")
    nonsense = {"no such key": 0}
    expect_error(
        ConfigurationError,
        "state data",
        f"state_from_data({nonsense})",
        lambda: environment.state_from_data(nonsense),
    )


def _check_atoms(environment: Truthful, states: Sequence[Any]) -> None:
    for state in states:
        atoms, what = list(environment.true_atoms(state)), f"true_atoms({state})"
        terms = {term for _, arguments in atoms for term in arguments}
        unknown = sorted(terms - set(environment.scene.names))
        expect(not unknown, "true atoms", f"{what}: expected objects of the scene, got {unknown}")
        expect(len(set(atoms)) == len(atoms), "true atoms", f"{what}: expected each once, got more")
