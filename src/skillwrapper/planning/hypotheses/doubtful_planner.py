"""From readings of start and goal to what is believed of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from skillwrapper.grounding import TRUE, AtomSpace, GroundModel, Labels
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.reading_model import ReadingModel
from skillwrapper.planning.goals import Goal, goal_from_state
from skillwrapper.planning.hypotheses.beliefs import Beliefs, GoalCandidates, likeliest
from skillwrapper.planning.hypotheses.possible_states import PossibleStates
from skillwrapper.planning.hypotheses.settings import HypothesesSettings
from skillwrapper.symbols import AbstractModel
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True, eq=False)
class WantedReading:
    """A goal as it was read and written.

    Attributes:
        read: labels (atoms,) of the picture of the goal; None if there is none.
        written: what must hold for certain; None for nothing.
        positive_only: whether of the picture only what is true is wanted (D12).
    """

    read: Labels | None = None
    written: Goal | None = None
    positive_only: bool = False

    def as_read(self, space: AtomSpace) -> Goal:
        """The goal as it was read, without a doubt.

        Raises:
            GoalError: if the picture shows what contradicts what is written.
        """
        seen = (
            goal_from_state(space, self.read, positive_only=self.positive_only)
            if self.read is not None
            else Goal.all_of(())
        )
        return seen if self.written is None else seen.together_with(self.written)


@dataclass(frozen=True)
class DoubtfulPlanner:
    """Makes hypotheses of start and goal, for one model.

    Attributes:
        model: the model.
        acquaintance: what is known of readings, and of the states of scenes.
        settings: how many hypotheses are kept.
        priors: what is believed of readings beforehand.
    """

    model: AbstractModel
    acquaintance: Acquaintance
    settings: HypothesesSettings = field(default_factory=HypothesesSettings)
    priors: Priors = field(default_factory=Priors)

    def beliefs(self, scene: Scene, start: Labels, goal: WantedReading) -> Beliefs | None:
        """What is believed of a problem.

        Args:
            scene: what is present.
            start: what was read (atoms,) of the start.
            goal: what was read of the goal, and what is written.

        Returns:
            None where the states of the scene are unknown, or too many to tell apart.
        """
        known = self.known(scene)
        if known is None:
            return None
        return known.beliefs(known.likely(start), known.goals(goal))

    def known(self, scene: Scene) -> KnownScene | None:
        """What is known of a scene; found out when it is first asked for.

        Returns:
            None where the states of the scene are unknown, or too many to tell apart.
        """
        if scene not in self._scenes:
            ground = GroundModel.of(self.model, scene.objects)
            familiar = self.acquaintance.familiar.get(scene)
            possible = (
                PossibleStates.explore(ground, familiar, self.settings.reachable)
                if familiar is not None
                else None
            )
            readings = ReadingModel.of(ground.space, self.priors, self.acquaintance.errors)
            self._scenes[scene] = (
                KnownScene(ground, possible, readings, self.settings)
                if possible is not None
                else None
            )
        return self._scenes[scene]

    @cached_property
    def _scenes(self) -> dict[Scene, KnownScene | None]:
        return {}


@dataclass(frozen=True, eq=False)
class KnownScene:
    """A scene whose states can be told apart.

    Attributes:
        ground: the model over its objects.
        possible: its states.
        readings: what readings of them are worth.
        settings: how many hypotheses are kept.
    """

    ground: GroundModel
    possible: PossibleStates
    readings: ReadingModel
    settings: HypothesesSettings

    def beliefs(self, start: Floats, goals: GoalCandidates) -> Beliefs:
        """Hypotheses.

        Args:
            start: how likely each state (states,) is the start, in nats.
            goals: what may be wanted.
        """
        return Beliefs(self.possible, self.readings, start, goals, self.settings)

    def likely(self, read: Labels) -> Floats:
        """How likely each state (states,) is seen in a picture that is read so, in nats."""
        return self.possible.nats + self.readings.log_likelihood(self.possible.labels, read)

    def goals(self, wanted: WantedReading) -> GoalCandidates:
        """The likeliest sets of states that may be wanted; one for certain if none is shown."""
        allowed = self._allowed(wanted.written)
        if wanted.read is None:
            return GoalCandidates((frozenset(allowed),), np.zeros(1))
        nats = self.likely(wanted.read)[allowed]
        best = likeliest(nats, self.settings.states)
        sets = (self._like(allowed[place], allowed, wanted.positive_only) for place in best)
        return GoalCandidates(tuple(sets), nats[best])

    def _allowed(self, written: Goal | None) -> list[int]:
        """The states in which what is written holds."""
        if written is None:
            return list(range(len(self.possible)))
        space = self.ground.space
        return [n for n, row in enumerate(self.possible.labels) if written.holds(space, row)]

    def _like(self, state: int, allowed: list[int], positive_only: bool) -> frozenset[int]:
        """The states that are as good as one that is shown."""
        if not positive_only:
            return frozenset((state,))
        labels = self.possible.labels
        holds = (labels[allowed][:, labels[state] == TRUE] == TRUE).all(axis=1)
        return frozenset(np.array(allowed)[holds].tolist())
