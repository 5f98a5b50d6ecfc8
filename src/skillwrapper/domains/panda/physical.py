"""The table as an environment whose arm is moved by forces: things can go wrong."""

from __future__ import annotations

from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.states import PandaState
from skillwrapper.domains.panda.table import PandaTable
from skillwrapper.domains.tabletop.environment import PhysicalArms


class PhysicalPandaEnvironment(PhysicalArms[PandaState, PandaTable], PandaEnvironment):
    """A Panda at a table, with servos, contacts and gravity."""
