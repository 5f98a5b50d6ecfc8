"""The smallest environment that keeps every rule: a lamp that can be lit and put out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from PIL import Image

from skillwrapper.errors import ConfigurationError, RobotError
from skillwrapper.world import (
    Domain,
    Object,
    Observation,
    Outcome,
    Parameter,
    Picture,
    Scene,
    Skill,
    SkillInstance,
    TypeHierarchy,
    encode_png,
)

LAMP_DOMAIN = Domain(
    name="lamp",
    agent="A hand.",
    description="A lamp.",
    types=TypeHierarchy({"hand": (), "lamp": ()}),
    objects=(Object("hand", ("hand",)), Object("lamp", ("lamp",))),
    skills=tuple(
        Skill(name, (Parameter("hand", "hand"), Parameter("lamp", "lamp")))
        for name in ("Light", "PutOut")
    ),
    failures_change_nothing=True,
)


class LampEnvironment:
    """States are whether the lamp is lit; the seed chooses the colour of the picture."""

    replayable = True

    def __init__(self) -> None:
        self._lit = False
        self._seed: int | None = None

    @property
    def domain(self) -> Domain:
        return LAMP_DOMAIN

    @property
    def scene(self) -> Scene:
        return self.domain.scene()

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        self.domain.scene(scene)
        return self.set_state(False, seed=seed)

    def execute(self, instance: SkillInstance) -> Outcome:
        self.observe()
        success, self._lit = self.successor(self._lit, instance)
        return Outcome(success, self.observe())

    def observe(self) -> Observation:
        return self.observe_state(self._lit)

    def close(self) -> None:
        self._seed = None

    def reachable_states(self, start: bool | None = None) -> Sequence[bool]:
        return (bool(start), not start)

    def get_state(self) -> bool:
        return self._lit

    def set_state(self, state: bool, *, seed: int | None = None) -> Observation:
        self._lit = state
        self._seed = self._seed if seed is None else seed
        return self.observe()

    def successor(self, state: bool, instance: SkillInstance) -> tuple[bool, bool]:
        self.domain.check_instance(instance)
        wanted = instance.skill == "Light"
        return state != wanted, wanted

    def observe_state(self, state: bool) -> Observation:
        if self._seed is None:
            raise RobotError("expected reset first")
        colour = (255 if state else 0, self._seed % 256, 0)
        return Observation((Picture(encode_png(Image.new("RGB", (4, 4), colour))),))

    def true_atoms(self, state: bool) -> Iterator[tuple[str, tuple[str, ...]]]:
        if state:
            yield "lit", ("lamp",)

    def state_to_data(self, state: bool) -> dict[str, Any]:
        return {"lit": state}

    def state_from_data(self, data: Mapping[str, Any]) -> bool:
        if "lit" not in data:
            raise ConfigurationError("expected lit")
        return bool(data["lit"])
