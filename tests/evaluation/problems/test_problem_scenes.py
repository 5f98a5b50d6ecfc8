from __future__ import annotations

from collections import Counter

import numpy as np

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.panda.environment import PandaEnvironment
from skillwrapper.domains.panda.states import PandaState
from skillwrapper.evaluation.problems.problem_scenes import problems_over_scenes
from skillwrapper.evaluation.problems.problems import ProblemClass
from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import picture_of

LEARNED_IN = ("pouring", "wiping", "stacking")


class Unseen(PandaEnvironment):
    def draw(self, state: PandaState, layout: int) -> Picture:
        return picture_of(np.zeros((1, 1, 3), np.uint8))


def test_problems_lie_in_scenes_of_learning_and_in_another() -> None:
    made = problems_over_scenes(
        Unseen(),
        find_domain("panda"),
        3,
        learned_in=LEARNED_IN,
        scene="table",
        counts=(5, 4, 3),
    )
    names = [problem.name for problem in made.problems]
    assert len(set(names)) == len(names) == 12
    known = Counter(problem.scene for problem in made.of(ProblemClass.EASY))
    assert known == {"pouring": 2, "wiping": 2, "stacking": 1}
    others = [p for p in made.problems if p.kind is not ProblemClass.EASY]
    assert {problem.scene for problem in others} == {"table"}
