"""One check that any environment can be put through, simulator or robot.

A new environment's test is one line::

    check_environment(MyEnvironment)
"""

from __future__ import annotations

import io
import random
from collections.abc import Callable, Iterator
from functools import partial

from PIL import Image, UnidentifiedImageError

from skillwrapper.errors import ConformanceError, RobotError, UserError
from skillwrapper.world.domain import Domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance, ground_skills

Factory = Callable[[], Environment]


def check_environment(make: Factory, *, seed: int = 0, steps: int = 40) -> None:
    """Put an environment through every check of the ``Environment`` protocol.

    Args:
        make: makes a new environment; called several times.
        seed: of the resets and of the skills that are chosen.
        steps: how many random skill instances are run in a row.

    Raises:
        ConformanceError: names the first check that failed, what was expected and what came.
    """
    _check_protocol(make)
    _check_before_reset(make, seed)
    _check_scene(make, seed)
    _check_scenes(make, seed)
    _check_pictures(make, seed)
    _check_observe(make, seed)
    _check_reset(make, seed, steps)
    _check_unknown_instances(make, seed)
    _check_outcomes(make, seed, steps)
    _check_close(make, seed)


def require(condition: bool, check: str, message: str) -> None:
    """Raise ``ConformanceError`` unless a condition holds."""
    if not condition:
        raise ConformanceError(check, message)


def random_instances(environment: Environment, seed: int, count: int) -> Iterator[SkillInstance]:
    """Skill instances over the objects that are present, chosen at random by seed."""
    domain = environment.domain
    instances = ground_skills(domain.skills, environment.scene.objects)
    require(bool(instances), "scene", "expected objects that some skill accepts, got none")
    chance = random.Random(seed)
    for _ in range(count):
        yield chance.choice(instances)


def _check_protocol(make: Factory) -> None:
    environment = make()
    members = ("domain", "scene", "reset", "execute", "observe", "close")
    missing = [name for name in members if not hasattr(environment, name)]
    require(not missing, "protocol", f"expected all of {members}, got no {', '.join(missing)}")
    require(
        isinstance(environment.domain, Domain),
        "protocol",
        f"expected a Domain as domain, got {type(environment.domain).__name__}",
    )


def _check_before_reset(make: Factory, seed: int) -> None:
    prepared = make()
    prepared.reset(seed=seed)
    instance = next(random_instances(prepared, seed, 1))
    calls: dict[str, Callable[[Environment], object]] = {
        "observe": lambda environment: environment.observe(),
        "execute": partial(_execute, instance),
    }
    for name, call in calls.items():
        _require_error(RobotError, "before reset", f"{name} before reset", call, make())


def _check_scene(make: Factory, seed: int) -> None:
    environment = make()
    environment.reset(seed=seed)
    scene = environment.scene
    require(
        isinstance(scene, Scene), "scene", f"expected a Scene as scene, got {type(scene).__name__}"
    )
    known = [o.name for o in environment.domain.objects]
    unknown = sorted(set(scene.names) - set(known))
    require(not unknown, "scene", f"expected objects of the domain, got {', '.join(unknown)}")
    expected = tuple(name for name in known if name in scene.names)
    require(
        scene.names == expected and bool(expected),
        "scene",
        f"expected each object once in the domain's order {expected}, got {scene.names}",
    )


def _check_scenes(make: Factory, seed: int) -> None:
    """Every declared scene can be started in, and no other."""
    environment = make()
    for name, scene in environment.domain.scenes.items():
        environment.reset(seed=seed, scene=name)
        got = environment.scene
        require(got == scene, "scene", f"expected {scene.names} in scene '{name}', got {got.names}")
    unknown = partial(_reset, seed, "no such scene")
    _require_error(UserError, "scene", "reset to an unknown scene", unknown, environment)


def _check_pictures(make: Factory, seed: int) -> None:
    environment = make()
    observation = environment.reset(seed=seed)
    cameras = [picture.camera for picture in observation.pictures]
    require(bool(cameras), "pictures", "expected at least one picture, got none")
    require(
        len(set(cameras)) == len(cameras),
        "pictures",
        f"expected a different camera each, got {cameras}",
    )
    for picture in observation.pictures:
        kind = _picture_format(picture.png)
        require(kind == "PNG", "pictures", f"expected PNG of '{picture.camera}', got {kind}")


def _check_observe(make: Factory, seed: int) -> None:
    environment = make()
    start = environment.reset(seed=seed)
    for number in ("first", "second"):
        _require_same(start, environment.observe(), "observe", f"the {number} look after reset")


def _check_reset(make: Factory, seed: int, steps: int) -> None:
    environment = make()
    start = environment.reset(seed=seed)
    _require_same(start, environment.reset(seed=seed), "reset", "reset with the same seed")
    for instance in random_instances(environment, seed, steps):
        environment.execute(instance)
    _require_same(start, environment.reset(seed=seed), "reset", "reset after some skills")
    _require_same(start, make().reset(seed=seed), "reset", "reset of a new environment")


def _check_unknown_instances(make: Factory, seed: int) -> None:
    environment = make()
    start = environment.reset(seed=seed)
    instance = next(random_instances(environment, seed, 1))
    wrong = (
        SkillInstance("no such skill", instance.arguments),
        SkillInstance(instance.skill, ("no such object", *instance.arguments[1:])),
        SkillInstance(instance.skill, (*instance.arguments, *instance.arguments)),
    )
    for unknown in wrong:
        what = f"execution of {unknown}"
        _require_error(UserError, "unknown instance", what, partial(_execute, unknown), environment)
        _require_same(start, environment.observe(), "unknown instance", f"a look after {what}")


def _check_outcomes(make: Factory, seed: int, steps: int) -> None:
    environment = make()
    before = environment.reset(seed=seed)
    constant = environment.domain.failures_change_nothing
    for instance in random_instances(environment, seed, steps):
        outcome = environment.execute(instance)
        _require_same(
            outcome.observation, environment.observe(), "outcome", f"a look after {instance}"
        )
        if constant and not outcome.success:
            what = f"the failed {instance}"
            _require_same(before, outcome.observation, "failures change nothing", what)
        before = outcome.observation


def _check_close(make: Factory, seed: int) -> None:
    environment = make()
    environment.reset(seed=seed)
    for number in ("first", "second"):
        try:
            environment.close()
        except Exception as error:
            message = f"expected the {number} close to pass, got {error!r}"
            raise ConformanceError("close", message) from error


def _reset(seed: int, scene: str, environment: Environment) -> None:
    environment.reset(seed=seed, scene=scene)


def _execute(instance: SkillInstance, environment: Environment) -> None:
    environment.execute(instance)


def _require_error(
    kind: type[Exception],
    check: str,
    what: str,
    call: Callable[[Environment], object],
    environment: Environment,
) -> None:
    """The call must raise an error of the kind."""
    try:
        call(environment)
    except kind:
        return
    except Exception as error:
        message = f"expected {kind.__name__} from {what}, got {error!r}"
        raise ConformanceError(check, message) from error
    raise ConformanceError(check, f"expected {kind.__name__} from {what}, got no error")


def _require_same(expected: Observation, got: Observation, check: str, what: str) -> None:
    require(
        expected.key == got.key,
        check,
        f"expected the same pictures as before from {what}, got others "
        f"({expected.key[:8]}, then {got.key[:8]})",
    )


def _picture_format(png: bytes) -> str:
    try:
        with Image.open(io.BytesIO(png)) as image:
            image.load()
            return image.format or "an unknown format"
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError):
        return "no picture"
