"""A domain is found wherever it lies, and what is wrong with it is told in one sentence."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from tea_world import DOMAIN, DRAWING, ROBOT, SMALLEST, write_tea_world

import skillwrapper
from skillwrapper.domains.discovery import bundled_domains, bundled_names, domain_names, find_domain
from skillwrapper.domains.package import DomainPackage
from skillwrapper.errors import ConfigurationError, UnknownNameError, UserError
from skillwrapper.world import SkillInstance
from skillwrapper.world.conformance import check_environment


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return write_tea_world(tmp_path / "tea")


def assert_works(package: DomainPackage, reference: str) -> None:
    """The package keeps its reference, and is found again by it."""
    assert package.reference == reference
    assert package.domain.name == "tea"
    environment = find_domain(package.reference).make_environment()
    environment.reset(seed=0)
    assert environment.execute(SkillInstance("Fill", ("hand", "mug"))).success


def test_bundled_domain_is_found_by_its_name() -> None:
    assert "burger" in bundled_names()
    for package in bundled_domains():
        assert package.reference == package.domain.name
        environment = package.make_environment()
        assert environment.domain == package.domain


@pytest.mark.parametrize("given", ["tea", "./tea", "tea/domain.yaml", "{tmp}/tea"])
def test_folder_is_found_by_its_path(
    folder: Path, given: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The reference is absolute, so that the domain is found from anywhere."""
    monkeypatch.chdir(folder.parent)
    package = find_domain(given.format(tmp=folder.parent))
    monkeypatch.chdir("/")
    assert_works(package, str(folder / "domain.yaml" if given.endswith("yaml") else folder))


def test_domain_of_a_folder_keeps_all_rules(folder: Path) -> None:
    check_environment(find_domain(str(folder)).make_environment)


def test_robot_of_a_folder_is_an_environment(tmp_path: Path) -> None:
    package = find_domain(str(write_tea_world(tmp_path, robot=SMALLEST)))
    check_environment(package.make_environment)
    assert_works(package, str(tmp_path))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("def run", "def runn", "robot.py:TeaWorld lacks run; expected a Robot, a Simulator or an"),
        ("Robot)", "Robto)", r"robot.py:5: AttributeError: .*'Robto'"),
        ("(skillwrapper.Robot)", "", "robot.py:TeaWorld lacks reset, execute, observe, close; exp"),
    ],
)
def test_mistakes_in_a_robot_are_told(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in SMALLEST
    folder = write_tea_world(tmp_path, robot=SMALLEST.replace(old, new))
    with pytest.raises(ConfigurationError, match=message):
        find_domain(str(folder)).make_environment()


@pytest.fixture
def installed(folder: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The folder as an installed Python package of a name of its own."""
    name = f"tea_{folder.parent.name}".replace("-", "_")
    folder.rename(folder.with_name(name))
    text = "from pathlib import Path\n\nworld = Path(__file__).parent\nnumber = 3\n"
    folder.with_name(name).joinpath("__init__.py").write_text(text)
    monkeypatch.syspath_prepend(str(folder.parent))
    return name


def test_domain_is_found_in_a_module(installed: str) -> None:
    assert_works(find_domain(f"{installed}:world"), f"{installed}:world")
    with pytest.raises(UnknownNameError, match=r"unknown name in tea_.* 'wrld'; did you mean 'wor"):
        find_domain(f"{installed}:wrld")
    with pytest.raises(ConfigurationError, match="expected the path of a domain's folder, got a i"):
        find_domain(f"{installed}:number")
    with pytest.raises(ConfigurationError, match="no module 'tea_of_nobody' is installed"):
        find_domain("tea_of_nobody:world")


@pytest.mark.parametrize("value", ["{}:world", "{}"])
def test_domain_is_found_by_its_entry_point(installed: str, tmp_path: Path, value: str) -> None:
    info = tmp_path / "tea_world-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: tea-world\nVersion: 1.0\n")
    points = f"[skillwrapper.domains]\nteatime = {value.format(installed)}\nlost = nowhere_at_all\n"
    (info / "entry_points.txt").write_text(points)
    assert {"burger", "teatime"} <= set(domain_names())
    assert_works(find_domain("teatime"), "teatime")
    with pytest.raises(ConfigurationError, match="'lost': nowhere_at_all cannot be loaded"):
        find_domain("lost")


def test_nothing_is_left_behind(folder: Path) -> None:
    """Files beside a robot are found by their short names while it is loaded, and only then."""
    path, finders = list(sys.path), list(sys.meta_path)
    assert find_domain(str(folder)).make_environment()
    assert (sys.path, sys.meta_path) == (path, finders)
    assert "drawing" not in sys.modules


def test_files_of_one_name_do_not_meet(folder: Path, tmp_path: Path) -> None:
    """Two domains may each have a robot.py and a drawing.py."""
    other = "def draw(names, full):\n    return b'other'\n"
    second = write_tea_world(tmp_path / "other", drawing=other)
    pictures = []
    for place in (folder, second, folder):
        environment = find_domain(str(place)).make_environment()
        pictures.append(environment.reset(seed=0).pictures[0].png)
    assert pictures[0] == pictures[2] != pictures[1] == b"other"


def test_files_may_be_imported_relatively_and_late(tmp_path: Path) -> None:
    late = ROBOT.replace("from drawing import draw\n", "").replace(
        "        return Observation",
        "        from .drawing import draw\n        return Observation",
    )
    folder = write_tea_world(tmp_path / "late", robot=late)
    assert find_domain(str(folder)).make_environment().reset(seed=0).pictures


MISTAKES = [
    ("domain", "TeaWorld", "TeaWrld", "domain.yaml:4: unknown name in robot.py 'TeaWrld'; did you"),
    ("domain", "robot.py", "robt.py", "domain.yaml:4: expected a file .*/robt.py, got none"),
    ("domain", "robot.py:", "", "domain.yaml:4: expected 'file.py:name' or .*, got 'TeaWorld'"),
    ("domain", "robot.py:", "../robot.py:", "domain.yaml:4: expected a file .*, got none"),
    ("domain", "robot: robot.py:TeaWorld", "", "domain.yaml: expected a key 'robot' for executing"),
    ("domain", "robot:", "robbot:", "domain.yaml:4: unknown key 'robbot'; did you mean 'robot'?"),
    ("domain", "[hand, mug]", "[hand, mgu]", "domain.yaml:17: .* in scene 'desk' 'mgu'; did you m"),
    ("robot", "def execute", "def exekute", "domain.yaml:4: robot.py:TeaWorld lacks execute"),
    ("robot", "self.domain =", "domain =", "domain.yaml:4: robot.py:TeaWorld lacks domain"),
    (
        "robot",
        "self.scene = domain.scene()",
        "pass",
        "domain.yaml:4: robot.py:TeaWorld lacks scene",
    ),
    ("robot", "self.full = None", "1 / 0", "robot.py:12: ZeroDivisionError: division by zero"),
    ("robot", "class TeaWorld:", "class TeaWorld", "robot.py:6: SyntaxError: expected ':'"),
    ("robot", "from drawing", "import mujocoo\nfrom drawing", "robot.py:1: .* module named 'mujoc"),
    ("robot", "class TeaWorld:", "TeaWorld = 3\n\nclass _:", "domain.yaml:4: expected a class or"),
    ("drawing", "def draw", "raise SystemExit(3)\ndef draw", r"drawing.py:6: SystemExit: 3"),
]


@pytest.mark.parametrize(("file", "old", "new", "message"), MISTAKES)
def test_mistakes_are_told_with_file_and_line(
    tmp_path: Path, file: str, old: str, new: str, message: str
) -> None:
    text = {"domain": DOMAIN, "robot": ROBOT, "drawing": DRAWING}[file]
    assert old in text
    folder = write_tea_world(tmp_path, **{file: text.replace(old, new)})
    with pytest.raises(UserError, match=message) as caught:
        find_domain(str(folder)).make_environment()
    assert "\n" not in str(caught.value)


def test_what_does_not_exist_is_named(tmp_path: Path) -> None:
    with pytest.raises(UnknownNameError, match="unknown domain 'burgr'; did you mean 'burger'"):
        find_domain("burgr")
    with pytest.raises(ConfigurationError, match=r"expected a domain.yaml in the folder of a dom"):
        find_domain(str(tmp_path))
    with pytest.raises(ConfigurationError, match=r"/nowhere: no such file or folder; expected a f"):
        find_domain(str(tmp_path / "nowhere"))


def test_no_other_room_names_a_bundled_domain() -> None:
    package = Path(skillwrapper.__file__).parent
    elsewhere = [p for p in package.rglob("*.py") if "domains" not in p.relative_to(package).parts]
    assert len(elsewhere) > 100
    for name in bundled_names():
        assert [p for p in elsewhere if name in p.read_text(encoding="utf-8").lower()] == []


def test_parts_that_are_missing_are_named(folder: Path) -> None:
    package = find_domain(str(folder))
    assert package.scene_reader is None
    assert package.words is None
    assert package.structure(object()) == ""
    assert package.impossibility.explain(0, 1)[0] in package.impossibility.kinds
    for part in ("expert", "system_predicates", "problems", "pairs", "published"):
        with pytest.raises(ConfigurationError, match=rf"domain.yaml: expected a key '{part}' for "):
            getattr(package, part)
        assert not package.has(part)


def test_parts_of_the_bundled_domain() -> None:
    burger = find_domain("burger")
    assert burger.scene_reader is not None
    assert burger.expert.model.domain == burger.domain
    assert burger.system_predicates
    assert burger.problems.is_file()
    assert burger.pairs.is_file()
    assert burger.impossibility.kinds
    chalk = burger.make_environment("chalk")
    usual = burger.make_environment()
    assert chalk.reset(seed=0).key != usual.reset(seed=0).key
    with pytest.raises(UnknownNameError, match="unknown drawing 'oil'; known: chalk"):
        burger.make_environment("oil")


def test_a_drawing_takes_the_place_of_the_robot() -> None:
    package = find_domain("burger@chalk")
    assert package.reference == "burger@chalk"
    assert find_domain(package.reference).entries.robot == package.entries.drawings["chalk"]
    with pytest.raises(UnknownNameError, match="did you mean 'chalk'"):
        find_domain("burger@chalks")
