"""No reply whatever makes a parser raise, and none takes long."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skillwrapper.symbols import Atom, Predicate, all_groundings
from skillwrapper.vlm.parsing import (
    ParameterNames,
    parse_labels,
    parse_plan,
    parse_predicates,
    parse_sequences,
)
from skillwrapper.world import Domain

PIECES = st.sampled_from(
    [
        "holding(robot, patty)", "Pick(robot, patty)", "pick", "(", ")", "[", "]", "{", "}", ":",
        "true", "false", "unsure", "not ", "\n", "\n\n", "```", "```json\n", "- ", "1. ", "|", "**",
        "Sequence 1:", "<think>", "</think>", '"', ",", "?", "\\n", "name", "semantics", "Done",
        "Impossible", "—", "✅", "\uff08", "patty", "is_cut(lettuce)", "\u0000", "\ud7ff", "9" * 50,
    ]
)  # fmt: skip
REPLIES = st.one_of(st.text(max_size=300), st.lists(PIECES, max_size=60).map("".join))
NAMES = ParameterNames({"robot": 1, "pickupable": 2}, {"item": "pickupable", "patty": "pickupable"})


def atoms_of(domain: Domain) -> tuple[Atom, ...]:
    vocabulary = [
        Predicate("holding", ("robot", "pickupable")),
        Predicate("on_top_of", ("pickupable", "pickupable")),
        Predicate("is_cut", ("cuttable",)),
    ]
    return all_groundings(vocabulary, domain.objects)


def parse_all(reply: str, domain: Domain) -> None:
    atoms = atoms_of(domain)
    labels = parse_labels(reply, atoms)
    assert set(labels.labels) | set(labels.missing) == set(atoms)
    assert all(parse_sequences(reply, domain.skills, domain.objects).sequences)
    plan = parse_plan(reply, domain.skills, domain.objects)
    assert not (plan.plan and (plan.done or plan.impossible))
    for predicate in parse_predicates(reply, NAMES).predicates:
        assert predicate.arity <= 2
        assert predicate.semantics


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(reply=REPLIES)
def test_no_reply_raises(reply: str, burger: Domain) -> None:
    parse_all(reply, burger)


@pytest.mark.parametrize(
    "reply",
    [
        "(" * 30_000,
        "a(" * 30_000,
        "a" * 60_000,
        "[" * 30_000 + "]" * 30_000,
        "Pick(robot, " * 10_000,
        "\n" * 60_000,
        "- " * 30_000,
        "<think>" * 10_000,
        "not " * 20_000 + "holding(robot, patty)",
        "(a " * 20_000,
        " ".join(f"word{n}(thing{n})" for n in range(3_000)),
        "holding(robot, patty): true\n" * 3_000,
        '{"a":' * 20_000,
        "a b c d e f " * 10_000 + "(",
    ],
    ids=lambda reply: reply[:12],
)
def test_hostile_replies_come_to_an_end(reply: str, burger: Domain) -> None:
    parse_all(reply, burger)  # one that makes a pattern backtrack would not come back
