"""The world of a new project: a run that was learned in it, and what its robot does there."""

from __future__ import annotations

from pathlib import Path

from skillwrapper.domains.package import DomainPackage
from skillwrapper.domains.starting import start_project
from skillwrapper.runs.launch import learn
from skillwrapper.world.observation import Observation

SKILLS = ("Open(arm, box)", "Open(arm, box)", "Pick(arm, red_cube)", "PutIn(arm, red_cube, box)")
EPISODES = (SKILLS, ("Pick(arm, green_cube)", "PutIn(arm, green_cube, box)", "Close(arm, box)"))


def learn_cubes(folder: Path) -> Path:
    """The folder of a short run in the world of a project that is started beside it."""
    start_project(folder / "cubes")
    settings = {"domain": str(folder / "cubes"), "iterations": 3, "exploration.budget": 15}
    learn(settings, folder / "run")
    return folder / "run"


def play(package: DomainPackage, skills: tuple[str, ...]) -> tuple[list[Observation], list[bool]]:
    """Pictures before, between and after the skills, and whether they succeeded."""
    environment = package.make_environment()
    seen, successes = [environment.reset(seed=0)], []
    instances = {str(i): i for i in package.domain.skill_instances}
    for skill in skills:
        outcome = environment.execute(instances[skill])
        seen.append(outcome.observation)
        successes.append(outcome.success)
    return seen, successes
