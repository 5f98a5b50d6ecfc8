"""``skillwrapper plan`` and ``skillwrapper solve``: use a learned model."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.domains.discovery import find_domain
from skillwrapper.grounding import AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.planning.execution import ExecutionReport, attempt
from skillwrapper.planning.gif import save_gif
from skillwrapper.planning.goals import Goal, goal_from_state, parse_goal
from skillwrapper.planning.planner import Planner, PlannerSettings
from skillwrapper.planning.result import PlanningResult, PlanningStatus
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.learned import LearnedRun
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_picture

RunArgument = Annotated[Path, typer.Argument(help="Folder of a run.")]
GoalOption = Annotated[
    str, typer.Option(help="A picture of the goal, or an expression: '(and (p a) (not (q b)))'.")
]
GoalReading = Annotated[
    bool, typer.Option("--positive", help="Of a goal picture, take what is true only.")
]
PlansOption = Annotated[int, typer.Option(min=1, help="How many plans at most.")]
LimitOption = Annotated[float, typer.Option(min=0.1, help="Seconds for the planner.")]


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(plan)
    app.command()(solve)


def plan(
    run: RunArgument,
    init: Annotated[Path, typer.Option(help="A picture of the start.")],
    goal: GoalOption,
    positive: GoalReading = False,
    plans: PlansOption = 10,
    time_limit: LimitOption = 30.0,
    keep: Annotated[Path | None, typer.Option(help="Keep the PDDL of the problem here.")] = None,
    as_json: JsonFlag = False,
) -> None:
    """Find plans from a picture of the start to a goal."""
    learned = LearnedRun.read(RunFolder.open(run))
    start = Observation((load_picture(init),))
    planner = Planner(PlannerSettings(plans=plans, time_limit=time_limit))
    with open_session(learned.folder.config(), learned.folder.calls, learning=False) as session:
        reader = GoalReader(learned, TruthTable(learned.model.domain, session.assistant))
        found = reader.plan(planner, start, reader.read(goal, positive=positive), keep)
    if as_json:
        print_json(_describe(found))
    else:
        _print_plans(found)
    if found.status is PlanningStatus.ERROR:
        raise typer.Exit(1)


def solve(
    run: RunArgument,
    goal: GoalOption,
    init_seed: Annotated[int, typer.Option(min=0, help="Seed of the start.")] = 0,
    gif: Annotated[Path | None, typer.Option(help="Animation; default: RUN/solve.gif.")] = None,
    positive: GoalReading = False,
    plans: PlansOption = 10,
    time_limit: LimitOption = 30.0,
    as_json: JsonFlag = False,
) -> None:
    """Plan, execute in the domain, and save an animation."""
    learned = LearnedRun.read(RunFolder.open(run))
    environment = find_domain(learned.folder.config().domain).make_environment()
    planner = Planner(PlannerSettings(plans=plans, time_limit=time_limit))
    target = gif or run / "solve.gif"
    with open_session(learned.folder.config(), learned.folder.calls, learning=False) as session:
        reader = GoalReader(learned, TruthTable(learned.model.domain, session.assistant))
        wanted = reader.read(goal, positive=positive)
        found = reader.plan(planner, environment.reset(seed=init_seed), wanted, None)
        report = attempt(
            environment,
            lambda: environment.reset(seed=init_seed),
            found.plans,
            lambda: reader.holds(environment, wanted),
        )
    if report.attempts:
        save_gif(target, report.attempts[-1])
    environment.close()
    if as_json:
        animation = str(target) if report.attempts else None
        print_json({**_describe(found), **report.to_json(), "gif": animation})
    else:
        _print_solution(found, report, target)
    broken = found.status is PlanningStatus.ERROR
    if broken or (found.status is PlanningStatus.SOLVED and not report.solved):
        raise typer.Exit(1)


@dataclass(frozen=True)
class GoalReader:
    """Reads starts and goals with the predicates of a learned model.

    Attributes:
        learned: the model.
        truth: reads pictures.
    """

    learned: LearnedRun
    truth: TruthTable

    @property
    def space(self) -> AtomSpace:
        """The ground atoms over all objects of the domain."""
        return AtomSpace(self.learned.model.predicates, self.learned.model.domain.objects)

    def read(self, goal: str, *, positive: bool) -> Goal:
        """A goal from a picture file or from an expression."""
        if Path(goal).suffix.lower() in (".png", ".jpg", ".jpeg", ".bmp", ".webp"):
            seen = Observation((load_picture(Path(goal)),))
            state = self.truth.labels(self.space, [seen])[0]
            return goal_from_state(self.space, state, positive_only=positive)
        return parse_goal(goal, self.space, self.learned.model.domain.types.names)

    def plan(
        self, planner: Planner, start: Observation, goal: Goal, keep: Path | None
    ) -> PlanningResult:
        """Plans from what is seen to the goal."""
        state = self.truth.labels(self.space, [start])[0]
        model = self.learned.model
        return planner.plan(model, model.domain.objects, state, goal, keep_files=keep)

    def holds(self, environment: Environment, goal: Goal) -> bool:
        """Whether the goal is read off what is seen now."""
        state = self.truth.labels(self.space, [environment.observe()])[0]
        return goal.holds(self.space, state)


def _describe(found: PlanningResult) -> dict[str, object]:
    return {
        "status": str(found.status),
        "plans": [[str(instance) for instance in skills] for skills in found.plans],
        "seconds": round(found.seconds, 4),
        "guessed": [str(atom) for atom in found.guessed],
        "error": found.cause,
    }


def _print_plans(found: PlanningResult) -> None:
    console = results()
    console.print(f"{found.status} in {found.seconds:.2f} s", style="bold", markup=False)
    for number, skills in enumerate(found.plans, start=1):
        steps = ", ".join(map(str, skills)) or "nothing to do"
        console.print(f"{number:3d}. {steps}", markup=False)
    if found.status is PlanningStatus.ERROR:
        messages().print(found.log, markup=False)


def _print_solution(found: PlanningResult, report: ExecutionReport, gif: Path) -> None:
    console = results()
    if not report.attempts:
        console.print(f"{found.status}: there is nothing to execute", style="yellow")
        if found.status is PlanningStatus.ERROR:
            messages().print(found.cause, markup=False)
        return
    last = report.attempts[-1]
    for instance, outcome in zip(last.plan, last.outcomes, strict=False):
        done = "done" if outcome.success else f"failed: {outcome.message}"
        console.print(f"  {instance}: {done}", markup=False)
    if report.solved:
        console.print(f"solved with plan {report.budget}", style="green")
    else:
        console.print(f"not solved with {len(report.attempts)} plans", style="red")
    console.print(f"animation: {gif}", markup=False)
