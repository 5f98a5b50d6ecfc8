"""The two arms as an environment, moved by forces: things can go wrong."""

from __future__ import annotations

from skillwrapper.domains.kuka.cameras import EGO
from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.states import KukaState
from skillwrapper.domains.kuka.table import KukaTable, Setting
from skillwrapper.domains.tabletop.environment import PhysicalArms
from skillwrapper.domains.tabletop.physics import NO_TROUBLES, Troubles
from skillwrapper.world.domain import Domain


class PhysicalKukaEnvironment(PhysicalArms[KukaState, KukaTable], KukaEnvironment):
    """Two iiwa arms at a table, with servos, contacts and gravity.

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
        camera: str = EGO,
        *,
        domain: Domain | None = None,
    ) -> None:
        super(PhysicalArms, self).__init__(setting, camera, domain=domain)
        self.troubles = troubles
