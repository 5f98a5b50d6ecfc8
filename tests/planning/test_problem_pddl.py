"""Problems in PDDL: three readers take them, and planners find in them what we find.

Whatever the names: those of atoms, actions and helpers share one namespace in some planners.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from kstar_planner import planners
from named_forest import WORDS, everywhere, forest, in_turn, printed
from pddl_readers import (
    Texts,
    read_with_pddl_library,
    read_with_translator,
    read_with_unified_planning,
)
from unified_planning.shortcuts import OneshotPlanner, get_environment

from skillwrapper.errors import FileError
from skillwrapper.grounding import GroundModel
from skillwrapper.planning import KStar, Planner, PlanningProblem, PlanningStatus, write_pddl
from skillwrapper.symbols import AbstractModel, Atom, Literal

HELPERS = ("action-0", "open", "finish", "done", "scene", "now")


def one_step(model: AbstractModel) -> PlanningProblem:
    """The problem that ``printed`` prints, which one step solves unless the forest is hot."""
    ground = GroundModel.of(model, model.domain.objects)
    unary, binary = (p.name for p in model.predicates)
    one, two, _ = (o.name for o in model.domain.objects)
    row = np.zeros(len(ground.space.atoms), dtype=np.int8)
    row[ground.space.column[Atom(unary, (one,))]] = 1
    goal = (Literal(Atom(binary, (one, two))), Literal(Atom(unary, (two,)), False))
    return PlanningProblem.of(ground, row, goal)


def texts(problem: PlanningProblem, folder: Path) -> Texts:
    files = write_pddl(problem, folder)
    return files.domain.read_text(encoding="utf-8"), files.problem.read_text(encoding="utf-8")


def named(word: str) -> AbstractModel:
    """A model that the planners have work with, its predicates, objects and operator so named."""
    rest = (word, f"{word}_2", word, f"{word}-2", word)
    return forest(("animal", "bird", "wet"), rest, hot=False)


@pytest.mark.parametrize("word", [*HELPERS, "and", "object", "not"])
def test_readers_take_ground_problems(word: str, tmp_path: Path) -> None:
    asked = one_step(named(word))
    assert asked.actions
    domain, problem = read_with_pddl_library(texts(asked, tmp_path))
    assert len(domain.actions) == len(asked.actions) + 1
    assert str(problem.domain_name) == "scene"
    read_with_unified_planning(texts(asked, tmp_path))


def test_the_translator_takes_ground_problems(tmp_path: Path) -> None:
    models = [*map(in_turn, range(0, len(WORDS), 2)), *map(named, HELPERS)]
    read_with_translator([texts(one_step(model), tmp_path) for model in models])


@pytest.mark.parametrize("word", ["thing", "and", "action-0"])
def test_planners_agree_whatever_the_names(
    word: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """K* by its own front end on the ground problem, Fast Downward on the lifted one, and we."""
    monkeypatch.chdir(tmp_path)  # they leave files behind
    model = named(word)
    asked = one_step(model)
    result = Planner().solve(asked)
    assert [len(plan) for plan in result.plans[:1]] == [1]
    assert {i.skill for plan in result.plans for i in plan} == {word}
    files = write_pddl(asked, tmp_path)
    found = planners.plan_topk(files.domain, files.problem, 3, timeout=30)["plans"]
    ours = KStar.installed().search(asked, 3, 30.0).plans
    assert [plan["cost"] for plan in found] == [len(plan) + 1 for plan in ours]
    get_environment().credits_stream = None
    with warnings.catch_warnings(), OneshotPlanner(name="fast-downward") as planner:
        warnings.simplefilter("ignore")
        lifted = planner.solve(read_with_unified_planning(printed(model)))
    assert len(lifted.plan.actions) == 1


def test_folder_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way", encoding="utf-8")
    with pytest.raises(FileError, match="file"):
        Planner().solve(one_step(named("on")), keep_files=tmp_path / "file")


def test_unsolvable_whatever_the_names() -> None:
    assert Planner().solve(one_step(everywhere("and"))).status is PlanningStatus.UNSOLVABLE
