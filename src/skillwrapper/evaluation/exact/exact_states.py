"""All states of all scenes of a domain, as far as they can be listed and read without error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.exact.labelled_states import (
    TRUTH_LAYOUT,
    LabelledStates,
    SceneStates,
)
from skillwrapper.evaluation.exact.state_readers import PictureReader, StateReader, system_reader
from skillwrapper.world.capabilities import Enumerable, Truthful, require, supports


@dataclass(frozen=True)
class ExactStates:
    """What exact figures rest on.

    Attributes:
        scenes: the states of every scene; none where they cannot be listed.
        read: the same with labels that are read without error; none where nothing reads so.
    """

    scenes: tuple[SceneStates, ...] = ()
    read: tuple[LabelledStates, ...] = ()

    @classmethod
    def of(cls, package: DomainPackage, folder: Path | None = None) -> ExactStates:
        """Those of a domain.

        Args:
            package: the domain.
            folder: where labels are kept; None for in memory only.
        """
        scenes = scene_states(package)
        reader = ExactReader.of(package)
        if reader is None:
            return cls(scenes)
        read = (LabelledStates(states, PictureReader(reader), folder) for states in scenes)
        return cls(scenes, tuple(read))

    def labelled(self, reader: StateReader) -> tuple[LabelledStates, ...]:
        """The states with the labels of another reader."""
        return tuple(LabelledStates(states, reader) for states in self.scenes)

    def told(self) -> tuple[LabelledStates, ...]:
        """The states with what the simulator says is true; none where it says nothing."""
        return tuple(
            LabelledStates(states, system_reader(require(states.environment, Truthful, "facts")))
            for states in self.scenes
            if supports(states.environment, Truthful)
        )


def scene_states(
    package: DomainPackage, scenes: Sequence[str] = (), layout: int = TRUTH_LAYOUT
) -> tuple[SceneStates, ...]:
    """The states of scenes; none where they cannot be listed.

    Args:
        package: the domain.
        scenes: names of scenes; none for all.
        layout: seed of the layout of the pictures.

    Raises:
        UnknownNameError: if there is no such scene.
    """
    found = []
    for name in scenes or package.domain.scenes:
        environment = package.make_environment()
        if not supports(environment, Enumerable):
            environment.close()
            return ()
        listed = require(environment, Enumerable, "exact figures")
        found.append(SceneStates(listed, name, layout))
    return tuple(found)
