"""The two arms as an environment, moved by forces: things can go wrong."""

from __future__ import annotations

from skillwrapper.domains.kuka.environment import KukaEnvironment
from skillwrapper.domains.kuka.states import KukaState
from skillwrapper.domains.kuka.table import KukaTable
from skillwrapper.domains.tabletop.environment import PhysicalArms


class PhysicalKukaEnvironment(PhysicalArms[KukaState, KukaTable], KukaEnvironment):
    """Two iiwa arms at a table, with servos, contacts and gravity."""
