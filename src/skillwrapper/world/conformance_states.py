"""The check that any simulator with enumerable states can be put through."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Sequence
from typing import Any

from skillwrapper.errors import ConfigurationError, ConformanceError
from skillwrapper.world.conformance import check_environment, require
from skillwrapper.world.environment import EnumerableEnvironment
from skillwrapper.world.skills import SkillInstance, ground_skills

Factory = Callable[[], EnumerableEnvironment]


def check_enumerable_environment(
    make: Factory, *, seed: int = 0, steps: int = 40, sample: int = 30
) -> None:
    """Put an environment through every check of the ``EnumerableEnvironment`` protocol.

    Args:
        make: makes a new environment; called several times.
        seed: of the resets, the skills and the states that are chosen.
        steps: how many random skill instances are run in a row.
        sample: how many reachable states are looked at more closely.

    Raises:
        ConformanceError: names the first check that failed, what was expected and what came.
    """
    check_environment(make, seed=seed, steps=steps)
    environment = make()
    environment.reset(seed=seed)
    states = environment.reachable_states()
    _check_reachable(environment, states)
    chosen = random.Random(seed).sample(list(states), min(sample, len(states)))
    _check_set_state(environment, chosen)
    _check_seed_of_layout(environment, chosen, seed)
    _check_successor(environment, chosen)
    _check_pure(environment, chosen)
    _check_data(environment, chosen)
    _check_atoms(environment, chosen)


def _instances(environment: EnumerableEnvironment) -> tuple[SkillInstance, ...]:
    domain = environment.domain
    return ground_skills(domain.skills, environment.scene.objects)


def _check_reachable(environment: EnumerableEnvironment, states: Sequence[Any]) -> None:
    require(bool(states), "reachable", "expected at least the start, got no state")
    known = set(states)
    require(len(known) == len(states), "reachable", "expected different states, got some twice")
    last = states[-1]
    first = next(iter(environment.reachable_states(last)), None)
    require(first == last, "reachable", f"expected the start {last} first, got {first}")
    instances = _instances(environment)
    for state in states:
        for instance in instances:
            _, following = environment.successor(state, instance)
            require(
                following in known,
                "reachable",
                f"expected the state after {instance} among the reachable ones, got {following}",
            )


def _check_set_state(environment: EnumerableEnvironment, states: Sequence[Any]) -> None:
    for state in states:
        seen = environment.set_state(state)
        got = environment.get_state()
        require(got == state, "set state", f"expected {state} after setting it, got {got}")
        same = seen.key == environment.observe().key == environment.observe_state(state).key
        require(same, "set state", f"expected one observation of {state}, got several")


def _check_seed_of_layout(
    environment: EnumerableEnvironment, states: Sequence[Any], seed: int
) -> None:
    state = states[0]
    first = environment.set_state(state, seed=seed).key
    environment.set_state(state, seed=seed + 1)
    again = environment.set_state(state, seed=seed).key
    require(first == again, "seed of layout", "expected one picture of one seed, got two")
    environment.reset(seed=seed)
    after_reset = environment.set_state(state).key
    require(
        first == after_reset,
        "seed of layout",
        "expected reset and set_state to choose the same layout by the same seed, got two",
    )


def _check_successor(environment: EnumerableEnvironment, states: Sequence[Any]) -> None:
    instances = _instances(environment)
    for state in states:
        for instance in instances:
            success, following = environment.successor(state, instance)
            environment.set_state(state)
            outcome = environment.execute(instance)
            expected, got = (success, following), (outcome.success, environment.get_state())
            require(
                expected == got,
                "successor",
                f"expected {expected} from executing {instance} in {state}, got {got}",
            )
            if environment.domain.failures_change_nothing and not success:
                require(
                    following == state,
                    "failures change nothing",
                    f"expected {state} after the failed {instance}, got {following}",
                )


def _check_pure(environment: EnumerableEnvironment, states: Sequence[Any]) -> None:
    """What is said to change nothing must change nothing."""
    present, other = states[0], states[-1]
    instance = _instances(environment)[0]
    calls: dict[str, Callable[[], object]] = {
        "successor": lambda: environment.successor(other, instance),
        "observe_state": lambda: environment.observe_state(other),
        "true_atoms": lambda: list(environment.true_atoms(other)),
        "reachable_states": lambda: environment.reachable_states(other),
        "state_to_data": lambda: environment.state_to_data(other),
    }
    seen = environment.set_state(present).key
    for name, call in calls.items():
        call()
        same = environment.get_state() == present and environment.observe().key == seen
        require(same, "changes nothing", f"expected {name} to change nothing, got another state")


def _check_data(environment: EnumerableEnvironment, states: Sequence[Any]) -> None:
    for state in states:
        data = json.loads(json.dumps(environment.state_to_data(state)))
        got = environment.state_from_data(data)
        require(got == state, "state data", f"expected {state} back from {data}, got {got}")
    nonsense = {"no such key": 0}
    try:
        environment.state_from_data(nonsense)
    except ConfigurationError:
        return
    except Exception as error:
        message = f"expected ConfigurationError from {nonsense}, got {error!r}"
        raise ConformanceError("state data", message) from error
    raise ConformanceError("state data", f"expected ConfigurationError from {nonsense}, got none")


def _check_atoms(environment: EnumerableEnvironment, states: Sequence[Any]) -> None:
    for state in states:
        atoms = list(environment.true_atoms(state))
        terms = {term for _, arguments in atoms for term in arguments}
        unknown = sorted(terms - set(environment.scene.names))
        require(not unknown, "true atoms", f"expected objects of the scene, got {unknown}")
        require(len(set(atoms)) == len(atoms), "true atoms", "expected each atom once, got more")
