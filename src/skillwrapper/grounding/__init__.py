"""The engine where operators meet states: binding, applying, simulating, searching."""

from skillwrapper.grounding.atom_space import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.grounding.ground_operators import GroundOperator
from skillwrapper.grounding.models import GroundModel

__all__ = ["FALSE", "TRUE", "UNKNOWN", "AtomSpace", "GroundModel", "GroundOperator", "Labels"]
