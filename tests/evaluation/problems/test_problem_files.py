"""Starts and goals of every kind, and what is said of each that is not one."""

from __future__ import annotations

from pathlib import Path

import pytest
from lamp_shop import write_lamp_shop
from PIL import Image

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import UserError
from skillwrapper.evaluation.problems.problem_files import read_problems, write_problems
from skillwrapper.evaluation.problems.problem_generator import ProblemGenerator
from skillwrapper.evaluation.problems.problem_world import ProblemWorld
from skillwrapper.evaluation.problems.problems import Problem
from skillwrapper.world.capabilities import Enumerable, require
from skillwrapper.world.environment import Environment

PROBLEMS = """\
domain: shop
problems:
- name: one
  class: easy
  scene: shelf
  seed: 3
  goal_picture: lit.png
  goal_literals: lit(red)
  goal_test: all_lit
- name: two
  class: hard
  layout: 4
  initial: {state: [red]}
  goal: {state: [blue, red]}
"""


@pytest.fixture
def shop(tmp_path: Path) -> DomainPackage:
    return find_domain(str(write_lamp_shop(tmp_path / "shop")))


@pytest.fixture
def environment(shop: DomainPackage) -> Environment:
    return shop.make_environment()


@pytest.fixture
def file(tmp_path: Path) -> Path:
    Image.new("RGB", (90, 30)).save(tmp_path / "lit.png")
    (tmp_path / "problems.yaml").write_text(PROBLEMS)
    return tmp_path / "problems.yaml"


def test_written_and_read_again_with_its_pictures(
    file: Path, environment: Environment, tmp_path: Path
) -> None:
    problems = read_problems(file, environment)
    one, two = problems.problems
    assert (one.scene, one.layout, one.initial, one.goal) == ("shelf", 3, None, None)
    assert one.goal_picture is not None
    assert (two.scene, two.initial) == (None, {"state": ["red"]})
    write_problems(problems, tmp_path / "elsewhere" / "copy.yaml")
    assert read_problems(tmp_path / "elsewhere" / "copy.yaml", environment) == problems


MISTAKES = (
    ("scene: shelf", "scene: shlef", r":5: unknown scene 'shlef'; did you mean 'shelf'\?"),
    ("goal_test: all_lit", "goal_test: al_lit", r":9: unknown test 'al_lit'"),
    ("lit.png", "none.png", r":7: .*none\.png"),
    ("lit(red)", "'and (lit(red)'", r":8: goal, line 1"),
    ("[blue, red]}", "[blue, 7]}", r":14: expected the description of a state"),
    ("  goal: {state: [blue, red]}\n", "", r":10: .*expected what is wanted"),
    ("seed: 3", "seed: -3", r":6: .*greater than or equal to 0, got -3"),
    ("class: hard", "class: impossible", r":10: .*expected a reason"),
    ("name: two", "name: one", r":10: expected different names, got 'one' twice"),
)


@pytest.mark.parametrize(("old", "new", "message"), MISTAKES)
def test_mistakes_are_told_with_their_line(
    file: Path, environment: Environment, old: str, new: str, message: str
) -> None:
    file.write_text(PROBLEMS.replace(old, new))
    with pytest.raises(UserError, match=message):
        read_problems(file, environment)


@pytest.mark.parametrize("name", ["passwd", "secrets.yaml", "broken.yml"])
def test_nothing_of_another_file_is_quoted(
    name: str, environment: Environment, tmp_path: Path
) -> None:
    """Fault 17: an experiment file may name any file; what it holds is nobody's business."""
    path = tmp_path / name
    path.write_text(
        "password: hunter2\nhunter2: {x\n" if "broken" in name else "hunter2: hunter2\n"
    )
    with pytest.raises(UserError) as caught:
        read_problems(path, environment)
    assert "hunter2" not in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_robot_that_tells_no_states_needs_none(tmp_path: Path) -> None:
    bare = find_domain(str(write_lamp_shop(tmp_path / "bare", robot="Bare"))).make_environment()
    (tmp_path / "p.yaml").write_text(
        PROBLEMS[: PROBLEMS.index("  goal_test")].replace("  goal_picture: lit.png\n", "")
    )
    (problem,) = read_problems(tmp_path / "p.yaml", bare).problems
    world = ProblemWorld(bare)
    assert world.start(problem).state is None
    assert (world.goal(problem), world.is_reached(problem)) == (None, None)
    (tmp_path / "p.yaml").write_text(PROBLEMS.replace("  goal_picture: lit.png\n", ""))
    with pytest.raises(UserError, match=r"p\.yaml:8: shop: 'goal_test' needs an environment"):
        read_problems(tmp_path / "p.yaml", bare)


def problem(shop: DomainPackage, **changes: object) -> tuple[ProblemWorld, Problem]:
    world = ProblemWorld(shop.make_environment(), shop.system_predicates)
    entry = {"name": "p", "kind": "easy", "layout": 1, "initial": None, "goal": None}
    return world, Problem(**{**entry, **changes})  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "goal",
    [
        {"goal": {"state": ["green"]}},
        {"goal_test": "all_lit"},
        {"goal_literals": "lit(green)"},
    ],
)
def test_the_environment_says_whether_a_goal_is_reached(
    shop: DomainPackage, goal: dict[str, object]
) -> None:
    world, asked = problem(shop, scene="window", **goal)
    start = world.start(asked)
    assert start.state == frozenset()
    assert world.is_reached(asked) is False
    (light, _) = [
        i for i in shop.domain.skill_instances if str(i) in ("Light(green)", "PutOut(green)")
    ]
    world.environment.execute(light)
    assert world.is_reached(asked) is True


def test_words_that_are_no_facts_are_not_judged(shop: DomainPackage) -> None:
    world, asked = problem(shop, scene="window", goal_literals="shining(green)")
    world.start(asked)
    assert world.is_reached(asked) is None


def test_problems_are_made_for_any_domain_that_lists_its_states(shop: DomainPackage) -> None:
    environment = require(shop.make_environment(), Enumerable, "a test")
    environment.reset(seed=0, scene="shelf")
    made = ProblemGenerator(environment, shop, seed=1).generate(3, 0, 0)
    assert {p.scene for p in made.problems} == {"shelf"}
    assert [p.length for p in made.problems] == [1, 2, 2]  # the longest there are
