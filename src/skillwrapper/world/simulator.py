"""The smallest way to bring a simulator of one's own: where it starts, its rules and a drawing.

All else of an environment follows from these, all states and their pictures included::

    class TeaWorld(skillwrapper.Simulator[frozenset[str]]):
        def start(self):
            return frozenset()

        def obstacle(self, state, instance):
            return "the cup is full" if instance.arguments[1] in state else None

        def effect(self, state, instance):
            return state | {instance.arguments[1]}

        def draw(self, state, layout):
            return draw_cups(self.scene.names, state, layout)
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Hashable, Mapping, Sequence
from enum import Enum
from functools import cached_property
from typing import Any, Generic, TypeVar, get_args, get_origin

from pydantic import TypeAdapter, ValidationError

from skillwrapper.errors import ConfigurationError, PictureError, RobotError
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import Look, observation_of
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance, ground_skills

State = TypeVar("State", bound=Hashable)


class Simulator(ABC, Generic[State]):
    """Base class of simulators: enumerable and replayable environments.

    States are values: hashable, compared by what they hold, never changed. For files they are
    described by their kind, which stands in the brackets (``Simulator[frozenset[str]]``): plain
    values, dataclasses, named tuples, and sets and tuples of these.

    Args:
        domain: types, objects, skills and scenes.

    Attributes:
        replayable: whether pictures repeat byte for byte; they do if ``draw`` is a function.
    """

    replayable: bool = True

    def __init__(self, domain: Domain) -> None:
        self._domain = domain
        self._scene = domain.scene()
        self._state: State | None = None
        self._layout: int | None = None

    @abstractmethod
    def start(self) -> State:
        """The state in which the present scene starts."""

    @abstractmethod
    def obstacle(self, state: State, instance: SkillInstance) -> str | None:
        """Why a skill instance fails in a state, in words; None if it succeeds."""

    @abstractmethod
    def effect(self, state: State, instance: SkillInstance) -> State:
        """The state after a skill instance that succeeds."""

    @abstractmethod
    def draw(self, state: State, layout: int) -> Look:
        """What is seen in a state; the layout chooses whatever may look otherwise."""

    @property
    def domain(self) -> Domain:
        """Types, objects, skills and scenes."""
        return self._domain

    @property
    def scene(self) -> Scene:
        """The present scene; the domain's first one before the first reset."""
        return self._scene

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        """The start of a scene, in the layout of the seed.

        Raises:
            UnknownNameError: if there is no such scene.
        """
        self._scene = self._domain.scene(scene)
        return self.set_state(self.start(), seed=seed)

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance; a failed one changes nothing.

        Raises:
            RobotError: before the first reset.
            UnknownNameError: if there is no such skill, or no such object in the scene.
            ConfigurationError: if the arguments do not fit the skill.
        """
        state = self._started()
        self._domain.check_instance(instance, self._scene)
        reason = self.obstacle(state, instance)
        if reason is None:
            self._state = self.effect(state, instance)
        return Outcome(reason is None, self.observe(), reason or "")

    def observe(self) -> Observation:
        """The pictures of the present state.

        Raises:
            RobotError: before the first reset, or if what is drawn is no picture.
        """
        state = self._started()
        try:
            return observation_of(self.draw(state, self._layout or 0))
        except PictureError as error:
            raise RobotError(f"draw: {error}") from error

    def close(self) -> None:
        """Nothing is held; as before the first reset."""
        self._layout = None

    def get_state(self) -> State:
        """The present state.

        Raises:
            RobotError: before the first reset.
        """
        return self._started()

    def set_state(self, state: State, *, seed: int | None = None) -> Observation:
        """Put the world into a state of the present scene; a seed also chooses the layout.

        Raises:
            RobotError: before the first reset, if no seed is given.
        """
        self._layout = self._layout if seed is None else seed
        self._state = state
        return self.observe()

    def successor(self, state: State, instance: SkillInstance) -> tuple[bool, State]:
        """Success and next state of an instance; changes nothing.

        Raises:
            UnknownNameError: if there is no such skill, or no such object in the scene.
            ConfigurationError: if the arguments do not fit the skill.
        """
        self._domain.check_instance(instance, self._scene)
        if self.obstacle(state, instance) is not None:
            return False, state
        return True, self.effect(state, instance)

    def reachable_states(self, start: State | None = None) -> Sequence[State]:
        """All states reachable from one (default: the scene's start), in breadth-first order."""
        first = self.start() if start is None else start
        instances = ground_skills(self._domain.skills, self._scene.objects)
        found, waiting = {first: None}, deque([first])
        while waiting:
            state = waiting.popleft()
            for instance in instances:
                if self.obstacle(state, instance) is None:
                    following = self.effect(state, instance)
                    if following not in found:
                        found[following] = None
                        waiting.append(following)
        return tuple(found)

    def state_to_data(self, state: State) -> dict[str, Any]:
        """A plain description of a state for YAML and JSON files."""
        data = _plain(self._described.dump_python(state))
        return data if isinstance(data, dict) else {"state": data}

    def state_from_data(self, data: Mapping[str, Any]) -> State:
        """The state that ``state_to_data`` described.

        Raises:
            ConfigurationError: if it is not one of a state.
        """
        inner = data["state"] if isinstance(data, Mapping) and set(data) == {"state"} else data
        try:
            state: State = self._described.validate_python(inner)
        except ValidationError as error:
            raise ConfigurationError(f"expected the description of a state, got {data}") from error
        if self.state_to_data(state) != data:
            raise ConfigurationError(f"expected the description of a state, got {data}")
        return state

    @cached_property
    def _described(self) -> TypeAdapter[Any]:
        return TypeAdapter(_declared_state(type(self)) or type(self.start()))

    def _started(self) -> State:
        if self._state is None or self._layout is None:
            raise RobotError("expected reset(seed=...) first, got another call")
        return self._state


def _declared_state(simulator: type) -> Any:
    """What stands in the brackets of ``Simulator[...]``; None if nothing does."""
    bases = (b for c in simulator.__mro__ for b in getattr(c, "__orig_bases__", ()))
    declared = (get_args(base)[0] for base in bases if get_origin(base) is Simulator)
    return next((s for s in declared if s is not Any and not isinstance(s, TypeVar)), None)


def _plain(data: Any) -> Any:
    """The same for JSON; sets in an order that is always the same."""
    if isinstance(data, Mapping):
        return {str(key): _plain(value) for key, value in data.items()}
    if isinstance(data, set | frozenset):
        return sorted((_plain(value) for value in data), key=repr)
    if isinstance(data, list | tuple):
        return [_plain(value) for value in data]
    return data.value if isinstance(data, Enum) else data
