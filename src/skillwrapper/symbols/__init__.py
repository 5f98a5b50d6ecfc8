"""Symbols: predicates, atoms, operators, the abstract model."""

from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.operators import Absence, ConditionalEffect, Operator, Variable
from skillwrapper.symbols.predicates import Atom, Literal, Predicate, all_groundings

__all__ = [
    "Absence",
    "AbstractModel",
    "Atom",
    "ConditionalEffect",
    "Literal",
    "Operator",
    "Predicate",
    "Variable",
    "all_groundings",
]
