import json
import shutil
from pathlib import Path

import pytest
from outside_links import parse

from skillwrapper.errors import FileError, RunFolderError
from skillwrapper.report import ReportSettings, render_report, write_report
from skillwrapper.runs.archive import RunArchive, make_archive
from skillwrapper.runs.settings import RunSettings
from skillwrapper.usage import Usage
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_call import CallStatus, StoredCall


@pytest.fixture(scope="module")
def page(run: RunArchive) -> str:
    return render_report(run)


@pytest.fixture
def copy(run: RunArchive, tmp_path: Path) -> RunArchive:
    shutil.copytree(run.path, tmp_path / "run")
    return RunArchive(tmp_path / "run")


def test_the_page_needs_nothing_from_outside(page: str) -> None:
    parsed = parse(page)
    assert parsed.found == []
    assert "script" not in parsed.tags
    assert "link" in parsed.tags  # the empty icon, or else a browser asks for /favicon.ico
    assert parsed.tags["img"] > 5


def test_the_parser_would_find_what_is_loaded() -> None:
    bad = '<style>@import "x.css"; p {background: url(a.png)}</style><img src="a.png"><a href="#b">'
    assert len(parse(bad).found) == 2
    assert parse('<p style="background:url(http://x)">').found


def test_links_lead_to_sections(page: str) -> None:
    parsed = parse(page)
    assert parsed.targets <= parsed.ids
    assert len(parsed.targets) == 7


def test_everything_learned_is_on_the_page(run: RunArchive, page: str) -> None:
    text = " ".join("".join(parse(page).texts).split())
    learned = run.latest()
    for predicate in learned.model.predicates:
        assert predicate.signature in text
        assert predicate.semantics in text
    for operator in learned.model.operators:
        assert operator.name in text
        assert f"(:action {operator.name.lower()}" in text.lower()
    assert "Made with the embedded model in every role (noise: gpt5)" in text
    assert len(learned.unresolved) == page.count('class="unresolved"')
    assert str(run.settings().exploration.budget) in text


def test_equal_folders_give_equal_pages(run: RunArchive, page: str) -> None:
    assert render_report(run) == page


def test_fewer_episodes_and_smaller_pictures_make_a_smaller_page(
    run: RunArchive, page: str
) -> None:
    small = render_report(run, ReportSettings(picture_width=64, episodes=1))
    assert len(small) < len(page) * 0.6
    assert "Shown are the 1 of 3 episodes" in small


def test_the_page_is_written_into_the_run_by_default(copy: RunArchive) -> None:
    assert write_report(copy) == copy.path / "report.html"
    assert (copy.path / "report.html").read_text().startswith("<!DOCTYPE html>")


def test_a_missing_picture_is_named(copy: RunArchive) -> None:
    """A picture that only the description of an inconsistency names."""
    path = copy.layout.iteration(3) / "unresolved.json"
    case = {
        "kind": "unexplained",
        "skill": "Pick",
        "unexplained": ["<b>(lettuce)"],
        "witnesses": [
            {
                "transition": 0,
                "instance": "Pick(robot, patty)",
                "success": True,
                "before": ["f" * 64],
                "after": [],
            }
        ],
    }
    path.write_text(json.dumps([case]))
    page = render_report(copy)
    assert "picture ffffffffffff is missing" in page
    assert "<b>(lettuce)" not in page


def test_calls_that_were_not_recorded_are_said_to_be_unknown(copy: RunArchive) -> None:
    copy.layout.calls.unlink()
    assert "what it cost is unknown" in render_report(copy)


def test_one_unknown_cost_makes_the_sum_unknown(copy: RunArchive) -> None:
    call = StoredCall(
        key="k", question="q", status=CallStatus.ANSWERED, role=Role.ACT, iteration=1, model="m",
        parameters="{}", repetition=0, system="", prompt="p", pictures=(), reply="r",
        usage=Usage(1, 1, None, 1.0),
    )  # fmt: skip
    with CallStore(copy.layout.calls) as store:
        store.add(call)
    row = render_report(copy).split("<tfoot>")[1].split("</tfoot>")[0]
    assert row.rstrip().endswith('<span class="unknown">unknown</span></td></tr>')


def test_an_exact_curve_is_drawn_if_there_is_one(copy: RunArchive) -> None:
    curve = [{"executions": 20, "recall": 0.25}, {"executions": 60, "recall": 0.75}]
    (copy.path / "curve.json").write_text(json.dumps(curve))
    assert "Exact truth: at the end recall 75%" in render_report(copy)


def test_a_curve_that_is_none_is_refused(copy: RunArchive) -> None:
    (copy.path / "curve.json").write_text('{"recall": 1}')
    with pytest.raises(FileError, match=r"curve\.json:1: .*expected a list"):
        render_report(copy)


def test_a_run_without_a_finished_iteration_is_refused(tmp_path: Path, run: RunArchive) -> None:
    config = RunSettings(domain="burger")
    empty = make_archive(tmp_path / "new", config, run.domain())
    with pytest.raises(RunFolderError, match="no iteration is finished"):
        render_report(empty)
