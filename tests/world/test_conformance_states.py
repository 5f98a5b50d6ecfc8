"""Every rule of a capability has a simulator that breaks it, and is caught."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import pytest
from lamp_environment import LampEnvironment

from skillwrapper.errors import ConformanceError
from skillwrapper.world import Enumerable, Observation, SkillInstance
from skillwrapper.world.conformance import check_environment


class NoStates(LampEnvironment):
    def reachable_states(self, start: bool | None = None) -> Sequence[bool]:
        return ()


class StateTwice(LampEnvironment):
    def reachable_states(self, start: bool | None = None) -> Sequence[bool]:
        return (*super().reachable_states(start), False)


class StartNotFirst(LampEnvironment):
    def reachable_states(self, start: bool | None = None) -> Sequence[bool]:
        return (False, True)


class StateMissing(LampEnvironment):
    def reachable_states(self, start: bool | None = None) -> Sequence[bool]:
        return (bool(start),)


class IgnoresSetState(LampEnvironment):
    def set_state(self, state: bool, *, seed: int | None = None) -> Observation:
        return super().set_state(self._lit if seed is None else state, seed=seed)


class ShowsAnotherState(LampEnvironment):
    def set_state(self, state: bool, *, seed: int | None = None) -> Observation:
        seen = super().set_state(state, seed=seed)
        return seen if seed is not None else super().observe_state(not state)


class LayoutDrifts(LampEnvironment):
    def set_state(self, state: bool, *, seed: int | None = None) -> Observation:
        if seed is None or self._seed is None or not state:
            return super().set_state(state, seed=seed)
        return super().set_state(state, seed=self._seed + 1)


class LayoutOfReset(LampEnvironment):
    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        self.domain.scene(scene)
        return super().set_state(False, seed=seed + 7)


class PredictsAlwaysSuccess(LampEnvironment):
    def execute(self, instance: SkillInstance) -> Any:
        success, self._lit = LampEnvironment.successor(self, self._lit, instance)
        outcome = super().execute(instance)
        return type(outcome)(success, outcome.observation)

    def successor(self, state: bool, instance: SkillInstance) -> tuple[bool, bool]:
        return True, super().successor(state, instance)[1]


class FailureChangesHiddenState(LampEnvironment):
    """The picture shows nothing of it, but the state counts failures."""

    def reachable_states(self, start: Any | None = None) -> Sequence[Any]:
        return (0, 1) if not start else (1, 0)

    def successor(self, state: Any, instance: SkillInstance) -> tuple[bool, Any]:
        super().successor(False, instance)
        return False, 1 - state

    def observe_state(self, state: Any) -> Observation:
        return super().observe_state(False)

    def state_to_data(self, state: Any) -> dict[str, Any]:
        return {"lit": int(state)}


class AskingChanges(LampEnvironment):
    def true_atoms(self, state: bool) -> Iterator[tuple[str, tuple[str, ...]]]:
        self._lit = state
        return super().true_atoms(state)


class DataLosesState(LampEnvironment):
    def state_to_data(self, state: bool) -> dict[str, Any]:
        return {"lit": False}


class DataAcceptsNonsense(LampEnvironment):
    def state_from_data(self, data: Mapping[str, Any]) -> bool:
        return bool(data.get("lit"))


class DataFailsBadly(LampEnvironment):
    def state_from_data(self, data: Mapping[str, Any]) -> bool:
        return bool(data["lit"])


class AtomsOfStrangers(LampEnvironment):
    def true_atoms(self, state: bool) -> Iterator[tuple[str, tuple[str, ...]]]:
        yield "lit", ("elephant",)


class AtomTwice(LampEnvironment):
    def true_atoms(self, state: bool) -> Iterator[tuple[str, tuple[str, ...]]]:
        yield from (("lit", ("lamp",)), ("lit", ("lamp",)))


def test_simulator_that_keeps_all_rules_passes() -> None:
    check_environment(LampEnvironment)


def test_basic_rules_are_checked_too() -> None:
    class Unready(LampEnvironment):
        def close(self) -> None:
            raise RuntimeError("stuck")

    with pytest.raises(ConformanceError, match=r"^close: "):
        check_environment(Unready)


@pytest.mark.parametrize(
    ("broken", "check"),
    [
        (NoStates, "reachable"),
        (StateTwice, "reachable"),
        (StartNotFirst, "reachable"),
        (StateMissing, "reachable"),
        (IgnoresSetState, "set state"),
        (ShowsAnotherState, "set state"),
        (LayoutDrifts, "seed of layout"),
        (LayoutOfReset, "seed of layout"),
        (PredictsAlwaysSuccess, "successor"),
        (FailureChangesHiddenState, "failures change nothing"),
        (AskingChanges, "changes nothing"),
        (DataLosesState, "state data"),
        (DataAcceptsNonsense, "state data"),
        (DataFailsBadly, "state data"),
        (AtomsOfStrangers, "true atoms"),
        (AtomTwice, "true atoms"),
    ],
)
def test_broken_simulator_is_caught(broken: type[Enumerable], check: str) -> None:
    with pytest.raises(ConformanceError, match=r"expected .*") as caught:
        check_environment(broken)
    assert caught.value.check == check
