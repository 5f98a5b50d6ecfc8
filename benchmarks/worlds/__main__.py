"""What is learned of small made-up worlds with a model that reads carefully and does not plan.

Prints, for every world, seed and style of writing, how many of the problems that have a solution
were truly solved, precision, recall and effect accuracy over all states, the calls that learning
took, and the longest iteration. Run: ``python -m benchmarks.worlds [--world NAME ...]
[--seeds N ...] [--executions 300] [--style NAME ...] [--set NAME=VALUE ...] [--told]``.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from benchmarks.worlds.bakery import Bakery
from benchmarks.worlds.coffee_bar import CoffeeBar
from benchmarks.worlds.depot import Depot
from benchmarks.worlds.harbour import Harbour
from benchmarks.worlds.laboratory import Laboratory
from benchmarks.worlds.laundry import Laundry
from benchmarks.worlds.measure import Outcome, measure
from benchmarks.worlds.styles import STYLES
from benchmarks.worlds.warehouse import Warehouse
from benchmarks.worlds.workshop import Workshop
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.symbols.describe import describe_operator

DEVELOPED = {w.make.name: w for w in (CoffeeBar, Workshop, Laboratory, Warehouse, Laundry)}
LARGE = {Depot.make.name: Depot}
"""For measuring how long an iteration takes."""
HELD_BACK = {w.make.name: w for w in (Bakery, Harbour)}
"""Only for the last measurement before results are reported."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a line for each world, seed and style."""
    parser = argparse.ArgumentParser(description=__doc__)
    worlds = {**DEVELOPED, **LARGE, **HELD_BACK}
    parser.add_argument("--world", nargs="+", choices=sorted(worlds), default=list(DEVELOPED))
    parser.add_argument("--seeds", nargs="+", type=int, default=[0])
    parser.add_argument("--style", nargs="+", choices=STYLES, default=[])
    parser.add_argument("--executions", type=int, default=300)
    parser.add_argument("--set", nargs="+", default=[], metavar="NAME=VALUE")
    parser.add_argument("--told", action="store_true", help="print choices, model and causes")
    given = parser.parse_args(arguments)
    for name in given.world:
        for seed in given.seeds:
            for style in given.style or [STYLES[seed % len(STYLES)]]:
                found = measure(
                    worlds[name], seed, given.executions, style, given.set, told=given.told
                )
                print(f"{name:10s} seed {seed:2d} {style:6s} {found}", flush=True)
                if given.told:
                    _explain(found)


def _explain(found: Outcome) -> None:
    """Print what was learned, and what stands in the way."""
    for predicate in found.result.fit.predicates:
        print("   ", predicate.signature, predicate.semantics)
    for skill, tally in found.found.by_skill.items():
        print(f"    {skill:10s} P {tally.precision} R {tally.recall} E {tally.effect_accuracy}")
    for learned in found.result.fit.operators:
        print("   ", describe_operator(learned.operator))
    for cause in found.result.unresolved:
        print("    open:", _spoken(cause, found))
    for result in found.results:
        if not result.solved:
            print(f"    {result.problem} {result.kind}: {result.cause}: {result.detail}")
    print("    strange names:", dict(found.reader.strange))


def _spoken(cause: Inconsistency, found: Outcome) -> str:
    transition = found.result.transitions[cause.culprit]
    return f"{cause.kind} {transition.instance} {transition.success} (step {cause.culprit + 1})"


if __name__ == "__main__":
    main()
