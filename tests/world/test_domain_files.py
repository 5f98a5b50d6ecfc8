"""Mistakes in domain.yaml are told with file, line and what was expected."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.errors import ConfigurationError, UnknownNameError, UserError
from skillwrapper.world import Scene, SkillInstance, load_domain

GOOD = """\
name: kitchen
agent: A robot.
description: A table.
types:
  robot: {}
  food: {}
  fruit:
    parents: [food]
objects:
  arm:
    types: [robot]
  apple:
    types: [fruit]
    description: red
skills:
  Take:
    description: Takes it.
    parameters:
      - {name: robot, type: robot, role: acts}
      - {name: food, type: food}
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "domain.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_good_file_is_read(tmp_path: Path) -> None:
    domain = load_domain(written(tmp_path, GOOD))
    assert domain.name == "kitchen"
    assert not domain.failures_change_nothing
    assert domain.object_by_name["apple"].types == ("food", "fruit")
    assert domain.skill_by_name["Take"].signature == "Take(robot, food)"
    assert domain.skill_instances == (SkillInstance("Take", ("arm", "apple")),)
    assert domain.scene() == domain.scenes["default"] == Scene("default", domain.objects)


SCENES = "scenes:\n  full: [apple, arm]\n  bare:\n  - arm\n"


def test_scenes_name_sets_of_objects(tmp_path: Path) -> None:
    domain = load_domain(written(tmp_path, GOOD + SCENES))
    assert list(domain.scenes) == ["full", "bare"]
    assert domain.scene().names == ("arm", "apple")  # in the domain's order
    assert domain.scene("bare").objects == domain.objects[:1]
    with pytest.raises(UnknownNameError, match="unknown scene 'bear'; did you mean 'bare'"):
        domain.scene("bear")
    take = SkillInstance("Take", ("arm", "apple"))
    domain.check_instance(take, domain.scene("full"))
    with pytest.raises(UnknownNameError, match="unknown object 'apple'"):
        domain.check_instance(take, domain.scene("bare"))


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("[apple, arm]", "[aple, arm]", 22, "in scene 'full' 'aple'; did you mean 'apple'?"),
        ("  - arm", "  - arm\n  - leg", 25, "unknown object in scene 'bare' 'leg'"),
        ("[apple, arm]", "[]", 22, "expected scene 'full' to name at least one object"),
        ("[apple, arm]", "[arm, arm]", 22, "and each once"),
        ("[apple, arm]", "apple", 22, "'scenes.full': expected a list"),
    ],
)
def test_mistake_in_a_scene_is_named_with_its_line(
    tmp_path: Path, old: str, new: str, line: int, message: str
) -> None:
    path = written(tmp_path, (GOOD + SCENES).replace(old, new))
    with pytest.raises(UserError) as caught:
        load_domain(path)
    assert str(caught.value).startswith(f"{path}:{line}: ")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("agent: A robot.\n", "", 1, "expected a value for 'agent', got none"),
        ("agent:", "agnet:", 2, "did you mean 'agent'?"),
        ("name: kitchen", "name: 3 kitchens", 1, "'name': expected a letter, then letters"),
        ("parents: [food]", "parents: [foot]", 8, "unknown type 'foot'; did you mean 'food'"),
        ("parents: [food]", "parents: food", 8, "expected a list, got 'food'"),
        ("    types: [fruit]", "    types: []", 13, "at least 1 of them"),
        ("    types: [fruit]", "    types: [fruits]", 13, "unknown type 'fruits'"),
        ("name: food, type: food", "name: food, type: fod", 20, "unknown type 'fod'"),
        ("name: food, type: food", "name: robot, type: food", 18, "have the same name"),
        ("    description: red", "    colour: red", 14, "unknown key 'objects.apple.colour'"),
        ("  food: {}", "  food:\n    parents: [fruit]", 4, "the types form a cycle"),
        ("types:\n  robot", "types: [\n  robot", 6, "expected valid YAML"),
    ],
)
def test_mistake_is_named_with_its_line(
    tmp_path: Path, old: str, new: str, line: int, message: str
) -> None:
    assert old in GOOD
    path = written(tmp_path, GOOD.replace(old, new, 1))
    with pytest.raises(UserError) as caught:
        load_domain(path)
    assert str(caught.value).startswith(f"{path}:{line}: ")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "both"),
    [
        ("  arm:\n", "  Apple:\n", "objects 'Apple' and 'apple'"),
        ("  arm:\n", "  APPLE:\n", "objects 'APPLE' and 'apple'"),
        ("  fruit:\n", "  Food:\n", "types 'food' and 'Food'"),
        ("  robot: {}\n", "  robot: {}\n  ROBOT: {}\n", "types 'robot' and 'ROBOT'"),
        ("skills:\n", "skills:\n  take: {parameters: []}\n", "skills 'take' and 'Take'"),
    ],
)
def test_names_that_differ_in_case_only_are_refused(
    tmp_path: Path, old: str, new: str, both: str
) -> None:
    """Planners read all names in lower case: one plan would mean two things."""
    text = GOOD.replace("[fruit]", "[food]") if "Food" in new else GOOD
    path = written(tmp_path, text.replace(old, new, 1))
    with pytest.raises(ConfigurationError, match=r"domain\.yaml:\d+: .*rename one$") as caught:
        load_domain(path)
    assert both in str(caught.value)


def test_an_object_may_be_called_like_its_type_or_a_skill(tmp_path: Path) -> None:
    domain = load_domain(written(tmp_path, GOOD.replace("  apple:", "  TAKE:")))
    assert "TAKE" in domain.object_by_name


@pytest.mark.parametrize("name", ["", "a b", "a,b", "a\\nb", "a(b)", "a)", "?a", "1a", "a.b", "ä"])
@pytest.mark.parametrize("old", ["  robot:", "  arm:", "  Take:", "name: food,", "  full:"])
def test_names_that_no_reply_can_carry_are_refused(tmp_path: Path, old: str, name: str) -> None:
    """Fault 17 of the list of faults found by use."""
    text = GOOD + SCENES
    assert old in text
    new = f'name: "{name}",' if old.startswith("name") else f'  "{name}":'
    path = written(tmp_path, text.replace(old, new, 1))
    with pytest.raises(ConfigurationError, match=r"domain\.yaml:\d+: .*: expected a letter, "):
        load_domain(path)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="cannot be read"):
        load_domain(tmp_path / "domain.yaml")


def test_other_encoding_is_named(tmp_path: Path) -> None:
    path = tmp_path / "domain.yaml"
    path.write_bytes(b"name: k\xfcche\n")
    with pytest.raises(ConfigurationError, match="expected UTF-8"):
        load_domain(path)


@pytest.mark.parametrize(
    ("instance", "error"),
    [
        (SkillInstance("Drop", ("arm", "apple")), UnknownNameError),
        (SkillInstance("Take", ("arm", "pear")), UnknownNameError),
        (SkillInstance("Take", ("arm",)), ConfigurationError),
        (SkillInstance("Take", ("apple", "arm")), ConfigurationError),
        (SkillInstance("Take", ("arm", "arm")), ConfigurationError),
    ],
)
def test_instance_that_does_not_exist_is_refused(
    tmp_path: Path, instance: SkillInstance, error: type[Exception]
) -> None:
    domain = load_domain(written(tmp_path, GOOD))
    domain.check_instance(SkillInstance("Take", ("arm", "apple")))
    with pytest.raises(error):
        domain.check_instance(instance)
