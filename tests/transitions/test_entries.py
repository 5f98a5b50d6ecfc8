"""Transitions from plain data: what the labels become, and what is refused, where and why."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from notebook import make_domain

from skillwrapper.errors import UserError
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.entries import label_entries
from skillwrapper.transitions.files import read_transitions
from skillwrapper.transitions.tables import SkillTable
from skillwrapper.world import Domain

TYPES = {"robot": (), "thing": (), "cup": ("thing",), "plate": ("thing",), "odd": ()}
OBJECTS = {"r": "robot", "a": "cup", "b": "cup", "p": "plate", "x": "odd"}
DOMAIN = make_domain(types=TYPES, objects=OBJECTS, skills={"Take": "robot thing", "Wave": ""})
HELD = Predicate("held", ("thing",), "the robot holds it")
ON = Predicate("on", ("thing", "thing"))
TAKE = {"skill": "Take", "arguments": ["r", "a"], "success": True}
DONE = {**TAKE, "before": [], "after": ["held(a)"]}


def table(*entries: dict[str, Any], domain: Domain = DOMAIN) -> SkillTable:
    (found,) = label_entries(domain, entries, (HELD, ON)).of_skill("Take")
    return found


def true_atoms(found: SkillTable, row: int = 0) -> tuple[set[str], set[str]]:
    """The true atoms and the unknown ones before a transition."""
    atoms = found.space.atoms
    before = found.before[row]
    return (
        {str(a) for a, v in zip(atoms, before, strict=True) if v == 1},
        {str(a) for a, v in zip(atoms, before, strict=True) if v == -1},
    )


def test_a_list_names_all_that_is_true() -> None:
    found = table({**DONE, "before": ["on(a, b)", "on( b,a )"]})
    assert true_atoms(found) == ({"on(a, b)", "on(b, a)"}, set())
    assert [str(literal) for literal in found.changed_literals(0)] == [
        "held(a)",
        "not on(a, b)",
        "not on(b, a)",
    ]


def test_a_map_tells_of_what_it_names_only() -> None:
    found = table({**DONE, "before": {"held(a)": False, "held(b)": 0.7, "on(a, b)": 1}})
    true, unknown = true_atoms(found)
    assert true == {"held(b)", "on(a, b)"}
    assert not unknown & {"held(a)", "held(b)", "on(a, b)"}
    assert len(unknown) == len(found.space.atoms) - 3


def test_confidences_are_those_of_the_likelier_label() -> None:
    entry = {**DONE, "before": {"held(a)": 0.7, "held(b)": 0.1, "held(p)": 0.5, "on(a, b)": None}}
    (scene,) = label_entries(DOMAIN, [entry], (HELD, ON)).scenes
    held, on = scene.labels
    assert held.values[0].tolist() == [1, 0, -1]
    assert held.confidence[0].round(6).tolist() == pytest.approx([0.7, 0.9, 1.0])
    assert on.is_certain
    assert held.decided(0.8).values[0].tolist() == [-1, 0, -1]
    assert held.decided(0.8).is_certain
    assert held.decided(0.6).values[0].tolist() == [1, 0, -1]


def test_what_did_not_change_needs_no_labels() -> None:
    known = table({**TAKE, "before": ["held(a)"], "changed": False}, DONE)
    assert known.unchanged.tolist() == [True, False]
    assert (known.before[0] == known.after[0]).all()
    still = make_domain(
        types=TYPES, objects=OBJECTS, skills={"Take": "robot thing"}, failures_change_nothing=True
    )
    failure = {**TAKE, "success": False, "before": ["held(a)"], "after": ["held(b)"]}
    assert not table(failure, domain=still).change.any()
    assert table(failure).change.any()
    assert table({**failure, "changed": True}, domain=still).change.any()


def test_objects_that_the_domain_does_not_know() -> None:
    objects = {"me": "robot", "jug": ["cup"], "a": "plate"}
    entry = {
        "skill": "Take",
        "arguments": ["me", "jug"],
        "success": True,
        "objects": objects,
        "before": ["on(jug, a)"],
        "after": ["held(jug)"],
    }
    transitions = label_entries(DOMAIN, [entry, DONE, {**DONE, "objects": ["r", "a", "p"]}])
    assert [s.executions.scene.names for s in transitions.scenes] == [
        ("me", "jug", "a"),
        ("r", "a", "b", "p", "x"),
        ("r", "a", "p"),
    ]
    assert [t.ids.tolist() for t in transitions.of_skill("Take")] == [[0], [1], [2]]


def test_a_vocabulary_is_inferred_from_what_is_seen() -> None:
    entries = [
        {**DONE, "before": ["on(a, b)", "light()"]},
        {**DONE, "before": ["on(b, p)", "held(b)"]},
    ]
    assert label_entries(DOMAIN, entries).predicates == (
        Predicate("held", ("cup",)),
        Predicate("light", ()),
        Predicate("on", ("cup", "thing")),
    )


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "skill": ({**DONE, "skill": "Tke"}, "unknown skill 'Tke'; did you mean 'Take'?"),
    "argument": ({**DONE, "arguments": ["r", "q"]}, "unknown object 'q'; known: a, b, p, r, x"),
    "types": ({**DONE, "arguments": ["a", "r"]}, "Take(a, r): expected different objects of"),
    "number": ({**DONE, "arguments": ["r"]}, "Take(r): expected different objects of the types"),
    "key": ({**DONE, "befor": []}, "unknown key 'befor'; did you mean 'before'?"),
    "missing": ({"skill": "Take", "before": []}, "expected a value for 'success', got none"),
    "after": (TAKE | {"before": []}, "expected a value for 'after', got none; it can be left out"),
    "success": ({**DONE, "success": "yes"}, "'success': expected true or false, got 'yes'"),
    "state": ({**DONE, "before": 3}, "'before': expected a list of the true atoms, or "),
    "probability": (
        {**DONE, "before": {"held(a)": 1.5}},
        "'before': expected true, false, null",
    ),
    "word": ({**DONE, "before": {"held(a)": "yes"}}, "'before': expected true, false, null"),
    "atom": ({**DONE, "before": ["held(a"]}, "expected an atom like 'holding(robot, cup)', got "),
    "terms": ({**DONE, "before": ["on(a,,b)"]}, "expected an atom like"),
    "twice": ({**DONE, "before": {"held(a)": 1, "held( a)": 0}}, "held(a) is given twice"),
    "predicate": ({**DONE, "before": ["hld(a)"]}, "unknown predicate 'hld'; did you mean 'held'?"),
    "object": ({**DONE, "before": ["held(z)"]}, "unknown object 'z'; known: a, b, p, r, x"),
    "grounding": ({**DONE, "before": ["held(r)"]}, "held(r): expected different objects of the "),
    "itself": ({**DONE, "before": ["on(a, a)"]}, "on(a, a): expected different objects of the "),
    "scene": ({**DONE, "scene": "attic"}, "unknown scene 'attic'; known: default"),
    "present": ({**DONE, "objects": ["r", "c"]}, "unknown object 'c'; known: a, b, p, r, x"),
    "absent": ({**DONE, "objects": ["r", "b"]}, "unknown object 'a'; known: b, r"),
    "type": ({**DONE, "objects": {"r": "robott", "a": "cup"}}, "unknown type 'robott'; did you"),
}
"""An entry, and what is said of it."""


@pytest.mark.parametrize("mistake", BAD)
def test_a_bad_entry_is_one_sentence_with_its_place(mistake: str, tmp_path: Path) -> None:
    entry, expected = BAD[mistake]
    with pytest.raises(UserError) as caught:
        label_entries(DOMAIN, [DONE, entry], (HELD, ON))
    assert str(caught.value).startswith(f"transition 2: {expected}")
    path = tmp_path / "moves.jsonl"
    path.write_text(f"{json.dumps(DONE)}\n\n{json.dumps(entry)}", encoding="utf-8")
    with pytest.raises(UserError) as caught:
        read_transitions(path, DOMAIN, (HELD, ON))
    assert str(caught.value).startswith(f"{path}:3: {expected}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        (["on(a, b)", "on(a)"], "expected 2 terms of on as before, got on(a)"),
        (["near(a, r)", "near(b, x)"], "no type of the domain covers what near is said of"),
        (["near(a, z)"], "unknown object 'z'"),
    ],
)
def test_what_no_vocabulary_can_be_inferred_from(before: list[str], expected: str) -> None:
    with pytest.raises(UserError) as caught:
        label_entries(DOMAIN, [{**DONE, "before": before}])
    assert str(caught.value).startswith(f"transition 1: {expected}")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (b"", ": expected a transition a line, got none"),
        (b"\n \n", ": expected a transition a line, got none"),
        (b"\xff\xfe", ": expected UTF-8 text"),
        (b"[]\n", ":1: "),
        (b"{'skill'\n", ":1: expected a line of JSON"),
    ],
)
def test_bad_files(text: bytes, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "moves.jsonl"
    path.write_bytes(text)
    with pytest.raises(UserError) as caught:
        read_transitions(path, DOMAIN)
    assert str(caught.value).startswith(f"{path}{expected}")


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(UserError, match=r"no\.jsonl: cannot be read"):
        read_transitions(tmp_path / "no.jsonl", DOMAIN)
