"""The table as an environment whose arm is moved by forces: things can go wrong."""

from __future__ import annotations

from functools import cached_property
from typing import Final

from skillwrapper.domains.panda.cameras import FRONT
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.states import PICKUPABLE, PandaState
from skillwrapper.domains.panda.table import ARM, PandaTable, Setting
from skillwrapper.domains.tabletop.motion import MotionFailed
from skillwrapper.domains.tabletop.physics import NO_TROUBLES, PhysicsMotion, Troubles
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Outcome
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.skills import SkillInstance

_PUT_BACK: Final = 0.06
"""A thing that was pushed no farther than this may stay there, in metres."""


class PhysicalPandaEnvironment(PandaEnvironment):
    """A Panda at a table, with servos, contacts and gravity.

    The abstract state is judged by where things are, so a skill that was allowed by the rules
    fails if it does not bring what it should. The seed of ``reset`` also decides what goes wrong;
    the same seed and skills bring the same abstract states.

    Args:
        troubles: what goes wrong.
        setting: what the things look like, and the light.
        camera: where it is seen from.
        domain: of ``domain.yaml``; None to read it.
    """

    def __init__(
        self,
        troubles: Troubles = NO_TROUBLES,
        setting: Setting | None = None,
        camera: str = FRONT,
        *,
        domain: Domain | None = None,
    ) -> None:
        super().__init__(setting, camera, domain=domain)
        self._troubles = troubles

    def set_state(self, state: PandaState, *, seed: int | None = None) -> Observation:
        """Set the table up anew, everything at rest; a seed also chooses the layout.

        Raises:
            RobotError: before the first reset, if no seed is given.
        """
        layout = self._layout if seed is None else seed
        if layout is not None:
            self._table.arrange(state, self._places(layout))
            self._motion.restart(layout)
        return super().set_state(state, seed=seed)

    def execute(self, instance: SkillInstance) -> Outcome:
        """Run a skill instance; what became of the table is judged afterwards.

        Raises:
            RobotError: before the first reset.
            UnknownNameError: if there is no such skill, or no such object in the scene.
            ConfigurationError: if the arguments do not fit the skill.
            MissingDependencyError: without MuJoCo, or the models of the arms.
        """
        before = self._started()
        self.domain.check_instance(instance, self.scene)
        reason = self.obstacle(before, instance)
        if reason is not None:
            return Outcome(False, self.observe(), reason, changed=False)
        try:
            self._skills.run(instance)
        except MotionFailed as failed:
            reason = str(failed)
            self._motion.retreat(ARM)
        after = self._state = self._table.state()
        reason = reason or self._mishap(before, after, instance)
        return Outcome(reason is None, self.observe(), reason or "", changed=before != after)

    def draw(self, state: PandaState, layout: int) -> Picture:
        """The table as it is now."""
        return self._photo()

    @cached_property
    def _motion(self) -> PhysicsMotion:
        return PhysicsMotion(self._table.world, self._troubles)

    def _mishap(self, before: PandaState, after: PandaState, instance: SkillInstance) -> str | None:
        """What is not as the skill should have left it."""
        if after != self.effect(before, instance):
            return f"after {instance} the table is not as it should be"
        return _displaced(self._table)


def _displaced(table: PandaTable) -> str | None:
    """A thing that neither is held nor on the plate and is not where it belongs."""
    for thing in PICKUPABLE:
        loose = thing in table.layout and table.world.holder(thing) is None
        if loose and not table.is_stacked(thing) and not table.is_in_place(thing, _PUT_BACK):
            return f"the {thing} is not where it belongs"
    return None
