"""From a model, a scene, a start and a goal to skill plans."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.grounding import GroundModel, Labels
from skillwrapper.planning.goals import Goal
from skillwrapper.planning.kstar import KStar, SearchOutcome
from skillwrapper.planning.problem import PlanningProblem
from skillwrapper.planning.problem_pddl import write_pddl
from skillwrapper.planning.result import PlanningResult, PlanningStatus, SkillPlan
from skillwrapper.symbols.model import AbstractModel
from skillwrapper.symbols.predicates import Literal
from skillwrapper.world.types import Object

_GROWTH = 4
_MOST_ASKED = 16
"""At most this many times the plans wanted are asked for, when many are the same skills."""


class PlannerSettings(BaseModel):
    """How plans are looked for."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    plans: int = Field(
        default=10,
        ge=1,
        description="different skill plans at most",
        json_schema_extra={"unit": "plans"},
    )
    time_limit: float = Field(
        default=30.0,
        gt=0.0,
        allow_inf_nan=False,
        description="wall-clock time for one problem",
        json_schema_extra={"unit": "seconds"},
    )


@dataclass(frozen=True)
class Planner:
    """Finds the shortest skill plans of a model.

    Attributes:
        settings: how many plans, how long.
        engine: the planner that does it; one that is missing or breaks down is told as a status.
    """

    settings: PlannerSettings = field(default_factory=PlannerSettings)
    engine: KStar = field(default_factory=KStar.installed)

    def plan(
        self,
        model: AbstractModel,
        objects: Sequence[Object],
        initial: Labels,
        goal: Goal | Iterable[Literal],
        *,
        keep_files: Path | None = None,
    ) -> PlanningResult:
        """Plan in a scene.

        Args:
            model: the abstract model.
            objects: the objects of the scene.
            initial: labels of the atoms over the objects (shape: atoms); unknown counts as false.
            goal: a goal, or ground literals that must all hold.
            keep_files: a folder to write the problem into as PDDL.

        Raises:
            UnknownNameError: if a goal atom is not one of the scene.
            FileError: if the PDDL cannot be written.
        """
        return self.solve(
            PlanningProblem.of(GroundModel.of(model, objects), initial, goal), keep_files=keep_files
        )

    def solve(self, problem: PlanningProblem, *, keep_files: Path | None = None) -> PlanningResult:
        """Plan for a problem that is put together already."""
        started = time.monotonic()
        if keep_files is not None:
            write_pddl(problem, keep_files)
        if problem.is_solved:
            outcome = SearchOutcome(PlanningStatus.SOLVED, ((),), "the goal holds at the start")
        else:
            outcome = _checked(problem, self._search(problem, started))
        plans = _different_plans(problem, outcome)[: self.settings.plans]
        seconds = time.monotonic() - started
        return PlanningResult(outcome.status, plans, seconds, outcome.log, problem.guessed)

    def _search(self, problem: PlanningProblem, started: float) -> SearchOutcome:
        """Ask for more plans as long as too many of them are the same skills."""
        asked = self.settings.plans
        outcome = self.engine.search(problem, asked, self.settings.time_limit)
        while (
            len(outcome.plans) == asked < _MOST_ASKED * self.settings.plans
            and len(_different_plans(problem, outcome)) < self.settings.plans
        ):
            asked *= _GROWTH
            remaining = self.settings.time_limit - (time.monotonic() - started)
            if remaining <= 0:
                break
            more = self.engine.search(problem, asked, remaining)
            if len(more.plans) < len(outcome.plans):
                break  # out of time: the plans found before are the better answer
            outcome = more
        return outcome


def _checked(problem: PlanningProblem, outcome: SearchOutcome) -> SearchOutcome:
    """Without the plans that are none: a planner is checked, not believed."""
    good = tuple(plan for plan in outcome.plans if problem.is_plan(plan))
    bad = len(outcome.plans) - len(good)
    if not bad:
        return outcome
    log = f"the planner is wrong: {bad} of its plans do not reach the goal\n{outcome.log}"
    return SearchOutcome(PlanningStatus.SOLVED if good else PlanningStatus.ERROR, good, log)


def _different_plans(problem: PlanningProblem, outcome: SearchOutcome) -> tuple[SkillPlan, ...]:
    """Each skill sequence once; operators of one skill may differ in their context only."""
    return tuple(dict.fromkeys(problem.skills(numbers) for numbers in outcome.plans))
