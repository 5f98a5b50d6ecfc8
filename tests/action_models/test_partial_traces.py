"""Plans, and traces of which not every state is known: nothing is guessed, much follows."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import pytest
from command_line import command
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from planning_domains import FERRY, LAMPS, LOCKS, OBJECTS, STARTS, strips_of, walk
from random_planning_domains import OBJECTS as RANDOM_OBJECTS
from random_planning_domains import World, worlds

from skillwrapper.action_models.learner import learn_action_models
from skillwrapper.action_models.models import DomainModel
from skillwrapper.action_models.partial_traces import (
    UNKNOWN,
    Attempt,
    Evidence,
    PartialState,
    PartialTrace,
    TraceBuilder,
)
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.reading import read_steps
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton_files import parse_skeleton
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.strips import Strips, parse_strips
from skillwrapper.action_models.trace_files import parse_trace
from skillwrapper.errors import UserError

SKELETON = parse_skeleton(FERRY, "boats.pddl")

PROBLEM = """(define (problem calm) (:domain boats) (:objects b1 - boat c1 - car p - harbour)
(:init (at b1 p) (at c1 p) (= (cost) 3))
(:goal (and (at c1 q) (not (aboard c1 b1)) (or (storm) (full b1)))))
"""

PLAN = """; found in 3 s
0.000: (board c1 b1 p) [1.000]
1.000: (Sail b1 p q)
(land c1 b1 q)
"""


def _thinned(steps: Sequence[Step], every: int) -> Iterator[Evidence]:
    """Steps of one walk, with only the first state, every so many, and the last."""
    builder = TraceBuilder()
    builder.state(PartialState(steps[0].before, None))
    for number, step in enumerate(steps, 1):
        builder.attempt(Attempt(step.action, step.arguments))
        if number % every == 0 or number == len(steps):
            yield from builder.state(PartialState(step.after, None))


def _learned(model: DomainModel) -> Strips:
    return parse_strips(print_model(model), "learned.pddl")


def _sound(learned: Strips, true: Strips, states: Iterable[frozenset[str]]) -> None:
    """What is said to apply in some states does."""
    objects = OBJECTS[true.skeleton.name]
    for state in states:
        assert set(learned.applicable(state, objects)) <= set(true.applicable(state, objects))


def test_of_what_no_state_shows_nothing_is_said() -> None:
    attempts = (Attempt("board", ("c1", "b1", "p")), Attempt("sail", ("b1", "p", "q")))
    start = PartialState(frozenset({"at b1 p", "at c1 p"}), None)
    end = PartialState(frozenset({"at b1 q"}))
    model = learn_action_models(SKELETON, [PartialTrace(attempts, (start, UNKNOWN, end))])
    sail = model.actions["sail"]
    assert "(full ?b)" in map(str, sail.unseen)
    assert not {"(full ?b)", "(not (full ?b))"} & {str(c) for c in sail.preconditions}
    assert "(not (at ?b ?to))" in map(str, sail.preconditions)
    cautious = ActionModelSettings(cautious=True)
    trace = PartialTrace(attempts, (start, UNKNOWN, end))
    wary = learn_action_models(SKELETON, [trace], cautious).actions["sail"]
    assert "(full ?b)" in map(str, wary.preconditions)
    assert [str(e.change) for e in sail.effects] == ["(at ?b ?to)"]


@pytest.mark.parametrize("text", [FERRY, LOCKS], ids=["boats", "locks"])
@pytest.mark.parametrize("every", [2, 5])
def test_what_is_between_is_filled_in(text: str, every: int, tmp_path: Path) -> None:
    true = strips_of(text, tmp_path)
    steps = list(walk(true, 600, seed=1, failures=False))
    model = learn_action_models(true.skeleton, _thinned(steps, every))
    learned = _learned(model)
    assert print_model(model) == print_model(learn_action_models(true.skeleton, steps))
    _sound(learned, true, {step.before for step in steps})


def test_what_is_decided_in_the_end_is_not_said_to_be_open(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    steps = list(walk(true, 300, seed=1, failures=False))
    model = learn_action_models(true.skeleton, _thinned(steps, 3))
    assert not any(action.undecided for action in model.actions.values())


def test_from_first_and_last_states_nothing_wrong_is_learned(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    steps = list(walk(true, 60, seed=3, failures=False))
    short = [x for at in range(0, 60, 15) for x in _thinned(steps[at : at + 15], 15)]
    model = learn_action_models(true.skeleton, short)
    assert any(action.undecided for action in model.actions.values())
    learned = _learned(model)
    assert set(model.actions) > {n for n, action in model.actions.items() if action.unseen} > set()
    clear = {n: a for n, a in learned.actions.items() if not model.actions[n].unseen}
    _sound(Strips(learned.skeleton, clear), true, {step.before for step in steps})
    for name, action in learned.actions.items():
        assert set(action.effects) <= set(true.actions[name].effects)


def test_an_effect_that_comes_and_goes_fills_in_nothing(tmp_path: Path) -> None:
    true = strips_of(LAMPS, tmp_path)
    steps = list(walk(true, 200, seed=2, failures=False))
    model = learn_action_models(true.skeleton, [*steps, *_thinned(steps, 4)])
    whole = learn_action_models(true.skeleton, steps)
    assert model.actions["flip"].effects == whole.actions["flip"].effects
    assert "(lit ?l)" in map(str, model.actions["flip"].undecided)


@settings(max_examples=150, deadline=None)
@given(worlds(), st.data())
def test_random_domains_without_conditions(world: World, data: st.DataObject) -> None:
    act = world.true.actions["act"]
    assume(act.effects and not any(when for when, _ in act.effects))
    steps = [s for s in world.steps(world.states) if s.success]
    assume(steps)
    traces = [_hidden(step, data) for step in data.draw(st.lists(st.sampled_from(steps)))]
    everything = ActionModelSettings(negatives="all")
    model = learn_action_models(world.true.skeleton, [*traces, steps[0]], everything)
    learned = _learned(model)
    for state in world.states:
        applicable = set(learned.applicable(state, RANDOM_OBJECTS))
        assert applicable <= set(world.true.applicable(state, RANDOM_OBJECTS))
    for trace in traces:
        if trace.states[0].is_complete:
            found = set(learned.applicable(trace.states[0].true, RANDOM_OBJECTS))
            assert ("act", trace.attempts[0].arguments) in found


def _hidden(step: Step, data: st.DataObject) -> PartialTrace:
    """A step of which a part is not told."""
    attempt = Attempt(step.action, step.arguments)
    return PartialTrace((attempt,), (_dimmed(step.before, data), _dimmed(step.after, data)))


def _dimmed(state: frozenset[str], data: st.DataObject) -> PartialState:
    if data.draw(st.booleans()):
        return PartialState(state, None)
    return PartialState(frozenset(a for a in state if data.draw(st.booleans())))


def test_a_plan_with_its_problem(tmp_path: Path) -> None:
    (tmp_path / "plan").write_text(PLAN)
    (tmp_path / "calm.pddl").write_text(PROBLEM)
    (trace,) = read_steps([tmp_path / "plan"], SKELETON, problems=[tmp_path / "calm.pddl"])
    assert isinstance(trace, PartialTrace)
    assert [a.arguments for a in trace.attempts][1:] == [("b1", "p", "q"), ("c1", "b1", "q")]
    assert trace.attempts[1].where.endswith("plan:3")
    start, *between, end = trace.states
    assert start == PartialState(frozenset({"at b1 p", "at c1 p"}), None)
    assert between == [UNKNOWN, UNKNOWN]
    assert end == PartialState(frozenset({"at c1 q"}), frozenset({"aboard c1 b1"}))
    land = learn_action_models(SKELETON, [trace]).actions["land"]
    assert "(at ?c ?h)" in [str(effect.change) for effect in land.effects]
    assert "(not (aboard ?c ?b))" not in [str(effect.change) for effect in land.effects]


@pytest.mark.parametrize(
    ("plan", "problem", "said"),
    [
        (PLAN, None, "plan:1: of a plan without states nothing can be learned"),
        (PLAN, PROBLEM.replace("(:goal", "(:aim"), "plan:1: where only the first state is known"),
        (PLAN, PROBLEM.replace("(:init", "(:begin"), "calm.pddl:1: expected a PDDL problem"),
        (PLAN, PROBLEM.replace("(at c1 p)", "(on c1 p)"), "calm.pddl:2"),
        (PLAN.replace("(Sail", "(Fly"), PROBLEM, "plan:3"),
        (PLAN.replace("p q)", "p)"), PROBLEM, "plan:3: expected 3 arguments of 'sail', got 2"),
        (PLAN.replace("p q)", "p q"), PROBLEM, "plan:3: expected an action such as"),
    ],
)
def test_a_plan_that_says_too_little(
    plan: str, problem: str | None, said: str, tmp_path: Path
) -> None:
    (tmp_path / "plan").write_text(plan)
    (tmp_path / "calm.pddl").write_text(problem or "")
    problems = [tmp_path / "calm.pddl"] if problem else []
    with pytest.raises(UserError) as caught:
        list(read_steps([tmp_path / "plan"], SKELETON, problems=problems))
    assert said in str(caught.value)


def test_the_number_of_problems(tmp_path: Path) -> None:
    plans, problems = [tmp_path / "1", tmp_path / "2", tmp_path / "3"], [tmp_path / "calm.pddl"]
    for plan in plans:
        plan.write_text(PLAN)
    problems[0].write_text(PROBLEM)
    assert len(list(read_steps(plans, SKELETON, problems=problems))) == 3
    assert len(list(read_steps(plans, SKELETON, problems=problems * 3))) == 3
    with pytest.raises(UserError, match="one problem for all traces or one for each of 3, got 2"):
        list(read_steps(plans, SKELETON, problems=problems * 2))


def test_states_may_be_missing_in_a_trace() -> None:
    text = """(:trajectory (:init (at b1 p) (at c1 p)) (:action (board c1 b1 p))
    (:action (sail b1 p home)) (:state (at b1 home) (full b1) (aboard c1 b1))
    (:action (land c1 b1 home)) (:goal (and (at c1 home) (not (full b1)))))"""
    first, second = parse_trace(text, "t", SKELETON)
    assert isinstance(first, PartialTrace)
    assert [state.is_complete for state in first.states] == [True, False, True]
    assert isinstance(second, PartialTrace)
    assert second.states[1].holds("full b1") is False
    assert second.states[1].holds("aboard c1 b1") is None


def test_states_may_say_all_that_is_known() -> None:
    text = """(:trajectory (:init (at b1 p) (at c1 p)) (:action (sail b1 p home))
    (:state (and (at b1 home) (not (storm)))) (:action (brew)) (:state (storm)))"""
    (trace,) = parse_trace(text, "t", SKELETON, partial=True)
    assert isinstance(trace, PartialTrace)
    assert [s.holds("storm") for s in trace.states] == [False, False, True]
    assert [s.holds("at c1 p") for s in trace.states] == [True, None, None]
    with pytest.raises(UserError, match="t:1: expected a complete state before and after"):
        list(parse_trace(text, "t", SKELETON, partial=True, failures=True))


def test_of_a_map_only_what_it_names_is_known(tmp_path: Path) -> None:
    line = {"skill": "brew", "arguments": [], "success": True, "after": ["storm()"]}
    before = {"storm()": False, "full(b1)": None, "at(b1, p)": 0.8}
    (tmp_path / "t.jsonl").write_text(json.dumps({**line, "before": before}))
    (trace,) = read_steps([tmp_path / "t.jsonl"], SKELETON)
    assert isinstance(trace, PartialTrace)
    known = trace.states[0]
    assert [known.holds(a) for a in ("storm", "full b1", "at b1 p")] == [False, None, True]


def test_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, text in (("plan", PLAN), ("calm.pddl", PROBLEM), ("boats.pddl", FERRY)):
        (tmp_path / name).write_text(text)
    given = ("learn-operators", tmp_path / "plan", "--domain", tmp_path / "boats.pddl")
    out = ("--out", tmp_path / "out")
    assert command(*given, "--problem", tmp_path / "calm.pddl", *out) == 0
    assert "no state shows whether it changes" in capsys.readouterr().out
    figures = json.loads((tmp_path / "out" / "action_models.json").read_text())
    assert "(full ?b)" in figures["actions"]["land"]["undecided"]
    assert command(*given, *out) != 0
    assert "plan without states" in capsys.readouterr().err


def test_the_start_of_a_walk_is_one_of_its_states(tmp_path: Path) -> None:
    true = strips_of(FERRY, tmp_path)
    steps = list(walk(true, 3, seed=1, failures=False))
    assert steps[0].before == STARTS["boats"]
    assert list(_thinned(steps, 1)) == [
        Step(s.action, s.arguments, True, s.before, s.after) for s in steps
    ]
