from pathlib import Path

import pytest

from skillwrapper.errors import FileError
from skillwrapper.report.charts import LineChart, Series, round_steps
from skillwrapper.report.strips import Beyond, Cell, lay_out
from skillwrapper.runs.archive import RecordedLabels
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation, Picture
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@pytest.mark.parametrize(
    ("most", "steps"),
    [
        (0, (0, 1)),
        (1, (0, 1)),
        (4, (0, 1, 2, 3, 4)),
        (6, (0, 2, 4, 6)),
        (35, (0, 10, 20, 30, 40)),
        (300, (0, 100, 200, 300)),
    ],
)
def test_axes_have_round_marks(most: float, steps: tuple[int, ...]) -> None:
    assert round_steps(most) == steps


def test_a_curve_ends_in_the_upper_right_corner() -> None:
    chart = LineChart("t", (Series("s", ((0, 0), (75, 4))),))
    start, end = chart.dots(chart.series[0])
    assert (start.x, start.y) == (chart.left, chart.bottom)
    assert (end.x, end.y) == (chart.right, 12)
    assert chart.summary == "t: at the end s 4"


def test_a_truth_table_has_a_header_for_every_scene(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.write_text('observation,"on(a, b)"\nx,1\nobservation,free(c)\ny,?\nz,0\n')
    labels = RecordedLabels.read(path)
    assert labels.of("x") == {"on(a, b)": True}
    assert labels.of("y") == {"free(c)": None}
    assert labels.count("free") == {None: 1, False: 1}
    assert labels.of("unheard of") == {}


def test_a_damaged_truth_table_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "t.csv"
    path.write_text("observation,free(c)\ny,maybe\n")
    with pytest.raises(FileError, match=r"t\.csv:2: expected 1 labels of 1, 0 or \?"):
        RecordedLabels.read(path)


def _see(name: str) -> Observation:
    return Observation((Picture(name.encode()),))


def _did(before: str, skill: str, success: bool, after: str) -> Transition:
    return Transition(_see(before), SkillInstance(skill, ()), success, _see(after))


def test_failures_without_a_change_stand_over_the_next_picture() -> None:
    episode = Episode(
        Scene("empty", ()),
        0,
        (
            _did("a", "Cut", False, "a"),
            _did("a", "Pick", True, "b"),
            _did("b", "Drop", False, "c"),
            _did("c", "Cook", False, "c"),
        ),
    )
    rows = {
        _see("a").key: {"held()": False, "table()": True},
        _see("b").key: {"held()": None, "table()": True},
        _see("c").key: {"held()": True, "table()": True},
    }
    found = lay_out(1, episode, RecordedLabels(rows))
    moments = found.strips[0].moments
    assert [(m.skill, m.success, m.failed) for m in moments] == [
        ("", True, ()),
        ("Pick()", True, ("Cut()",)),
        ("Drop()", False, ()),
    ]
    assert found.last_failed == ("Cook()",)
    # Not knowing is no change; the next known value is compared with the last known one.
    cells = (Cell(False, False), Cell(None, False), Cell(True, True))
    assert found.strips[0].rows == (("held()", cells),)
    assert found.always == ("table()",)
    assert found.changes == 1


def test_what_is_overruled_is_shown_as_believed_beside_what_was_read() -> None:
    """It was read as held in the middle picture; decoding says no; in truth it never was."""
    steps = (_did("a", "Wave", True, "b"), _did("b", "Nod", True, "c"))
    episode = Episode(Scene("empty", ()), 0, steps)
    keys = [_see(name).key for name in "abc"]
    rows = {k: {"held()": held} for k, held in zip(keys, (False, True, True), strict=True)}
    truth = RecordedLabels({key: {"held()": False} for key in keys})
    beyond = Beyond(frozenset({(keys[1], "held()")}), truth)
    found = lay_out(1, episode, RecordedLabels(rows), beyond)
    assert found.strips[0].rows[0][1] == (
        Cell(False, False),
        Cell(False, False, read=True),
        Cell(True, True, wrong=True),
    )


def test_long_episodes_are_broken_into_strips() -> None:
    steps = tuple(_did(str(n), "Walk", True, str(n + 1)) for n in range(9))
    rows = {_see(str(n)).key: {"odd()": n % 2 == 1} for n in range(10)}
    found = lay_out(1, Episode(Scene("empty", ()), 0, steps), RecordedLabels(rows))
    assert [len(strip.moments) for strip in found.strips] == [7, 3]
    # The first column of the second strip still knows what came before it.
    assert found.strips[1].rows[0][1][0] == Cell(True, True)
    assert found.changes == 9
