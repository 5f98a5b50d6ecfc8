"""What may be true after some calls, by what a prompt tells."""

from __future__ import annotations

from skillwrapper.embedded.imagination import Imagination
from skillwrapper.embedded.prompt_text import WrittenCall
from skillwrapper.embedded.told_rules import told_rules

OBJECTS = {"robot": frozenset({"robot"}), "door": frozenset({"door"}), "gate": frozenset({"door"})}
TOLD = """
- Open_1: Open(?robot: robot, ?door: door)
  needs unlocked(?door)
  may need not open(?door)
  makes true open(?door)
- Unlock_1: Unlock(?robot: robot, ?door: door)
  makes true unlocked(?door)
"""


def call(text: str) -> WrittenCall:
    name, _, argument = text.partition(" ")
    return WrittenCall(name, ("robot", argument))


def fact(name: str, of: str) -> WrittenCall:
    return WrittenCall(name, (of,))


CALLS = [call(f"{name} {door}") for name in ("Open", "Unlock") for door in ("door", "gate")]
MIND = Imagination(told_rules(TOLD.split("\n")), CALLS, OBJECTS)
NOTHING = (frozenset[WrittenCall](),)
UNLOCKED = (frozenset({fact("unlocked", "door")}),)
OPEN = (frozenset({fact("unlocked", "door"), fact("open", "door")}),)


def test_a_call_that_works_changes_what_is_told_and_another_nothing() -> None:
    assert MIND.after(UNLOCKED, call("Open door")) == OPEN
    assert MIND.after(NOTHING, call("Open door")) == NOTHING


def test_a_call_that_may_work_leaves_it_open() -> None:
    locked_open = (frozenset({fact("unlocked", "gate"), fact("open", "gate")}),)
    assert [c for c, _ in MIND.sure_tests(locked_open)] == [call("Open gate")]
    first, *others = MIND.after(locked_open, call("Open gate"))
    assert first == locked_open[0]
    assert others == []  # it would be open as before


def test_only_what_works_whatever_is_true_is_sure() -> None:
    either = (*UNLOCKED, *OPEN)
    assert set(MIND.surely_working(either)) == {call("Unlock door"), call("Unlock gate")}
    assert call("Open door") in MIND.surely_working(UNLOCKED)
    assert not list(MIND.sure_tests(either))


def test_the_ways_are_shortest() -> None:
    steps = list(MIND.reachable(NOTHING))
    assert [len(way) for reached in steps for _, way in reached] == sorted(
        len(way) for reached in steps for _, way in reached
    )
    ways = {belief: way for reached in steps for belief, way in reached}
    assert ways[OPEN] == [call("Unlock door"), call("Open door")]
    assert len(ways) == sum(map(len, steps))
