"""Memory and time of learning from wrong labels: blocks world, one label in a hundred flipped.

Wrong labels make operators with many context parameters out of single transitions; what binds
them must not grow with the product of their objects. Run: ``python -m benchmarks.memory``.
"""

from __future__ import annotations

import time
import tracemalloc

import numpy as np

from skillwrapper.grounding import AtomSpace, Labels
from skillwrapper.learning.certification import certify
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.learner import learn_operators
from skillwrapper.learning.untested import find_untested
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.transitions.executions import Executions
from skillwrapper.transitions.labelled import LabelledTransitions, SceneTransitions
from skillwrapper.world import Domain, Object, Parameter, Skill, SkillInstance, TypeHierarchy

AT_MOST = 300
"""Megabytes."""
BLOCKS = tuple(Object(f"b{n}", ("block",)) for n in range(10))
ONE, TWO = (Parameter("block", "block"),), (Parameter("block", "block"), Parameter("on", "block"))
SKILLS = (Skill("Pick", ONE), Skill("Put", ONE), Skill("Unstack", TWO), Skill("Stack", TWO))
DOMAIN = Domain("blocks", "A crane.", "Blocks.", TypeHierarchy({"block": ()}), BLOCKS, SKILLS)
PREDICATES = (
    Predicate("free", (), "The crane holds nothing."),
    Predicate("holds", ("block",), "The crane holds the block."),
    Predicate("clear", ("block",), "Nothing is on the block, and it is not held."),
    Predicate("on_table", ("block",), "The block is on the table."),
    Predicate("on", ("block", "block"), "The first block is on the second one."),
)
SPACE = AtomSpace(PREDICATES, BLOCKS)

State = dict[str, str]
"""What each block is on: a block, ``"table"`` or ``"crane"``."""


def atoms(state: State) -> set[Atom]:
    """The true atoms of a state."""
    below = set(state.values())
    true = {Atom("clear", (b,)) for b, on in state.items() if b not in below and on != "crane"}
    true |= {Atom("holds", (b,)) for b, on in state.items() if on == "crane"}
    true |= {Atom("on_table", (b,)) for b, on in state.items() if on == "table"}
    true |= {Atom("on", (b, on)) for b, on in state.items() if on in state}
    return true if "crane" in below else true | {Atom("free")}


def succeed(state: State, instance: SkillInstance) -> State | None:
    """The next state, or None if the skill fails."""
    block, *other = instance.arguments
    free, covered = "crane" not in state.values(), block in state.values()
    match instance.skill:
        case "Pick":
            works, place = free and not covered and state[block] == "table", "crane"
        case "Put":
            works, place = state[block] == "crane", "table"
        case "Unstack":
            works, place = free and not covered and state[block] == other[0], "crane"
        case _:
            bare = other[0] not in state.values() and state[other[0]] != "crane"
            works, place = state[block] == "crane" and bare, other[0]
    return {**state, block: place} if works else None


def label(states: list[State], wrong: float, chance: np.random.Generator) -> Labels:
    """Labels of states, a share of them flipped."""
    labels = np.zeros((len(states), len(SPACE.atoms)), dtype=np.int8)
    for row, state in enumerate(states):
        labels[row, SPACE.columns(atoms(state))] = 1
    return np.where(chance.random(labels.shape) < wrong, 1 - labels, labels).astype(np.int8)


def transitions(size: int, wrong: float, seed: int) -> LabelledTransitions:
    """A walk of which every other skill succeeds."""
    chance = np.random.default_rng(seed)
    instances = [i for i in DOMAIN.skill_instances if len(set(i.arguments)) == len(i.arguments)]
    states: list[State] = [{b.name: "table" for b in BLOCKS}]
    done: list[tuple[int, bool]] = []
    while len(done) < size:
        number = int(chance.integers(len(instances)))
        after = succeed(states[-1], instances[number])
        if (after is not None) == (len(done) % 2 == 0):
            done.append((number, after is not None))
            states.append(states[-1] if after is None else after)
    rows = np.arange(size)
    executions = Executions(
        DOMAIN.scene(),
        tuple(instances),
        which=np.array([number for number, _ in done]),
        success=np.array([success for _, success in done]),
        before=rows,
        after=rows + 1,
        unchanged=np.zeros(size, dtype=bool),
        ids=rows,
    )
    scene = SceneTransitions.of(executions, SPACE, label(states, wrong, chance))
    return LabelledTransitions(DOMAIN, PREDICATES, (scene,))


def learn(labelled: LabelledTransitions) -> Fit:
    """Learn every skill, and do everything that looks at all bindings."""
    found = learn_operators(labelled)
    assert found.inconsistencies is not None
    certify(found)
    find_untested(found)
    return found


def main() -> None:
    """Print peak memory and seconds for several sizes, without and with wrong labels."""
    for wrong in (0.0, 0.01):
        for size in (125, 250, 500):
            labelled = transitions(size, wrong, seed=0)
            started = time.perf_counter()
            found = learn(labelled)
            seconds = time.perf_counter() - started
            tracemalloc.start()
            learn(labelled)
            peak = tracemalloc.get_traced_memory()[1] / 1e6
            tracemalloc.stop()
            most = max(len(learned.operator.parameters) for learned in found.operators)
            print(
                f"{wrong:4.0%} wrong, {size} transitions: {seconds:5.2f} s, peak {peak:5.1f} MB "
                f"(at most {AT_MOST} asked for); {len(found.operators)} operators of up to {most} "
                "parameters",
                flush=True,
            )


if __name__ == "__main__":
    main()
