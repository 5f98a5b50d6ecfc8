"""Parsers of model replies, one file a kind of answer. No reply whatever makes them raise."""

from skillwrapper.vlm.parsing.actions import ParsedPlan, parse_plan
from skillwrapper.vlm.parsing.labels import ParsedLabels, parse_labels
from skillwrapper.vlm.parsing.predicates import (
    ParameterNames,
    ParsedPredicates,
    parse_predicates,
    says_nothing,
)
from skillwrapper.vlm.parsing.sequences import ParsedSequences, parse_sequences

__all__ = [
    "ParameterNames",
    "ParsedLabels",
    "ParsedPlan",
    "ParsedPredicates",
    "ParsedSequences",
    "parse_labels",
    "parse_plan",
    "parse_predicates",
    "parse_sequences",
    "says_nothing",
]
