"""Every rule of the Environment protocol has an environment that breaks it, and is caught."""

from __future__ import annotations

import io
from dataclasses import replace

import pytest
from lamp_environment import LAMP_DOMAIN, LampEnvironment
from PIL import Image

from skillwrapper.errors import ConformanceError
from skillwrapper.world import (
    Domain,
    Environment,
    Object,
    Observation,
    Outcome,
    Picture,
    Scene,
    SkillInstance,
)
from skillwrapper.world.conformance import check_environment


class NoDomain(LampEnvironment):
    @property
    def domain(self) -> Domain:
        return "lamp"  # type: ignore[return-value]


class ReadyBeforeReset(LampEnvironment):
    def __init__(self) -> None:
        super().__init__()
        self._seed = 0


class WrongErrorBeforeReset(LampEnvironment):
    def observe(self) -> Observation:
        if self._seed is None:
            raise KeyError("seed")
        return super().observe()


class StrangeObject(LampEnvironment):
    @property
    def scene(self) -> Scene:
        return Scene("default", (*LAMP_DOMAIN.objects, Object("elephant", ("lamp",))))


class WrongOrder(LampEnvironment):
    @property
    def scene(self) -> Scene:
        return Scene("default", LAMP_DOMAIN.objects[::-1])


class OneSceneForAll(LampEnvironment):
    """Takes no notice of the scene it is asked for."""

    @property
    def domain(self) -> Domain:
        objects = LAMP_DOMAIN.objects
        return replace(LAMP_DOMAIN, declared_scenes=(Scene("lit", objects), Scene("bare", objects)))

    @property
    def scene(self) -> Scene:
        return self.domain.scene("lit")


class AnyScene(LampEnvironment):
    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        return super().reset(seed=seed)


class NoPictures(LampEnvironment):
    def observe_state(self, state: bool) -> Observation:
        super().observe_state(state)
        return Observation(())


class SameCameraTwice(LampEnvironment):
    def observe_state(self, state: bool) -> Observation:
        return Observation(super().observe_state(state).pictures * 2)


class Jpeg(LampEnvironment):
    def observe_state(self, state: bool) -> Observation:
        super().observe_state(state)
        buffer = io.BytesIO()
        Image.new("RGB", (4, 4)).save(buffer, "JPEG")
        return Observation((Picture(buffer.getvalue()),))


class TornPicture(LampEnvironment):
    def observe_state(self, state: bool) -> Observation:
        return Observation((Picture(super().observe_state(state).pictures[0].png[:40]),))


class LookingChanges(LampEnvironment):
    def observe(self) -> Observation:
        seen = super().observe()
        self._lit = not self._lit
        return seen


class RandomStart(LampEnvironment):
    def __init__(self) -> None:
        super().__init__()
        self._resets = 0

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        self._resets += 1
        return super().reset(seed=seed + self._resets, scene=scene)


class ForgetsToReset(LampEnvironment):
    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        self.domain.scene(scene)
        return self.set_state(self._lit, seed=seed)


class AcceptsEverything(LampEnvironment):
    def successor(self, state: bool, instance: SkillInstance) -> tuple[bool, bool]:
        return False, state


class ChangedByNonsense(LampEnvironment):
    def execute(self, instance: SkillInstance) -> Outcome:
        self._lit = not self._lit
        return super().execute(instance)


class OldPictureInOutcome(LampEnvironment):
    def execute(self, instance: SkillInstance) -> Outcome:
        before = self.observe()
        return replace(super().execute(instance), observation=before)


class FailuresChangeSomething(LampEnvironment):
    def successor(self, state: bool, instance: SkillInstance) -> tuple[bool, bool]:
        return super().successor(state, instance)[0], not state


class ClosesOnce(LampEnvironment):
    def close(self) -> None:
        if self._seed is None:
            raise RuntimeError("closed already")
        self._seed = None


def test_environment_that_keeps_all_rules_passes() -> None:
    check_environment(LampEnvironment)


def test_failures_may_change_something_unless_declared_otherwise() -> None:
    class Declared(FailuresChangeSomething):
        @property
        def domain(self) -> Domain:
            return replace(LAMP_DOMAIN, failures_change_nothing=False)

    check_environment(Declared)


@pytest.mark.parametrize(
    ("broken", "check"),
    [
        (NoDomain, "protocol"),
        (object, "protocol"),
        (ReadyBeforeReset, "before reset"),
        (WrongErrorBeforeReset, "before reset"),
        (StrangeObject, "scene"),
        (WrongOrder, "scene"),
        (OneSceneForAll, "scene"),
        (AnyScene, "scene"),
        (NoPictures, "pictures"),
        (SameCameraTwice, "pictures"),
        (Jpeg, "pictures"),
        (TornPicture, "pictures"),
        (LookingChanges, "observe"),
        (RandomStart, "reset"),
        (ForgetsToReset, "reset"),
        (AcceptsEverything, "unknown instance"),
        (ChangedByNonsense, "unknown instance"),
        (OldPictureInOutcome, "outcome"),
        (FailuresChangeSomething, "failures change nothing"),
        (ClosesOnce, "close"),
    ],
)
def test_broken_environment_is_caught(broken: type[Environment], check: str) -> None:
    with pytest.raises(ConformanceError, match=r"expected .* got") as caught:
        check_environment(broken)
    assert caught.value.check == check
