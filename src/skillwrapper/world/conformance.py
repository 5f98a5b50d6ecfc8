"""One check that any environment can be put through, robot or simulator.

A new environment's test is one line::

    check_environment(MyEnvironment)

There are two levels. A *robot* is asked for nothing that a world of matter cannot give: pictures of
one state may differ, and nothing is expected to happen twice in the same way. A *simulator* starts
in the same state from the same seed, and looking changes nothing; states are compared where they
can be read, and pictures only where the environment says that they repeat (``Replayable``). What
else an environment says that it can do (docs/semantics.md D20) is checked at either level.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from functools import partial

from skillwrapper.errors import ConformanceError, RobotError, UserError
from skillwrapper.world.capabilities import Replayable, Settable, supports
from skillwrapper.world.conformance_capabilities import check_capabilities
from skillwrapper.world.conformance_report import ConformanceReport, Level, SkillTally
from skillwrapper.world.domain import Domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Outcome
from skillwrapper.world.examined import Examined, expect, expect_error
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance, ground_skills

Factory = Callable[[], Environment]

_MEMBERS = ("domain", "scene", "reset", "execute", "observe", "close")


def check_environment(
    make: Factory,
    *,
    level: str | None = None,
    seed: int = 0,
    steps: int = 40,
    sample: int = 30,
) -> Level:
    """The level of an environment that passes ``examine_environment``, for tests of one line."""
    return examine_environment(make, level=level, seed=seed, steps=steps, sample=sample).level


def examine_environment(
    make: Factory,
    *,
    level: str | None = None,
    seed: int = 0,
    steps: int = 40,
    sample: int = 30,
) -> ConformanceReport:
    """Put an environment through every check of its level and of its capabilities.

    Args:
        make: makes a new environment; called once for a robot, several times for a simulator.
        level: what is asked; None for a simulator if states can be read or pictures repeat, and
            else for a robot.
        seed: of the resets, and of what is chosen by chance.
        steps: how many random skill instances are run in a row.
        sample: how many of the reachable states are looked at more closely.

    Returns:
        The level, and what was seen on the way.

    Raises:
        ConformanceError: names the first check that failed, the method, what was expected and
            what came.
    """
    environment = make()
    _check_protocol(environment)
    asked = Level(level) if level else _level_of(environment)
    examined = Examined(environment)
    _check_before_reset(examined)
    start = examined.reset("reset", seed)
    _check_scene(environment)
    _check_unknown_scene(environment, seed)
    if asked is Level.SIMULATOR:
        _check_scenes(examined, seed)
        _check_observe(examined, seed)
        _check_reset(examined, make, seed, steps)
    _check_unknown_instances(examined, compare=asked is Level.SIMULATOR)
    _check_outcomes(examined, start, seed, steps, compare=asked is Level.SIMULATOR)
    check_capabilities(examined, seed, sample)
    _check_close(environment)
    skills = {s.name: examined.skills.get(s.name, SkillTally()) for s in environment.domain.skills}
    return ConformanceReport(asked, examined.picture_sizes, skills)


def _level_of(environment: Environment) -> Level:
    """What can be asked of an environment by what it says that it can do."""
    repeats = supports(environment, Settable) or supports(environment, Replayable)
    return Level.SIMULATOR if repeats else Level.ROBOT


def _check_protocol(environment: Environment) -> None:
    missing = [name for name in _MEMBERS if not hasattr(environment, name)]
    expect(not missing, "protocol", f"expected all of {_MEMBERS}, got no {', '.join(missing)}")
    kind = type(environment.domain).__name__
    expect(kind == Domain.__name__, "protocol", f"domain: expected a Domain, got {kind}")


def _check_before_reset(examined: Examined) -> None:
    environment = examined.environment
    instances = _instances(environment.domain, environment.domain.scene())
    expect_error(RobotError, "before reset", "observe() before reset", environment.observe)
    execute = f"execute({instances[0]}) before reset"
    expect_error(RobotError, "before reset", execute, lambda: environment.execute(instances[0]))


def _check_scene(environment: Environment) -> None:
    scene: object = environment.scene
    if not isinstance(scene, Scene):
        kind = type(scene).__name__
        raise ConformanceError("scene", f"scene: expected a Scene, got {kind}")
    known = [o.name for o in environment.domain.objects]
    unknown = sorted(set(scene.names) - set(known))
    expect(not unknown, "scene", f"scene: expected objects of the domain, got {unknown}")
    expected = tuple(name for name in known if name in scene.names)
    expect(
        scene.names == expected and bool(expected),
        "scene",
        f"scene: expected each object once in the domain's order {expected}, got {scene.names}",
    )


def _check_unknown_scene(environment: Environment, seed: int) -> None:
    what = f"reset(seed={seed}, scene='no-such-scene')"
    unknown = "no-such-scene"
    expect_error(UserError, "scene", what, lambda: environment.reset(seed=seed, scene=unknown))


def _check_scenes(examined: Examined, seed: int) -> None:
    """Every declared scene can be started in."""
    for name, scene in examined.environment.domain.scenes.items():
        examined.reset("scene", seed, name)
        got = examined.environment.scene
        what = f"reset(seed={seed}, scene='{name}')"
        expect(got == scene, "scene", f"{what}: expected {scene.names}, got {got.names}")


def _check_unknown_instances(examined: Examined, *, compare: bool) -> None:
    environment = examined.environment
    before = examined.snapshot("unknown instance") if compare else None
    instance = _instances(environment.domain, environment.scene)[0]
    wrong = (
        SkillInstance("no such skill", instance.arguments),
        SkillInstance(instance.skill, ("no such object", *instance.arguments[1:])),
        SkillInstance(instance.skill, (*instance.arguments, *instance.arguments)),
    )
    for unknown in wrong:
        what = f"execute({unknown})"
        expect_error(UserError, "unknown instance", what, partial(environment.execute, unknown))
        if compare:
            examined.expect_same(before, "unknown instance", f"the refused {what}")


def _check_observe(examined: Examined, seed: int) -> None:
    start = examined.reset("observe", seed)
    state = examined.state
    for number in ("first", "second"):
        seen, what = examined.observe("observe"), f"the {number} observe() after reset"
        if supports(examined.environment, Replayable):
            expect(
                seen.key == start.key, "observe", f"{what}: expected the same pictures, got others"
            )
        expect(examined.state == state, "observe", f"{what}: expected {state}, got another state")


def _check_reset(examined: Examined, make: Factory, seed: int, steps: int) -> None:
    examined.reset("reset", seed)
    start, what = examined.snapshot("reset"), f"reset(seed={seed})"
    examined.reset("reset", seed)
    examined.expect_same(start, "reset", f"a second {what}")
    for instance in _random_instances(examined.environment, seed, steps):
        examined.execute("reset", instance)
    examined.reset("reset", seed)
    examined.expect_same(start, "reset", f"{what} after some skills")
    other = Examined(make())
    other.reset("reset", seed)
    other.expect_same(start, "reset", f"{what} of a new environment")
    _check_close(other.environment)


def _check_outcomes(
    examined: Examined, start: Observation, seed: int, steps: int, *, compare: bool
) -> None:
    cameras = [picture.camera for picture in start.pictures]
    constant = examined.environment.domain.failures_change_nothing
    if compare:
        examined.reset("outcome", seed)
    for instance in _random_instances(examined.environment, seed, steps):
        before = examined.snapshot("outcome") if compare else None
        outcome = examined.execute("outcome", instance)
        got = [picture.camera for picture in outcome.observation.pictures]
        expect(got == cameras, "outcome", f"execute({instance}): expected {cameras}, got {got}")
        if compare:
            _check_outcome(examined, before, instance, outcome, constant=constant)


def _check_outcome(
    examined: Examined, before: object, instance: SkillInstance, outcome: Outcome, *, constant: bool
) -> None:
    if supports(examined.environment, Replayable):
        same = examined.observe("outcome").key == outcome.observation.key
        what = f"execute({instance}): expected the pictures of a look afterwards, got others"
        expect(same, "outcome", what)
    if constant and not outcome.success:
        examined.expect_same(before, "failures change nothing", f"the failed execute({instance})")


def _check_close(environment: Environment) -> None:
    for number in ("first", "second"):
        try:
            environment.close()
        except Exception as error:
            message = f"close(): expected the {number} one to pass, got {error!r}"
            raise ConformanceError("close", message) from error


def _random_instances(environment: Environment, seed: int, count: int) -> Iterator[SkillInstance]:
    """Skill instances over the objects that are present, chosen at random by seed."""
    instances = _instances(environment.domain, environment.scene)
    chance = random.Random(seed)
    for _ in range(count):
        yield chance.choice(instances)


def _instances(domain: Domain, scene: Scene) -> tuple[SkillInstance, ...]:
    instances = ground_skills(domain.skills, scene.objects)
    expect(bool(instances), "scene", "scene: expected objects that some skill accepts, got none")
    return instances
