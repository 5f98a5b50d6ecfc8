"""``skillwrapper plan`` and ``skillwrapper solve``: use a learned model."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from functools import reduce
from pathlib import Path
from typing import Annotated

import typer

from skillwrapper.cli.films import filmed
from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.readings import Readings, ReadingsOption
from skillwrapper.domains.discovery import find_domain
from skillwrapper.planning.execution import ExecutionReport
from skillwrapper.planning.gif import save_gif
from skillwrapper.planning.goals import Goal
from skillwrapper.planning.hypotheses.doubtful_planner import KnownScene, WantedReading
from skillwrapper.planning.result import PlanningResult, PlanningStatus
from skillwrapper.redaction import without_secrets
from skillwrapper.runs.learned_model import LearnedModel, is_picture_file
from skillwrapper.runs.solving import AsRead, InDoubt, Way
from skillwrapper.world.observation import Observation
from skillwrapper.world.pictures import load_pictures
from skillwrapper.world.scenes import Scene

RunArgument = Annotated[Path, typer.Argument(help="Folder of a run.")]
GoalOption = Annotated[
    list[str],
    typer.Option(
        help="A picture of the goal ([CAMERA=]FILE), or an expression: '(and (p a) (not (q b)))'; "
        "repeatable."
    ),
]
GoalReading = Annotated[
    bool, typer.Option("--positive", help="Of a goal picture, take what is true only.")
]
SceneOption = Annotated[
    str | None, typer.Option(help="Name of the scene; default: the domain's first one.")
]
PlansOption = Annotated[int, typer.Option(min=1, help="How many plans at most.")]
LimitOption = Annotated[float, typer.Option(min=0.1, help="Seconds for the planner.")]


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(plan)
    app.command()(solve)


def plan(
    run: RunArgument,
    init: Annotated[
        list[str], typer.Option(help="A picture of the start, [CAMERA=]FILE; one a camera.")
    ],
    goal: GoalOption,
    scene: SceneOption = None,
    positive: GoalReading = False,
    plans: PlansOption = 10,
    time_limit: LimitOption = 30.0,
    keep: Annotated[Path | None, typer.Option(help="Keep the PDDL of the problem here.")] = None,
    as_json: JsonFlag = False,
) -> None:
    """Find plans from a picture of the start to a goal."""
    with LearnedModel.load(run) as learned:
        start = learned.read(load_pictures(init), scene=scene)
        wanted = read_wanted(learned, goal, scene, positive).as_read(learned.space(start.scene))
        found = learned.plan(start, wanted, plans=plans, time_limit=time_limit, keep_files=keep)
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
    scene: SceneOption = None,
    gif: Annotated[Path | None, typer.Option(help="Animation; default: RUN/solve.gif.")] = None,
    video: Annotated[
        Path | None,
        typer.Option(help="Also write a video (.webp, .gif) of the last try, if it can be filmed."),
    ] = None,
    positive: GoalReading = False,
    readings: ReadingsOption = None,
    plans: PlansOption = 10,
    time_limit: LimitOption = 30.0,
    as_json: JsonFlag = False,
) -> None:
    """Plan, execute in the domain, and save an animation."""
    target = gif or run / "solve.gif"
    with (
        LearnedModel.load(run) as learned,
        closing(find_domain(learned.settings.domain).make_environment()) as environment,
    ):
        present = learned.domain.scene(scene)
        wanted = read_wanted(learned, goal, scene, positive)

        def reset() -> Observation:
            return environment.reset(seed=init_seed, scene=present.name)

        start = learned.read(reset(), scene=present)
        known = known_scene(learned, present, readings)
        if known is not None:
            beliefs = known.beliefs(known.likely(start.labels), known.goals(wanted))
            way: Way = InDoubt(learned, present, beliefs)
        else:
            as_read = wanted.as_read(start.space)
            planned = learned.plan(start, as_read, plans=plans, time_limit=time_limit)
            way = AsRead(learned, present, planned, as_read)
        with filmed(environment, video if way.has_plan else None) as film:

            def prepare() -> Observation:
                if film is not None:
                    film.frames.clear()
                return reset()

            solution = way.carry_out(environment, prepare)
    found, report = solution.found, solution.report
    if report.attempts:
        save_gif(target, report.attempts[-1])
    if as_json:
        animation = str(target) if report.attempts else None
        print_json({**_describe(found), **report.to_json(), "gif": animation})
    else:
        _print_solution(found, report, target)
    broken = found.status is PlanningStatus.ERROR
    if broken or (found.status is PlanningStatus.SOLVED and not report.solved):
        raise typer.Exit(1)


def read_wanted(
    learned: LearnedModel, parts: Sequence[str], scene: str | None, positive: bool
) -> WantedReading:
    """What the pictures and the expressions ask for, all together."""
    pictures = [part for part in parts if is_picture_file(part)]
    goals = [learned.goal(part, scene=scene) for part in parts if part not in pictures]
    read = learned.read(load_pictures(pictures), scene=scene).labels if pictures else None
    written = reduce(Goal.together_with, goals) if goals else None
    return WantedReading(read, written, positive)


def known_scene(
    learned: LearnedModel, scene: Scene, readings: Readings | None
) -> KnownScene | None:
    """What is known of a scene for hypotheses; None if readings are taken as they are.

    Says so where hypotheses are asked for, and the states of the scene cannot be told apart.
    """
    if readings is not Readings.HYPOTHESES:
        return None
    known = learned.doubts().known(scene)
    if known is None:
        messages().print(
            f"note: no states of the scene '{scene.name}' are known, or too many to tell apart; "
            "what is read is taken as it is",
            style="yellow",
        )
    return known


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
    console.print(f"{found.status} in {found.seconds:.2f} s", style="bold")
    for number, skills in enumerate(found.plans, start=1):
        steps = ", ".join(map(str, skills)) or "nothing to do"
        console.print(f"{number:3d}. {steps}")
    if found.status is PlanningStatus.ERROR:
        messages().print(found.log)


def _print_solution(found: PlanningResult, report: ExecutionReport, gif: Path) -> None:
    console = results()
    if not report.attempts:
        console.print(f"{found.status}: there is nothing to execute", style="yellow")
        if found.status is PlanningStatus.ERROR:
            messages().print(found.cause)
        return
    last = report.attempts[-1]
    for instance, outcome in zip(last.plan, last.outcomes, strict=False):
        done = "done" if outcome.success else f"failed: {without_secrets(outcome.message)}"
        console.print(f"  {instance}: {done}")
    if report.solved:
        console.print(f"solved with plan {report.budget}", style="green")
    else:
        console.print(f"not solved with {len(report.attempts)} plans", style="red")
    console.print(f"animation: {gif}")
