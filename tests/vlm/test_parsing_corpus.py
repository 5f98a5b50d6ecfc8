"""Real-looking replies, good and bad, and what must be read from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from skillwrapper.symbols import Atom
from skillwrapper.vlm.parsing import (
    ParameterNames,
    parse_labels,
    parse_plan,
    parse_predicates,
    parse_sequences,
)
from skillwrapper.world import Domain

CORPUS = Path(__file__).parent / "corpus"


def load(kind: str) -> dict[str, Any]:
    data: dict[str, Any] = yaml.safe_load((CORPUS / f"{kind}.yaml").read_text("utf-8"))
    return data


def cases(kind: str) -> list[Any]:
    return [pytest.param(case, id=case["name"]) for case in load(kind)["cases"]]


def check_complaints(case: dict[str, Any], unusable: tuple[str, ...]) -> None:
    if "unusable" in case:
        assert case["unusable"] in "\n".join(unusable)


@pytest.mark.parametrize("kind", ["labels", "sequences", "predicates", "actions"])
def test_every_corpus_has_at_least_40_different_replies(kind: str) -> None:
    assert len({case["reply"] for case in load(kind)["cases"]}) >= 40


def read_atom(text: str) -> Atom:
    name, _, rest = text.partition("(")
    return Atom(name, tuple(part.strip() for part in rest.rstrip(")").split(",")))


LABEL_ATOMS = tuple(read_atom(text) for text in load("labels")["atoms"])


@pytest.mark.parametrize("case", cases("labels"))
def test_labels(case: dict[str, Any]) -> None:
    parsed = parse_labels(case["reply"], LABEL_ATOMS)

    assert {str(atom): label for atom, label in parsed.labels.items()} == case["expect"]
    assert parsed.missing == tuple(a for a in LABEL_ATOMS if str(a) not in case["expect"])
    check_complaints(case, parsed.unusable)


@pytest.mark.parametrize("case", cases("sequences"))
def test_sequences(case: dict[str, Any], burger: Domain) -> None:
    parsed = parse_sequences(case["reply"], burger.skills, burger.objects)

    assert ["; ".join(map(str, steps)) for steps in parsed.sequences] == case["expect"]
    check_complaints(case, parsed.unusable)
    assert bool(parsed.unusable) is ("unusable" in case)


@pytest.mark.parametrize("case", cases("predicates"))
def test_predicates(case: dict[str, Any]) -> None:
    corpus = load("predicates")
    names = ParameterNames(case.get("times", corpus["times"]), corpus["aliases"])
    parsed = parse_predicates(case["reply"], names)

    assert [[p.name, list(p.types), p.semantics] for p in parsed.predicates] == case["expect"]
    check_complaints(case, parsed.unusable)


@pytest.mark.parametrize("case", cases("actions"))
def test_plans(case: dict[str, Any], burger: Domain) -> None:
    parsed = parse_plan(case["reply"], burger.skills, burger.objects)

    assert "; ".join(map(str, parsed.plan)) == case["plan"]
    assert parsed.done is case.get("done", False)
    assert parsed.impossible is case.get("impossible", False)
    check_complaints(case, parsed.unusable)
    assert bool(parsed.unusable) is ("unusable" in case)


def test_a_predicate_may_be_named_like_a_verdict() -> None:
    atoms = [Atom("holds", ("robot", item)) for item in ("lettuce", "patty")]
    reply = "**False:**\n- holds(robot, lettuce)\n\n**True:**\n- holds(robot, patty)\n"
    assert parse_labels(reply, atoms).labels == {atoms[0]: False, atoms[1]: True}
