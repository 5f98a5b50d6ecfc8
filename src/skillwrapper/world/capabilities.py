"""What an environment may be able to do beside running skills (docs/semantics.md D20).

Each capability is a small protocol; whoever needs one asks for it with ``require`` where it is
needed. States are hashable, comparable and opaque to everything outside the domain.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any, Protocol, TypeVar

from skillwrapper.errors import ConfigurationError
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


class Settable(Environment, Protocol):
    """Its state can be read, set, and written into files."""

    def get_state(self) -> Any:
        """The present state."""
        ...

    def set_state(self, state: Any, *, seed: int | None = None) -> Observation:
        """Put the world into a state of the present scene; a seed also chooses the layout."""
        ...

    def state_to_data(self, state: Any) -> dict[str, Any]:
        """A plain description of the state for YAML and JSON files."""
        ...

    def state_from_data(self, data: dict[str, Any]) -> Any:
        """The state that ``state_to_data`` described.

        Raises:
            ConfigurationError: if the description is not one of a state.
        """
        ...


class Simulable(Environment, Protocol):
    """What a skill would do can be told without doing it."""

    def successor(self, state: Any, instance: SkillInstance) -> tuple[bool, Any]:
        """Success and next state of running ``instance`` in ``state``; changes nothing."""
        ...


class Enumerable(Settable, Simulable, Protocol):
    """All states can be listed, set and simulated: what exact verification needs."""

    def reachable_states(self, start: Any | None = None) -> Sequence[Any]:
        """All states reachable from ``start``, that one first.

        Args:
            start: None for the start of the present scene.
        """
        ...


class Truthful(Environment, Protocol):
    """It tells what is true, in words of its own; for baselines and studies only."""

    def true_atoms(self, state: Any) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The true atoms of a state: name of the predicate, names of the objects."""
        ...


class Judged(Environment, Protocol):
    """It has goals of its own and tells whether they are reached."""

    @property
    def goals(self) -> tuple[str, ...]:
        """Names of its goals."""
        ...

    def is_reached(self, goal: str) -> bool:
        """Whether a goal is reached now; changes nothing."""
        ...


class Replayable(Environment, Protocol):
    """The same seed, scene and skills give the same outcomes and pictures, byte for byte."""

    @property
    def replayable(self) -> bool:
        """True."""
        ...


class Filmed(Environment, Protocol):
    """It shows what happens while a skill runs."""

    def film(self, take: Callable[[Picture], None] | None) -> None:
        """Call ``take`` with a picture every so often while skills run; None to stop that."""
        ...


class Lasting(Environment, Protocol):
    """It stays as it was left when the program ended, and can be taken up again."""

    @property
    def lasting(self) -> bool:
        """True."""
        ...

    def take_up(self, scene: Scene) -> None:
        """Go on in the scene in which it was left, without any reset."""
        ...


class Haltable(Environment, Protocol):
    """It has an emergency stop that can be looked at."""

    def halted(self) -> str | None:
        """Why nothing may move now; None if it may. Is asked often, also while a skill runs."""
        ...


CAPABILITIES: Mapping[type, tuple[str, tuple[str, ...]]] = MappingProxyType(
    {
        Settable: ("settable", ("get_state", "set_state", "state_to_data", "state_from_data")),
        Simulable: ("simulable", ("successor",)),
        Enumerable: ("enumerable", ("reachable_states",)),
        Truthful: ("truthful", ("true_atoms",)),
        Judged: ("judged", ("goals", "is_reached")),
        Replayable: ("replayable", ("replayable",)),
        Lasting: ("lasting", ("lasting", "take_up")),
        Haltable: ("haltable", ("halted",)),
        Filmed: ("filmed", ("film",)),
    }
)
"""For every capability its name and the members that make it, without those it builds on."""

Capability = TypeVar("Capability", bound=Environment)


def supports(environment: Environment, capability: type) -> bool:
    """Whether an environment has a capability."""
    return not missing_members(environment, capability)


def capabilities_of(environment: Environment) -> tuple[str, ...]:
    """Names of the capabilities that an environment has."""
    return tuple(name for c, (name, _) in CAPABILITIES.items() if supports(environment, c))


def missing_members(environment: Environment, capability: type) -> tuple[str, ...]:
    """What an environment lacks for a capability."""
    needed = (m for c in capability.__mro__ if c in CAPABILITIES for m in CAPABILITIES[c][1])
    return tuple(m for m in needed if not getattr(environment, m, None))


def require(environment: Environment, capability: type[Capability], purpose: str) -> Capability:
    """The environment as one with a capability.

    Args:
        environment: of any kind.
        capability: one of ``CAPABILITIES``.
        purpose: what it is needed for, e.g. ``"exact verification"``.

    Raises:
        ConfigurationError: if it lacks the capability; names what is missing and what is there.
    """
    missing = missing_members(environment, capability)
    if missing:
        name, _ = CAPABILITIES[capability]
        there = ", ".join(capabilities_of(environment)) or "none of the capabilities"
        raise ConfigurationError(
            f"{environment.domain.name}: {purpose} needs an environment that is {name}; this one "
            f"lacks {', '.join(missing)} (it is {there})"
        )
    return environment  # type: ignore[return-value]


def look_at(environment: Settable, states: Iterable[Any]) -> tuple[Observation, ...]:
    """What is seen in states, in the present layout; afterwards the world is as before."""
    present = environment.get_state()
    seen = tuple(environment.set_state(state) for state in states)
    environment.set_state(present)
    return seen
