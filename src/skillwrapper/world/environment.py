"""The protocol between skillwrapper and a robot or simulator."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Protocol, runtime_checkable

from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@runtime_checkable
class Environment(Protocol):
    """A robot or simulator with black-box skills, in Gymnasium's habits.

    ``reset`` comes first; ``execute`` and ``observe`` before it raise ``RobotError``.
    """

    @property
    def domain(self) -> Domain:
        """Types, objects and skills."""
        ...

    @property
    def scene(self) -> Scene:
        """The objects that are present now."""
        ...

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        """Bring the world to a start; the same seed and scene give the same start.

        Args:
            seed: chooses what may differ between starts.
            scene: name of one of the domain's scenes; None for the environment's choice.

        Raises:
            UnknownNameError: if there is no such scene.
        """
        ...

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance to its end, successful or not.

        Raises:
            RobotError: if the robot or simulator itself fails (not the skill).
            UnknownNameError: if there is no such skill instance.
        """
        ...

    def observe(self) -> Observation:
        """What is seen now; changes nothing."""
        ...

    def close(self) -> None:
        """Release what the environment holds; may be called twice."""
        ...


@runtime_checkable
class EnumerableEnvironment(Environment, Protocol):
    """A simulator whose states can be listed, set and copied: what exact verification needs.

    States are hashable, comparable and opaque to everything outside the domain.
    """

    def reachable_states(self, start: Any | None = None) -> Sequence[Any]:
        """All states reachable from ``start`` (default: the standard start), that one first."""
        ...

    def get_state(self) -> Any:
        """The present state."""
        ...

    def set_state(self, state: Any, *, seed: int | None = None) -> Observation:
        """Put the world into ``state``; a seed also chooses the layout of the picture."""
        ...

    def successor(self, state: Any, instance: SkillInstance) -> tuple[bool, Any]:
        """Success and next state of running ``instance`` in ``state``; changes nothing."""
        ...

    def observe_state(self, state: Any) -> Observation:
        """What would be seen in ``state`` in the present layout; changes nothing."""
        ...

    def true_atoms(self, state: Any) -> Iterator[tuple[str, tuple[str, ...]]]:
        """The simulator's own description of a state, for baselines and studies only."""
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
