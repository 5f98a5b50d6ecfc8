"""``skillwrapper execute``: bring about a goal from what is seen now, with care."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import typer

from skillwrapper.cli.output import JsonFlag, messages, print_json, results
from skillwrapper.cli.planning import (
    GoalOption,
    GoalReading,
    RunArgument,
    known_scene,
    read_wanted,
)
from skillwrapper.cli.readings import ReadingsOption
from skillwrapper.cli.ways_to_run import (
    ByHandOption,
    CameraOption,
    RobotOption,
    RobotTimeoutOption,
    environment_of,
)
from skillwrapper.errors import UnknownNameError
from skillwrapper.planning.result import SkillPlan
from skillwrapper.runs.abstract_states import AbstractState
from skillwrapper.runs.archive import ArchivedIteration, RunArchive, reserved
from skillwrapper.runs.careful_execution import CarefulExecution
from skillwrapper.runs.carrying_out import Ending, Execution, ExecutionReport, ExecutionSettings
from skillwrapper.runs.caveats import caveats
from skillwrapper.runs.doubtful_execution import DoubtfulExecution
from skillwrapper.runs.execution_records import ExecutionRecord
from skillwrapper.runs.foresight import foresee
from skillwrapper.runs.learned_model import LearnedModel
from skillwrapper.world.capabilities import Judged, require
from skillwrapper.world.environment import Environment
from skillwrapper.world.robot import RobotEnvironment


def register(app: typer.Typer) -> None:
    """Add the commands of this group."""
    app.command()(execute)


def execute(
    run: RunArgument,
    goal: GoalOption,
    replan: Annotated[
        bool, typer.Option("--replan", help="Plan anew when something goes another way.")
    ] = False,
    replans: Annotated[int, typer.Option(min=1, help="How often at most, with --replan.")] = 5,
    yes: Annotated[bool, typer.Option("--yes", help="Do not ask before the first skill.")] = False,
    scene: Annotated[
        str | None, typer.Option(help="What is present; default: what the robot says.")
    ] = None,
    positive: GoalReading = False,
    readings: ReadingsOption = None,
    prepare: Annotated[
        bool, typer.Option("--prepare", help="Let the robot prepare a start first.")
    ] = False,
    seed: Annotated[int, typer.Option(min=0, help="Of that start.")] = 0,
    test: Annotated[
        str | None, typer.Option(help="A goal of the environment's own; its test decides.")
    ] = None,
    skill_limit: Annotated[float, typer.Option(min=0.1, help="Seconds a skill may take.")] = 300.0,
    robot: RobotOption = None,
    robot_timeout: RobotTimeoutOption = 300.0,
    by_hand: ByHandOption = False,
    camera: CameraOption = None,
    as_json: JsonFlag = False,
) -> None:
    """Plan from what is seen now, run skill by skill, and compare each with what was expected."""
    archive = RunArchive.open(run)
    settings = ExecutionSettings(replans=replans if replan else 0, skill_limit=skill_limit)
    domain = archive.settings().domain
    with (
        reserved(run),
        LearnedModel.load(run) as learned,
        environment_of(domain, robot, robot_timeout, by_hand, camera) as environment,
    ):
        is_reached = _test(environment, test)
        _begin(environment, scene, prepare, seed)
        record = ExecutionRecord(archive.layout)
        confirm = _confirmation(learned, archive.latest(), yes)
        wanted = read_wanted(learned, goal, environment.scene.name, positive)
        known = known_scene(learned, environment.scene, readings)
        carried: Execution
        if known is not None:
            carried = DoubtfulExecution(
                learned, known, environment, wanted, record, settings, confirm, _say
            )
        else:
            as_read = wanted.as_read(learned.space(environment.scene))
            carried = CarefulExecution(
                learned, environment, as_read, record, settings, confirm, _say
            )
        report = carried.run()
        verdict = is_reached() if is_reached else None
        record.note("judged", test=test, reached=verdict)
    succeeded = report.ending is Ending.REACHED if verdict is None else verdict
    if as_json:
        print_json({**_describe(report), "test": verdict, "log": str(record.log)})
    else:
        results().print(_words(report, test, verdict), style="green" if succeeded else "red")
        results().print(f"recorded in {record.log}; the next learn uses it")
    if not succeeded:
        raise typer.Exit(1)


def _begin(environment: Environment, scene: str | None, prepare: bool, seed: int) -> None:
    """Stand ready: as the robot stands, or, of what has no state of its own, at a start."""
    if isinstance(environment, RobotEnvironment) and not prepare:
        environment.take_up(environment.present(scene))
    else:
        environment.reset(seed=seed, scene=scene)


def _test(environment: Environment, name: str | None) -> Callable[[], bool] | None:
    if name is None:
        return None
    judged = require(environment, Judged, f"--test {name}")
    if name not in judged.goals:
        raise UnknownNameError("goal", name, judged.goals, "--test")
    return lambda: judged.is_reached(name)


def _confirmation(
    learned: LearnedModel, iteration: ArchivedIteration, yes: bool
) -> Callable[[SkillPlan, AbstractState], bool]:
    def confirm(plan: SkillPlan, state: AbstractState) -> bool:
        for number, step in enumerate(foresee(learned, state, plan), start=1):
            _say(f"{number:3d}. {step}")
        for sentence in caveats(iteration, (instance.skill for instance in plan)):
            _say(f"note: {sentence}", "yellow")
        try:
            return yes or typer.confirm("Run this?", err=True)
        except typer.Abort:  # nobody is there to ask
            return False

    return confirm


def _say(text: str, style: str = "") -> None:
    messages().print(text, style=style, soft_wrap=True)


def _words(report: ExecutionReport, test: str | None, verdict: bool | None) -> str:
    """How it ended, in words that claim no more than is known."""
    reason = f" ({report.reason})" if report.reason else ""
    if verdict is not None:
        decided = "reached" if verdict else "not reached"
        return f"{decided}: so says the test '{test}' of the environment{reason}"
    match report.ending:
        case Ending.REACHED:
            return f"reached, as far as the model can tell{reason}"
        case Ending.NOT_REACHED:
            return f"not reached, as far as the model can tell{reason}"
        case Ending.NO_PLAN:
            return f"the model knows no way from what is seen{reason}"
        case Ending.DECLINED:
            return "nothing was run"
    return f"{report.ending}{reason}"


def _describe(report: ExecutionReport) -> dict[str, object]:
    return {
        "ending": str(report.ending),
        "reason": report.reason,
        "executed": [{"skill": str(i), "success": success} for i, success in report.executed],
        "surprises": [str(surprise) for surprise in report.surprises],
        "plans": report.plans,
    }
