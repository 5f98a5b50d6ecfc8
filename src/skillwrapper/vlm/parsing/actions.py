"""Reading a plan out of a reply (the ViLa baseline)."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from skillwrapper.vlm.parsing.instances import InstanceReader, Step, instance_reader
from skillwrapper.vlm.parsing.lines import excerpt, reply_lines
from skillwrapper.world.skills import Skill, SkillInstance
from skillwrapper.world.types import Object

_LABEL = re.compile(
    r"(?:plan|answer|next (?:action|skill|step)|action|skill|result|final answer|status)"
    r" ?\d{0,3} ?[:=-]{1,3} ?",
    re.IGNORECASE,
)
_DONE = re.compile(
    r"\W{0,5}(?:done|task (?:is )?(?:done|complete|completed|finished)"
    r"|(?:the )?goal (?:is |has been )?(?:already )?reached)"
    r"(?: ?[:=] ?(?:true|yes))?\W{0,5}",
    re.IGNORECASE,
)
_IMPOSSIBLE = re.compile(
    r"\W{0,5}(?:(?:the |this )?(?:task|goal) (?:is|seems) )?"
    r"(?:impossible|infeasible|unsolvable|not possible)(?: to (?:solve|reach))?"
    r"(?: ?[:=] ?(?:true|yes))?\W{0,5}",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class ParsedPlan:
    """What a reply plans.

    Attributes:
        plan: the skills in their order.
        done: whether it says that nothing is left to do; a ``Done`` that ends a plan is none.
        impossible: whether it says that the goal cannot be reached.
        unusable: what could not be used, with the reason.
    """

    plan: tuple[SkillInstance, ...]
    done: bool
    impossible: bool
    unusable: tuple[str, ...]


def parse_plan(reply: str, skills: Sequence[Skill], objects: Sequence[Object]) -> ParsedPlan:
    """Read the plan that follows the reasoning. Never raises."""
    reader = instance_reader(tuple(skills), tuple(objects))
    lines = [_content(line.text) for line in reply_lines(reply)]
    steps, unusable = [], []
    for step in _planned(lines, reader):
        if isinstance(step.meant, str):
            unusable.append(excerpt(step.meant, 160))
        else:
            steps.append(step.meant)
    done = any(_DONE.fullmatch(line) for line in lines)
    impossible = not steps and any(_IMPOSSIBLE.fullmatch(line) for line in lines)
    if not (steps or done or impossible or unusable):
        unusable.append(f"no plan in the reply: '{excerpt(reply)}'")
    return ParsedPlan(
        tuple(steps), done and not steps and not unusable, impossible, tuple(unusable)
    )


def _content(line: str) -> str:
    label = _LABEL.match(line)
    return line[label.end() if label else 0 :].strip(" \"',")


def _planned(lines: list[str], reader: InstanceReader) -> list[Step]:
    """The steps of the lines that begin with a skill; where there are none, of the last that
    mentions any. Skills mentioned in the reasoning are not part of the plan.
    """
    found = [steps for line in lines if (steps := reader.steps(line))]
    listed = [steps for steps in found if steps[0].start == 0]
    known = (steps for steps in found if any(reader.knows_skill(s.skill) for s in steps))
    chosen = listed or list(known)[-1:]
    return [step for steps in chosen for step in steps]
