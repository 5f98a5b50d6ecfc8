"""The table as an environment whose arm is moved by forces: things can go wrong."""

from __future__ import annotations

from skillwrapper.domains.panda.cameras import FRONT
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.states import PandaState
from skillwrapper.domains.panda.table import PandaTable, Setting
from skillwrapper.domains.tabletop.environment import PhysicalArms
from skillwrapper.domains.tabletop.physics import NO_TROUBLES, Troubles
from skillwrapper.world.domain import Domain


class PhysicalPandaEnvironment(PhysicalArms[PandaState, PandaTable], PandaEnvironment):
    """A Panda at a table, with servos, contacts and gravity.

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
        super(PhysicalArms, self).__init__(setting, camera, domain=domain)
        self.troubles = troubles
