"""Real-looking replies, good and bad, and what must be read from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from skillwrapper.symbols import Atom, Predicate
from skillwrapper.vlm.parsing import (
    ParameterNames,
    parse_labels,
    parse_plan,
    parse_predicates,
    parse_sequences,
)
from skillwrapper.world import Domain
from skillwrapper.world.skills import Skill

CORPUS = Path(__file__).parent / "corpus"


def load(kind: str) -> dict[str, Any]:
    data: dict[str, Any] = yaml.load((CORPUS / f"{kind}.yaml").read_text("utf-8"), yaml.CSafeLoader)
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


OPENING = (Skill("OpenGripper", ()), Skill("CloseGripper", ()))
"""Skills without arguments."""
STEPS = "OpenGripper(); Pick(robot, patty)"


@pytest.mark.parametrize(
    "reply",
    [
        "1. OpenGripper\n2. Pick(robot, patty)",
        "- Open gripper\n- Pick(robot, patty)",
        "OpenGripper()\nPick(robot, patty)",
        "**OpenGripper**\n**Pick(robot, patty)**",
        "Step 1: OpenGripper\nStep 2: Pick(robot, patty)",
        "Sequence 1: OpenGripper, Pick(robot, patty)",
        "Sequence 1:\nOpenGripper\nPick(robot, patty)",
        "OpenGripper -> Pick(robot, patty)",
        "(open-gripper)\n(pick robot patty)",
        '["OpenGripper", "Pick(robot, patty)"]',
        '[{"skill": "OpenGripper", "arguments": []}, {"Pick": ["robot", "patty"]}]',
        '[{"name": "OpenGripper"}, {"name": "Pick", "args": {"a": "robot", "b": "patty"}}]',
        "| Skill | Arguments |\n|---|---|\n| OpenGripper | - |\n| Pick | robot, patty |",
        "- skill: OpenGripper\n- skill: Pick\n  args: [robot, patty]",
        "OpenGripper\nPick(robot:robot, patty:cookable)",
        "OpenGripper\nPick(robot - robot, patty - cookable)",
        "OpenGripper\nPick(robot - robot patty - cookable)",
        "OpenGripper\nPick(robot::robot patty::cookable)",
        "OpenGripper\nPick[robot, patty]",
        "OpenGripper\nPick(?robot, $patty)",
        "OpenGripper\nPick(the robot, patty (raw, pink))",
    ],
)
def test_skills_in_forms_that_were_lost(reply: str, burger: Domain) -> None:
    parsed = parse_sequences(reply, (*burger.skills, *OPENING), burger.objects)
    assert ["; ".join(map(str, steps)) for steps in parsed.sequences] == [STEPS]
    plan = parse_plan(
        reply.partition(":")[2] if "Sequence" in reply else reply,
        (*burger.skills, *OPENING),
        burger.objects,
    )
    assert "; ".join(map(str, plan.plan)) == STEPS


def test_a_skill_named_in_prose_is_no_step(burger: Domain) -> None:
    reply = (
        "First we pick, place and cook.\n\n## Pick\nPick(robot, patty)\nClose gripper, then stop."
    )
    parsed = parse_sequences(reply, (*burger.skills, *OPENING), burger.objects)
    assert ["; ".join(map(str, s)) for s in parsed.sequences] == [
        "Pick(robot, patty); CloseGripper()"
    ]


@pytest.mark.parametrize(
    "reply",
    [
        "holding(?robot - robot ?item - pickupable): it is held",
        "holding(?robot - robot, ?item - pickupable): it is held",
        "holding(?robot:robot ?item:pickupable): it is held",
        "holding(robot: robot, item: pickupable) - it is held",
        "holding(robot r, pickupable i): it is held",
        "(holding ?r - robot ?i - pickupable): it is held",
        "holding[robot, pickupable]: it is held",
        "holding(?robot, ?pickupable)\nit is held",
        "holding(?robot, ?pickupable):\n  it is held",
        "**holding(?robot, ?pickupable)**\n\n- it is held",
        "holding(?robot, ?pickupable) —\nit is held",
        "holding(?robot, ?pickupable)\nMeaning:\nit is held",
        "Name: holding\nParameters: ?robot, ?pickupable\nSemantics: it is held",
        "« holding(?robot, ?pickupable) » : it is held",
        "holding\uff08?robot\u3001?pickupable\uff09\uff1ait is held",
        '{"name": "holding", "parameters": ["robot", "pickupable"], "semantics": "it is held"}',
        '{"name": "holding", "params": {"r": "robot", "i": "pickupable"}, "meaning": "it is held"}',
        '{"predicate": "holding", "args": "?robot, ?pickupable", "explanation": "it is held"}',
        '{"holding(?robot, ?pickupable)": {"definition": "it is held"}}',
        '{"holding": {"parameters": ["robot", "pickupable"], "description": "it is held"}}',
        '{"name": "holding", "parameters": [{"name": "r", "type": "robot"}, '
        '{"name": "i", "type": "pickupable"}], "semantics": "it is held"}',
        "holding(?robot, ?pickupable): \x1b[1mit is\x1b[0m held",
        r'{"holding(?robot, ?pickupable)": "\u001b[1mit is\u001b[0m held"}',
    ],
)
def test_predicates_in_forms_that_were_lost(reply: str) -> None:
    names = ParameterNames({"robot": 1, "pickupable": 2})
    parsed = parse_predicates(reply, names)
    assert parsed.predicates == (Predicate("holding", ("robot", "pickupable"), "it is held"),)


FAMILIES = CORPUS / "families"
SHORT = {
    "he": "hand_empty(robot)",
    "hl": "holding(robot, lettuce)",
    "hp": "holding(robot, patty)",
    "lp": "on_top_of(lettuce, patty)",
    "pl": "on_top_of(patty, lettuce)",
    "ps": "on_station(patty, stove)",
    "pb": "on_station(patty, board)",
    "cut": "is_cut(lettuce)",
}
SIGNS = {"+": True, "-": False, "?": None}


def family_cases(*kinds: str) -> list[Any]:
    """The replies in the manners of families of models, all written by us."""
    return [
        pytest.param(case, id=f"{family['family']}, {kind} {number}")
        for file in sorted(FAMILIES.glob("*.yaml"))
        for family in yaml.load(file.read_text("utf-8"), yaml.CSafeLoader)
        for kind in kinds
        for number, case in enumerate(family.get(kind, ()), start=1)
    ]


def test_the_families_are_many_and_their_replies_differ() -> None:
    replies = family_cases("labels", "predicates", "sequences", "actions")
    families = {str(case.id).partition(",")[0] for case in replies}
    assert len({case.values[0]["reply"] for case in replies}) >= 150
    assert len(families) >= 10


@pytest.mark.parametrize("case", family_cases("labels"))
def test_labels_of_families(case: dict[str, Any]) -> None:
    expected = {SHORT[word[:-1]]: SIGNS[word[-1]] for word in case["expect"].split()}
    parsed = parse_labels(case["reply"], LABEL_ATOMS)
    assert {str(atom): label for atom, label in parsed.labels.items()} == expected


@pytest.mark.parametrize("case", family_cases("predicates"))
def test_predicates_of_families(case: dict[str, Any]) -> None:
    corpus = load("predicates")
    parsed = parse_predicates(case["reply"], ParameterNames(corpus["times"], corpus["aliases"]))
    assert [[p.name, list(p.types), p.semantics] for p in parsed.predicates] == case["expect"]


@pytest.mark.parametrize("case", family_cases("sequences"))
def test_sequences_of_families(case: dict[str, Any], burger: Domain) -> None:
    parsed = parse_sequences(case["reply"], burger.skills, burger.objects)
    assert ["; ".join(map(str, steps)) for steps in parsed.sequences] == case["expect"]


@pytest.mark.parametrize("case", family_cases("actions"))
def test_plans_of_families(case: dict[str, Any], burger: Domain) -> None:
    parsed = parse_plan(case["reply"], burger.skills, burger.objects)
    assert "; ".join(map(str, parsed.plan)) == case.get("plan", "")
    assert parsed.done is case.get("done", False)
    assert parsed.impossible is case.get("impossible", False)
