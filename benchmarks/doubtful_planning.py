"""Solving problems whose starts and goals are misread, with operators that are right.

The expert's operators of a domain, its shipped problems, and a noise profile: what is lost, is lost
by reading. ``python -m benchmarks.doubtful_planning --seeds 20-39`` compares one reading with
several hypotheses; pictures are read without the way over prompts and replies.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence

from benchmarks.robustness import BlurredReader
from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.eyesight import Eyesight
from skillwrapper.domains.package import DomainPackage
from skillwrapper.embedded.noise import noise_profile
from skillwrapper.evaluation.exact.state_readers import PictureReader
from skillwrapper.evaluation.problems.problem_files import read_problems
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem, ProblemClass
from skillwrapper.evaluation.problems.results import ProblemResult
from skillwrapper.evaluation.problems.solving import ModelSolver
from skillwrapper.perception.acquaintance import Acquaintance
from skillwrapper.planning import Planner
from skillwrapper.planning.hypotheses.doubtful_planner import DoubtfulPlanner
from skillwrapper.planning.hypotheses.settings import HypothesesSettings
from skillwrapper.runs.settings import RunSettings


class Study:
    """Solves the problems of one domain with its expert's operators.

    Args:
        package: the domain; has a scene reader, an expert and problems.
        noise: a profile of the embedded model, or a rate.
        problems: how many easy, hard and impossible ones at most.
    """

    def __init__(self, package: DomainPackage, noise: str, problems: tuple[int, int, int]) -> None:
        self._model = package.expert.model
        self._environment = package.make_environment()
        self._eyes, self._noise = Eyesight.for_packages([package]), noise_profile(noise)
        found = read_problems(package.problems, self._environment)
        self._problems: tuple[Problem, ...] = found.first(*problems).problems

    def solve(
        self, seed: int, readings: str, settings: HypothesesSettings
    ) -> tuple[ProblemResult, ...]:
        """Solve all problems; the seed decides what is misread."""
        reader = BlurredReader(self._eyes, self._noise, seed)
        doubts = None
        if readings == "hypotheses":
            doubts = DoubtfulPlanner(
                self._model, self._look_around(reader, seed, settings), settings
            )
        solver = ModelSolver(
            ProblemWorld(self._environment),
            self._model,
            PictureReader(reader),
            Planner(),
            doubts=doubts,
        )
        return tuple(solver.solve(problem) for problem in self._problems)

    def _look_around(
        self, reader: BlurredReader, seed: int, settings: HypothesesSettings
    ) -> Acquaintance:
        """As the method ``expert-read`` does."""
        environment, run = self._environment, RunSettings(domain="", seed=seed)
        seeds = [run.layout_seed(number) for number in range(1, settings.starts + 1)]
        starts = [environment.reset(seed=layout) for layout in seeds]
        restored = environment.domain.resets_restore_state
        known = {environment.scene: starts}
        return Acquaintance.from_starts(known, reader, self._model.predicates, restored=restored)


def _figures(results: Sequence[ProblemResult]) -> str:
    solvable = [r for r in results if r.kind is not ProblemClass.IMPOSSIBLE]
    claims = [r for r in results if r.claimed_impossible]
    shares = "/".join(
        _share([r.solved for r in results if r.kind is kind]) for kind in ProblemClass
    )
    false = 100 * sum(r.claimed_impossible for r in solvable) / len(solvable)
    attempts = sum(r.attempts for r in results) / len(results)
    before = sum(r.attempts for r in claims) / max(1, len(claims))
    return (
        f"solved {shares} %  falsely impossible {false:.2f} %  plans a problem {attempts:.2f}  "
        f"before a claim {before:.2f}"
    )


def _share(solved: Sequence[bool]) -> str:
    return f"{100 * sum(solved) / len(solved):.1f}" if solved else "-"


def main(arguments: Sequence[str] | None = None) -> None:
    """Compare one reading with hypotheses, over all seeds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--domain", default="burger")
    parser.add_argument("--noise", default="gpt5")
    parser.add_argument("--seeds", default="0-19", help="FIRST-LAST")
    parser.add_argument("--readings", nargs="+", default=["single", "hypotheses"])
    parser.add_argument("--look-again", action="store_true")
    given = parser.parse_args(arguments)
    study = Study(find_domain(given.domain), given.noise, (20, 20, 10))
    settings = HypothesesSettings(look_again=given.look_again)
    first, last = map(int, given.seeds.split("-"))
    found: dict[str, list[ProblemResult]] = {readings: [] for readings in given.readings}
    causes: Counter[str] = Counter()
    for seed in range(first, last + 1):
        for readings in given.readings:
            results = study.solve(seed, readings, settings)
            found[readings] += results
            causes.update(f"{readings}: {r.cause}" for r in results if r.cause)
            print(f"seed {seed:2d}  {readings:10s}  {_figures(results)}", flush=True)
    for readings, results_of_all in found.items():
        print(f"all      {readings:10s}  {_figures(results_of_all)}")
    for cause, count in sorted(causes.items()):
        print(f"{count:5d}  {cause}")


if __name__ == "__main__":
    main()
