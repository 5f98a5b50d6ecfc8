"""Proposals follow names, hints and chance; what was learned so far is not read."""

from __future__ import annotations

import ast
from collections import Counter
from itertools import pairwise
from pathlib import Path

import pytest

from skillwrapper import embedded
from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.prompt_text import PromptText
from skillwrapper.embedded.proposing import propose_sequences

PROMPT = """
Plan {count} different sequences.

## Skills
- Open(hand, door)
  - hand (hand): the hand
  - door (door): the door to open
- Knock(hand, door)
  - hand (hand): the hand
  - door (door): the door to knock at

## Objects
- hand (hand)
- front (door)
- back (door)

## What is known of the skills
{known}

## Least explored pairs
{pairs}

## Skills that seldom worked so far
{seldom}

## Rules
- Every sequence has at least {length} skills.
"""


def propose(
    known: str = "(none)", pairs: str = "(none)", seldom: str = "(none)", seed: int = 0
) -> list[list[str]]:
    text = PROMPT.format(count=8, length=12, known=known, pairs=pairs, seldom=seldom)
    blocks = propose_sequences(PromptText.of(text), Chance(seed)).split("\n\n")
    return [block.split("\n")[1:] for block in blocks]


def test_as_many_and_as_long_as_wanted_and_never_the_same_twice_in_a_row() -> None:
    sequences = propose()
    assert [len(sequence) for sequence in sequences] == [12] * 8
    steps = {step for sequence in sequences for step in sequence}
    assert steps == {f"{skill}(hand, {door})" for skill in ("Open", "Knock") for door in
                     ("front", "back")}  # fmt: skip
    assert not any(a == b for sequence in sequences for a, b in pairwise(sequence))


def test_what_was_learned_so_far_makes_no_difference() -> None:
    known = (
        "- Open_1: Open(?hand: hand, ?door: door)\n"
        "  needs not locked(?door)\n  may need closed(?door)\n  makes true open(?door)"
    )
    assert propose(known) == propose()


@pytest.mark.parametrize("seed", range(5))
def test_a_least_explored_pair_is_in_every_sequence(seed: int) -> None:
    pair = ("Open(hand, front)", "Knock(hand, back)")
    for sequence in propose(pairs=f"- {pair[0]}, then {pair[1]}", seed=seed):
        assert pair in set(pairwise(sequence))


def test_skills_that_seldom_worked_are_tried_more_often() -> None:
    def share(seldom: str) -> float:
        sequences = [s for seed in range(10) for s in propose(seldom=seldom, seed=seed)]
        skills = Counter(step.partition("(")[0] for sequence in sequences for step in sequence)
        return skills["Open"] / skills.total()

    assert share("(none)") == pytest.approx(0.5, abs=0.05)
    assert share("- Open") > 0.6


def test_the_room_knows_no_operators_no_planner_and_no_domain() -> None:
    forbidden = ("domains", "planning", "exploration", "learning", "grounding", "transitions")
    for file in Path(embedded.__file__).parent.glob("*.py"):
        tree = ast.parse(file.read_text(encoding="utf-8"))
        imported = [
            node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)
        ]
        assert not [m for m in imported for f in forbidden if m.startswith(f"skillwrapper.{f}")]
        assert "skillwrapper.symbols.operators" not in imported
