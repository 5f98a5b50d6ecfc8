"""What ``skillwrapper new`` writes runs as it is."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from command_line import command

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.starting import start_project
from skillwrapper.errors import ConfigurationError, UserError
from skillwrapper.files.yaml_documents import YamlDocument
from skillwrapper.world.domain_file import DomainFile


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    before = Path.cwd()
    os.chdir(tmp_path)
    yield tmp_path
    os.chdir(before)


def test_project_keeps_the_rules_and_says_how_skills_went(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("new", "cubes") == 0
    for level in ("robot", "simulator"):
        capsys.readouterr()
        assert command("check", "cubes", "--level", level, "--json") == 0
        found = json.loads(capsys.readouterr().out)
        assert found["kept_rules_of"] == level
        assert found["picture_sizes"] == {"main": [260, 160]}
        assert sum(skill["runs"] for skill in found["skills"].values()) >= 40
    assert command("check", "cubes", "--steps", "1") == 0
    assert "was not tried" in capsys.readouterr().out


def test_pictures_of_another_size_are_named(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("new", "cubes") == 0
    robot = folder / "cubes" / "robot.py"
    shrinking = "return self.arm.photo()[: 160 - 20 * self.arm.is_open]"
    robot.write_text(robot.read_text().replace("return self.arm.photo()", shrinking))
    assert command("check", "cubes", "--level", "robot") == 1
    assert "expected pictures of 'main' of 260 x 160 pixels" in capsys.readouterr().err


def test_nothing_is_overwritten(folder: Path) -> None:
    (folder / "mine").mkdir()
    (folder / "mine" / "notes.txt").write_text("keep")
    with pytest.raises(UserError, match="new or empty folder"):
        start_project(folder / "mine")
    assert [file.name for file in (folder / "mine").iterdir()] == ["notes.txt"]


@pytest.mark.parametrize("name", ["my robot", "7of9", "été", "-x", "a.b"])
def test_any_folder_gives_a_name_that_a_domain_may_have(folder: Path, name: str) -> None:
    start_project(folder / name)
    find_domain(str(folder / name))


def test_schema_knows_the_keys_and_the_names_that_the_file_may_have(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command("schema") == 0
    schema = json.loads(capsys.readouterr().out)
    assert set(schema["properties"]) == set(DomainFile.model_fields)
    assert schema["additionalProperties"] is False
    (names,) = schema["properties"]["skills"]["patternProperties"]
    assert schema["properties"]["skills"]["additionalProperties"] is False
    wrong = folder / "domain.yaml"
    wrong.write_text("name: a b\n")
    assert names.startswith("^[A-Za-z]")
    with pytest.raises(ConfigurationError, match=":1: 'name'"):
        YamlDocument.read(wrong).validate(DomainFile)
