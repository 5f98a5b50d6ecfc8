"""The report of an experiment as one HTML file that needs nothing else."""

from __future__ import annotations

from pathlib import Path

from skillwrapper.domains.discovery import find_domain
from skillwrapper.evaluation.benchmark.experiment_folder import ExperimentFolder
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.files.writing import write_atomically
from skillwrapper.report.experiment_contents import ExperimentContents, ProblemCases
from skillwrapper.report.page import page_environment
from skillwrapper.report.pictures import Thumbnails
from skillwrapper.world.capabilities import Settable, supports
from skillwrapper.world.environment import Environment

_PICTURE_WIDTH = 200


class _ProblemPictures:
    """Shows initial and goal pictures of problems when they are needed."""

    def __init__(self, width: int) -> None:
        self._thumbnails = Thumbnails(width)
        self._environments: dict[str, Environment] = {}

    def of(self, case: ProblemCases) -> tuple[str, str]:
        """The first picture of the start and of the goal as data URIs; empty for what is not shown.

        Only what can be shown without running anything: states, and pictures that were given.
        """
        environment, problem = self._environment(case.domain), case.problem
        if not supports(environment, Settable) or problem.initial is None:
            goal = problem.goal_picture
            return "", self._thumbnails.uri(goal.png) if goal else ""
        world = ProblemWorld(environment)
        start, goal_shown = world.start(problem), world.goal(problem)
        first = self._thumbnails.uri(start.look().pictures[0].png)
        if goal_shown is None:
            return first, ""
        return first, self._thumbnails.uri(goal_shown.look().pictures[0].png)

    def close(self) -> None:
        for environment in self._environments.values():
            environment.close()

    def _environment(self, domain: str) -> Environment:
        if domain not in self._environments:
            self._environments[domain] = find_domain(domain).make_environment()
        return self._environments[domain]


def render_experiment(folder: ExperimentFolder, picture_width: int = _PICTURE_WIDTH) -> str:
    """The page; equal folders give equal pages.

    Raises:
        RunFolderError: if a file is damaged.
    """
    pictures = _ProblemPictures(picture_width)
    environment = page_environment()
    environment.globals["problem_pictures"] = pictures.of
    contents = ExperimentContents.gather(folder)
    page = environment.get_template("experiment.html.j2").render(content=contents)
    pictures.close()
    return page


def write_experiment_report(
    folder: ExperimentFolder, out: Path | None = None, picture_width: int = _PICTURE_WIDTH
) -> Path:
    """Write the page, by default as ``report.html`` into the experiment's folder; returns where.

    Raises:
        RunFolderError: if a file is damaged.
    """
    target = out or folder.path / "report.html"
    write_atomically(target, render_experiment(folder, picture_width))
    return target
