"""Symbols: predicates, atoms, abstract states, operators, the abstract model."""

from skillwrapper.symbols.ground import (
    FALSE,
    TRUE,
    UNKNOWN,
    AtomSpace,
    GroundModel,
    GroundOperator,
    Labels,
    ground_operator,
)
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, ConditionalEffect, Operator, Variable
from skillwrapper.symbols.predicates import Atom, Literal, Predicate, all_groundings

__all__ = [
    "FALSE",
    "TRUE",
    "UNKNOWN",
    "Absence",
    "AbstractModel",
    "Atom",
    "AtomSpace",
    "ConditionalEffect",
    "GroundModel",
    "GroundOperator",
    "Labels",
    "Literal",
    "Operator",
    "Predicate",
    "Variable",
    "all_groundings",
    "ground_operator",
]
