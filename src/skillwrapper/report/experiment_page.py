"""The report of an experiment as one HTML file that needs nothing else."""

from __future__ import annotations

from pathlib import Path

from skillwrapper.evaluation.benchmark.experiment_folder import (
    ExperimentFolder,
    enumerable_environment,
)
from skillwrapper.files.writing import write_atomically
from skillwrapper.report.experiment_contents import ExperimentContents, ProblemCases
from skillwrapper.report.page import page_environment
from skillwrapper.report.pictures import Thumbnails
from skillwrapper.world.capabilities import Enumerable

_PICTURE_WIDTH = 200


class _ProblemPictures:
    """Draws initial and goal pictures of problems when they are needed."""

    def __init__(self, width: int) -> None:
        self._thumbnails = Thumbnails(width)
        self._environments: dict[str, Enumerable] = {}

    def of(self, case: ProblemCases) -> tuple[str, str]:
        """The first picture of the start and of the goal as data URIs."""
        if case.domain not in self._environments:
            self._environments[case.domain] = enumerable_environment(case.domain)
        environment, problem = self._environments[case.domain], case.problem
        start, end = (environment.state_from_data(d) for d in (problem.initial, problem.goal))
        seen = environment.set_state(start, seed=problem.layout)
        goal = environment.set_state(end)
        first, last = (self._thumbnails.uri(o.pictures[0].png) for o in (seen, goal))
        return first, last

    def close(self) -> None:
        for environment in self._environments.values():
            environment.close()


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
