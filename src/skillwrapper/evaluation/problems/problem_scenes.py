"""Problems for generalization: some in the scenes of learning, the others in a scene of its own.

The class *easy* stands for problems in scenes of learning and *hard* for those in the other one,
as columns of tables; a domain's published figures say what the paper calls them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from skillwrapper.domains.package import DomainPackage
from skillwrapper.evaluation.problems.problem_generator import ProblemGenerator
from skillwrapper.evaluation.problems.problems import (
    LONGEST_EASY,
    Problem,
    ProblemClass,
    ProblemSet,
)
from skillwrapper.world.capabilities import Enumerable

_LENGTHS = range(1, LONGEST_EASY + 1)


def problems_over_scenes(
    environment: Enumerable,
    package: DomainPackage,
    seed: int,
    *,
    learned_in: Sequence[str],
    scene: str | None,
    counts: tuple[int, int, int],
) -> ProblemSet:
    """Problems in the scenes of learning, in turn, and in another scene.

    Args:
        environment: the domain.
        package: tells structures and reasons.
        seed: decides every choice.
        learned_in: names of the scenes of learning.
        scene: name of the other scene, where the impossible ones are too; None for the first.
        counts: how many in scenes of learning, in the other scene, and impossible ones.

    Raises:
        ConfigurationError: if the domain has not so many.
        UnknownNameError: if there is no such scene.
    """
    known, unknown, impossible = counts
    problems: list[Problem] = []
    for number, name in enumerate(learned_in):
        share = len(range(number, known, len(learned_in)))
        environment.reset(seed=0, scene=name)
        generator = ProblemGenerator(environment, package, seed + 1 + number)
        problems += generator.solvable(ProblemClass.EASY, share, _LENGTHS)
    environment.reset(seed=0, scene=scene)
    generator = ProblemGenerator(environment, package, seed)
    problems += generator.solvable(ProblemClass.HARD, unknown, _LENGTHS)
    problems += generator.impossible(impossible)
    return ProblemSet(environment.domain.name, seed, tuple(_numbered(problems)))


def _numbered(problems: Sequence[Problem]) -> Iterator[Problem]:
    """With names that are unique over the scenes."""
    for kind in ProblemClass:
        mine = [problem for problem in problems if problem.kind is kind]
        for number, problem in enumerate(mine, start=1):
            yield replace(problem, name=f"{kind}-{number:02d}")
