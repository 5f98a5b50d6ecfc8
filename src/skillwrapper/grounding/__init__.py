"""The engine where operators meet states: ground atoms, binding, applying, simulating."""

from skillwrapper.grounding.ground import (
    FALSE,
    TRUE,
    UNKNOWN,
    AtomSpace,
    GroundModel,
    GroundOperator,
    Labels,
    ground_operator,
)

__all__ = [
    "FALSE",
    "TRUE",
    "UNKNOWN",
    "AtomSpace",
    "GroundModel",
    "GroundOperator",
    "Labels",
    "ground_operator",
]
