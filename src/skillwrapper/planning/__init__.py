"""Planning with a learned model, and running the plans."""

from skillwrapper.planning.execution import (
    PLANNING_BUDGET,
    Attempt,
    ExecutionReport,
    attempt,
)
from skillwrapper.planning.gif import save_gif
from skillwrapper.planning.goals import Goal, goal_from_state, parse_goal
from skillwrapper.planning.kstar import KStar
from skillwrapper.planning.planner import Planner, PlannerSettings
from skillwrapper.planning.problem import PlanningProblem
from skillwrapper.planning.problem_pddl import PlannerFiles, write_pddl
from skillwrapper.planning.result import PlanningResult, PlanningStatus, SkillPlan

__all__ = [
    "PLANNING_BUDGET",
    "Attempt",
    "ExecutionReport",
    "Goal",
    "KStar",
    "Planner",
    "PlannerFiles",
    "PlannerSettings",
    "PlanningProblem",
    "PlanningResult",
    "PlanningStatus",
    "SkillPlan",
    "attempt",
    "goal_from_state",
    "parse_goal",
    "save_gif",
    "write_pddl",
]
