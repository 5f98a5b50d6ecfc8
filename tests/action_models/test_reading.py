"""Domains and traces as files: what is read, and what is said of what cannot be."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from command_line import command
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_domains import FERRY, strips_of, walk

from skillwrapper.action_models.amlgym import SkillWrapper
from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.partial_traces import Evidence
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.reading import read_steps
from skillwrapper.action_models.skeleton_files import parse_skeleton, read_skeleton
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.strips import read_strips
from skillwrapper.action_models.trace_files import parse_trace, print_trace
from skillwrapper.errors import UserError

TRACE = """(:trajectory
(:state (at b1 p) (storm))

(:action (wait))

(:state (at b1 p))

(:action (sail b1 p  home))

(:state (at b1 home))
)
"""


SKELETON = parse_skeleton(FERRY, "boats.pddl")


def _domain(tmp_path: Path) -> Path:
    path = tmp_path / "boats.pddl"
    path.write_text(FERRY)
    return path


def _complaint(read: Callable[[], object]) -> str | None:
    """What is said of something that cannot be read; None if it can."""
    try:
        read()
    except UserError as error:
        return str(error)
    return None


def _steps(evidence: Iterable[Evidence]) -> list[Step]:
    """What should be steps with complete states."""
    steps = list(evidence)
    assert all(isinstance(step, Step) for step in steps)
    return [step for step in steps if isinstance(step, Step)]


def _as_json(step: Step) -> str:
    def atoms(state: frozenset[str]) -> list[str]:
        return [f"{a.split()[0]}({', '.join(a.split()[1:])})" for a in sorted(state)]

    line = {"skill": step.action, "arguments": list(step.arguments), "success": step.success}
    return json.dumps({**line, "before": atoms(step.before), "after": atoms(step.after)})


def test_the_formats_say_the_same(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    steps = list(walk(true, 30, seed=4, failures=False))
    (tmp_path / "walk").write_text(print_trace(steps).upper())
    (tmp_path / "walk.jsonl").write_text("\n".join(map(_as_json, steps)))
    plain = [(s.action, s.arguments, s.before, s.after) for s in steps]
    for name in ("walk", "walk.jsonl"):
        found = _steps(read_steps([tmp_path / name], true.skeleton))
        assert [(s.action, s.arguments, s.before, s.after) for s in found] == plain


def test_other_ways_to_write_a_trace() -> None:
    usual = _steps(parse_trace(TRACE, "t", SKELETON))
    other = TRACE.replace("(:trajectory", "(trajectory (:objects b1 - boat)")
    other = other.replace("(:state (at b1 p) (storm))", "(:init (and (at b1 p) (storm)))")
    other = other.replace("(:action (wait))", "(operator: (wait)) ; calm").replace(
        "(:state (at b1 home))", "(:state (at b1 home) (not (at b1 p)))"
    )
    found = _steps(parse_trace(other, "t", SKELETON))
    assert [(s.action, s.before, s.after) for s in found] == [
        (s.action, s.before, s.after) for s in usual
    ]


def test_numbers_are_read_over_and_their_functions_kept() -> None:
    domain = FERRY.replace(
        "(:action sail", "(:functions (cost) - number (fuel ?b - boat))\n(:action sail"
    )
    skeleton = parse_skeleton(domain, "boats.pddl")
    counted = TRACE.replace(
        "(:state (at b1 home))", "(:state (= (cost) 3) (at b1 home) (= (fuel b1) 0.5))"
    )
    steps = _steps(parse_trace(counted, "t", skeleton))
    assert steps[-1].after == {"at b1 home"}
    printed = print_model(learn_action_models(skeleton, steps))
    assert "(cost) - number (fuel ?b - boat)" in printed
    assert parse_skeleton(printed, "printed").functions == skeleton.functions


def test_what_leaves_the_state_as_it_was_failed_if_it_is_said_so() -> None:
    trace = TRACE.replace("(:state (at b1 home))", "(:state (at b1 p))")
    assert [s.success for s in _steps(parse_trace(trace, "t", SKELETON))] == [True, True]
    marked = _steps(parse_trace(trace, "t", SKELETON, failures=True))
    assert [s.success for s in marked] == [True, False]


@pytest.mark.parametrize(
    ("old", "new", "where", "said"),
    [
        ("(at b1 p) (storm)", "(at b1 p) (strom)", "t:2", "predicate 'strom'"),
        ("(at b1 p) (storm)", "(at b1) (storm)", "t:2", "expected 2 terms of 'at', got 1"),
        ("(wait)", "(wiat)", "t:4", "action 'wiat'"),
        ("sail b1 p  home", "sail b1 p", "t:8", "expected 3 arguments of 'sail', got 2"),
        ("(:state (at b1 p) (storm))", "", "t:4", "expected a state before the first action"),
        ("(:state (at b1 home))\n", "", "t", "expected a state after the last action"),
        ("(:action (wait))", "", "t:6", "expected an action between two states"),
        ("(at b1 home))\n)", "(at b1 home)", "t:10", "expected 2 ')'"),
        ("(:trajectory", "trajectory", "t:1", "expected a trace"),
        ("(sail b1 p  home)", "(sail ?b p home)", "t:8", "name of an object, got '?b'"),
        ("(:state (at b1 home))", "(:state (at ?b home))", "t:10", "got 'at ?b home'"),
    ],
)
def test_a_broken_trace(old: str, new: str, where: str, said: str) -> None:
    assert old in TRACE
    with pytest.raises(UserError) as caught:
        list(parse_trace(TRACE.replace(old, new), "t", SKELETON))
    assert where in str(caught.value)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"arguments": ["b1", "p q", "home"]}, "name of an object, got 'p q'"),
        ({"arguments": ["", "p", "home"]}, "name of an object, got ''"),
        ({"before": ["at(b1 p)"]}, "name of an object, got 'b1 p'"),
        ({"before": ["at(b1)"]}, "expected 2 terms of 'at', got 1"),
        ({"before": ["at(b1, p"]}, "at(b1, p"),
        ({"skill": "fly"}, "action 'fly'"),
        ({"after": None}, "expected a value for 'after'"),
        ({"succes": True}, "unknown key 'succes'"),
    ],
)
def test_a_broken_line(change: dict[str, object], said: str, tmp_path: Path) -> None:
    line = {"skill": "sail", "arguments": ["b1", "p", "home"], "success": True}
    good = {**line, "before": ["at(b1, p)"], "after": ["at(b1, home)"]}
    path = tmp_path / "t.jsonl"
    path.write_text(f"{json.dumps(good)}\n\n{json.dumps({**good, **change})}\n")
    said_of_it = _complaint(lambda: list(read_steps([path], SKELETON)))
    assert said_of_it is not None
    assert "t.jsonl:3" in said_of_it
    assert said in said_of_it


@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_no_damage_to_a_line_ends_in_a_traceback(
    data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    text = _as_json(Step("sail", ("b1", "p", "home"), True, frozenset({"at b1 p"}), frozenset()))
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text) - 1))
        text = text[:at] + data.draw(st.sampled_from('"[]{}(),:a1?\\ ')) + text[at + 1 :]
    path = tmp_path_factory.getbasetemp() / "damaged.jsonl"
    path.write_text(text)
    said = _complaint(lambda: list(read_steps([path], SKELETON)))
    assert said is None or "damaged.jsonl:1" in said


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("(:types boat car", "(:types boat car (", "never closed"),
        ("?c - car ?b - boat) (full", "?c - cart ?b - boat) (full", "type 'cart'"),
        ("boat car - movable movable", "boat car - movable movable - boat", "cycle"),
        ("(storm))\n", "(storm) (storm))\n", "declared twice"),
        ("?b - boat ?from ?to - harbour", "?b - boat ?from ?from - harbour", "same name"),
        ("(define (domain boats)", "(define (problem boats)", "(domain NAME)"),
    ],
)
def test_a_broken_domain(old: str, new: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "broken.pddl"
    assert old in FERRY
    path.write_text(FERRY.replace(old, new, 1))
    with pytest.raises(UserError, match=r"broken\.pddl") as caught:
        read_skeleton(path)
    assert said in str(caught.value)


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_no_damage_to_a_trace_ends_in_a_traceback(data: st.DataObject) -> None:
    text = TRACE
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text) - 1))
        text = text[:at] + data.draw(st.sampled_from("() \nab?;:-")) + text[at + 1 :]
    said = _complaint(lambda: list(parse_trace(text, "t", SKELETON)))
    assert said is None or said.startswith("t:")


@settings(max_examples=150, deadline=None)
@given(st.data())
def test_no_damage_to_a_domain_ends_in_a_traceback(data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(FERRY) - 1))
    text = FERRY[:at] + data.draw(st.sampled_from("() -?;:")) + FERRY[at + 1 :]
    said = _complaint(lambda: parse_skeleton(text, "damaged.pddl"))
    assert said is None or "damaged.pddl" in said


def test_as_an_algorithm_of_amlgym(tmp_path: Path) -> None:
    (tmp_path / "0_traj").write_text(TRACE)
    learned = SkillWrapper().learn(str(_domain(tmp_path)), [str(tmp_path / "0_traj")])
    assert ":precondition (and (storm))" in learned
    assert "(:action board" not in learned


@pytest.mark.filterwarnings("ignore")  # of its parser
def test_beside_amlgyms_own_algorithms(tmp_path: Path) -> None:
    pytest.importorskip("amlgym")
    from amlgym.metrics import syntactic_precision, syntactic_recall  # noqa: PLC0415

    domain = _domain(tmp_path)
    true = read_strips(domain)
    (tmp_path / "0_traj").write_text(print_trace(list(walk(true, 300, seed=1, failures=False))))
    learned = tmp_path / "learned.pddl"
    learned.write_text(SkillWrapper().learn(str(domain), [str(tmp_path / "0_traj")]))
    assert syntactic_recall(str(learned), str(domain))["mean"] == 1.0
    assert syntactic_precision(str(learned), str(domain))["mean"] > 0.5


def test_files_without_a_transition(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "walk").write_text("(:trajectory (:state (storm)))")
    given = ("learn-operators", tmp_path / "walk", "--domain", _domain(tmp_path))
    assert command(*given, "--out", tmp_path / "out") != 0
    assert "expected at least one action between two states" in capsys.readouterr().err


def test_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "walk").write_text(TRACE)
    given = ("learn-operators", tmp_path / "walk", "--domain", _domain(tmp_path))
    assert command(*given, "--out", tmp_path / "out") == 0
    said = capsys.readouterr().out
    assert "wait: 1 transitions, 1 preconditions, 1 effects" in said
    assert "board: never seen to work, left out" in said
    learned = read_strips(tmp_path / "out" / "domain.pddl")
    assert sorted(learned.actions) == ["sail", "wait"]
    figures = json.loads((tmp_path / "out" / "action_models.json").read_text())
    assert figures["actions"]["wait"]["effects"] == [{"change": "(not (storm))", "when": []}]
