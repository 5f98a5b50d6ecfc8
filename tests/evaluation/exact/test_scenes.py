"""A domain of two scenes is verified in each and in both together."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lamp_shop import write_lamp_shop
from typer.testing import CliRunner, Result

from skillwrapper.cli.main import app
from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError, LimitReachedError, UnknownNameError
from skillwrapper.evaluation.exact.exact_states import ExactStates, scene_states
from skillwrapper.evaluation.exact.run_checks import CheckOptions, LabelSource, check_run
from skillwrapper.evaluation.exact.verdicts import Verdict
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.launch import learn
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import AbstractModel, Atom, Literal, Operator, Predicate, Variable

LIT = Predicate("lit", ("lamp",), "The lamp is lit.")


def operator(skill: str, kind: str) -> Operator:
    lamp, lit = Variable("?lamp", (kind,)), Atom("lit", ("?lamp",))
    lights = skill == "Light"
    return Operator(
        name=skill,
        skill=skill,
        parameters=(lamp,),
        arity=1,
        absences=frozenset(),
        preconditions=frozenset({Literal(lit, not lights)}),
        add_effects=frozenset({lit} if lights else ()),
        delete_effects=frozenset(() if lights else {lit}),
    )


def check(folder: Path, kind: str) -> Verification:
    package = find_domain(str(write_lamp_shop(folder)))
    model = AbstractModel(
        package.domain, (LIT,), (operator("Light", kind), operator("PutOut", kind))
    )
    return verify(ExactStates.of(package).told(), model)


def test_a_model_that_is_right_everywhere(tmp_path: Path) -> None:
    found = check(tmp_path / "shop", "lamp")
    assert found.scenes == ("shelf", "window")
    assert [part.states for part in found.parts] == [4, 2]
    assert (found.states, found.pairs, found.total.successes) == (6, 20, 10)
    assert found.precision == found.recall == found.effect_accuracy == 1.0
    assert found.vocabulary is not None
    assert (found.vocabulary.varying, found.vocabulary.share) == (3, 1.0)
    assert found.verdicts.sound is found.verdicts.complete is Verdict.HOLDS


def test_a_model_that_is_right_in_one_scene_only(tmp_path: Path) -> None:
    found = check(tmp_path / "shop", "bulb")
    shelf, window = found.parts
    assert (shelf.recall, window.recall, found.recall) == (1.0, 0.0, 0.8)
    assert (shelf.precision, window.precision, found.precision) == (1.0, None, 1.0)
    sound = (shelf.verdicts.sound, window.verdicts.sound, found.verdicts.sound)
    assert sound == (Verdict.HOLDS, Verdict.UNDEFINED, Verdict.HOLDS)
    assert found.verdicts.complete is Verdict.FAILS
    assert {example.scene for example in found.counterexamples} == {"window"}
    data = json.loads(json.dumps(found.to_json()))
    assert data["scenes"]["window"]["precision"] is None
    assert data["scenes"]["window"]["sound"] is None
    assert data["scenes"]["shelf"]["recall"] == 1.0


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A finished run in both scenes, from a folder."""
    place = tmp_path_factory.mktemp("lamps")
    domain = write_lamp_shop(place / "shop")
    exploration = ExplorationSettings(budget=8)
    learn(RunSettings(domain=str(domain), iterations=4, exploration=exploration), place / "run")
    return place / "run"


def invoke(*arguments: str | Path) -> Result:
    return CliRunner().invoke(app, [str(a) for a in arguments], catch_exceptions=False)


def test_verify_says_who_labelled_and_where(run: Path) -> None:
    data = json.loads(invoke("verify", run, "--json").stdout)
    assert data["labels"] == "true"
    assert set(data["scenes"]) == {"shelf", "window"}
    assert data["precision"] == data["recall"] == data["effect_accuracy"] == 1.0
    assert data["vocabulary"] == {"share": 1.0, "varying": 3, "undetermined": []}
    shown = invoke("verify", run, "--labels", "model")
    assert "labels read by the run's own model" in shown.stdout
    assert "scene window" in shown.stdout
    one = json.loads(invoke("verify", run, "--scene", "window", "--json").stdout)
    assert (one["states"], one["scene"]) == (2, "window")


def test_calls_are_limited(run: Path) -> None:
    options = CheckOptions(LabelSource.MODEL, max_calls=1)
    with pytest.raises(LimitReachedError):
        check_run(RunArchive.open(run), options)
    assert check_run(RunArchive.open(run), CheckOptions(max_calls=0)).verification.recall == 1.0


def test_unknown_scene(run: Path) -> None:
    with pytest.raises(UnknownNameError, match="unknown scene 'windw'; did you mean 'window'"):
        check_run(RunArchive.open(run), CheckOptions(scenes=("windw",)))


def test_true_labels_need_somebody_who_knows(run: Path) -> None:
    domain = Path(RunArchive.open(run).settings().domain) / "domain.yaml"
    before = domain.read_text()
    domain.write_text(before.replace("scene_reader: shop.py:read_lamps\n", ""))
    try:
        with pytest.raises(ConfigurationError, match="--labels true needs a 'scene_reader'"):
            check_run(RunArchive.open(run), CheckOptions(LabelSource.TRUE))
    finally:
        domain.write_text(before)


def test_states_that_nobody_lists(run: Path, tmp_path: Path) -> None:
    bare = find_domain(str(write_lamp_shop(tmp_path / "bare", robot="Bare")))
    assert scene_states(bare) == ()
    domain = Path(RunArchive.open(run).settings().domain) / "domain.yaml"
    before = domain.read_text()
    domain.write_text(before.replace("shop.py:Shop", "shop.py:Bare"))
    try:
        with pytest.raises(ConfigurationError, match="exact verification needs an environment"):
            check_run(RunArchive.open(run), CheckOptions())
    finally:
        domain.write_text(before)
