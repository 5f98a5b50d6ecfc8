"""Edited models: taken if all that is recorded agrees, else refused with file and line."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
from benchmarks.kills import contents
from command_line import command
from cubes import learn_cubes

from skillwrapper.domains.burger.expert import expert_model
from skillwrapper.errors import RefusedModelError, UserError
from skillwrapper.learning.untested import find_tests
from skillwrapper.review.session import Review
from skillwrapper.runs.archive import RunArchive
from skillwrapper.runs.edited_domain import read_edited_domain
from skillwrapper.runs.imported_model import imported_note
from skillwrapper.runs.launch import learn_recorded
from skillwrapper.runs.model_import import import_model
from skillwrapper.runs.recollection import Recollection
from skillwrapper.symbols import AbstractModel, Atom, ConditionalEffect, Literal, Variable
from skillwrapper.symbols.files import predicates_to_yaml
from skillwrapper.symbols.pddl import print_domain


@pytest.fixture(scope="module")
def learned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return learn_cubes(tmp_path_factory.mktemp("edited"))


@pytest.fixture
def run(learned: Path, tmp_path: Path) -> RunArchive:
    return RunArchive.open(Path(shutil.copytree(learned, tmp_path / "run")))


@pytest.fixture
def file(run: RunArchive, tmp_path: Path) -> Path:
    return Path(shutil.copy(run.path / "model" / "domain.pddl", tmp_path / "domain.pddl"))


def sweeping() -> AbstractModel:
    """The expert's kitchen, in which one operator changes every object that meets a condition."""
    model = expert_model()
    first, *others = model.operators
    item = Variable("?any", ("pickupable",))
    raw = Literal(Atom("is_cooked", ("?any",)), False)
    clear = Literal(Atom("nothing_on", ("?any",)))
    effect = ConditionalEffect(item, (raw, clear), Literal(Atom("is_cut", ("?any",))))
    always = ConditionalEffect(item, (), raw)
    changed = replace(first, conditional_effects=frozenset({effect, always}))
    return replace(model, operators=(changed, *others))


def operators_of(run: RunArchive) -> set[object]:
    return set(run.latest().model.operators)


def test_what_is_printed_is_read_back(run: RunArchive, file: Path, tmp_path: Path) -> None:
    for model, path in ((run.latest().model, file), (sweeping(), tmp_path / "expert.pddl")):
        path.write_text(print_domain(model))
        found = read_edited_domain(path, model)
        assert {one.operator for one in found} == set(model.operators)
        assert all(f"{path}:" in one.where for one in found)


def test_an_unchanged_model_changes_nothing(run: RunArchive, file: Path) -> None:
    before = operators_of(run)
    import_model(run, file)
    assert operators_of(run) == before


def literals(run: RunArchive, *, tested: bool) -> tuple[str, str]:
    """A line of the domain with a condition that something, or nothing, puts to the test."""
    known = Recollection.of(run)
    fit = known.fit()
    for one in fit.operators:
        for condition, found in find_tests(fit, one).items():
            if isinstance(condition, Literal) and bool(found) is tested:
                text = print_domain(fit.model)
                action = text[text.index(f"(:action {one.operator.name.lower()}\n") :]
                words = " ".join((condition.atom.predicate, *condition.atom.terms))
                line = f"({words})" if condition.positive else f"(not ({words}))"
                if f"      {line}\n" in action[: action.index(":effect")]:
                    return one.operator.name.lower(), line
    raise AssertionError("expected a literal")


def without(file: Path, action: str, line: str) -> int:
    """Leave a condition of an action out; the number of the line where the action starts."""
    head, name, rest = file.read_text().partition(f"(:action {action}\n")
    file.write_text(head + name + rest.replace(f"      {line}\n", "", 1))
    return head.count("\n") + 1


def test_a_condition_that_nothing_tests_may_go(run: RunArchive, file: Path) -> None:
    before = operators_of(run)
    action, line = literals(run, tested=False)
    without(file, action, line)
    assert command("import-model", run.path, file) == 0
    changed = operators_of(run) - before
    assert [o.name.lower() for o in changed] == [action]
    assert RunArchive.open(run.path).latest().certificate.theorem1_violations == 0


def test_a_condition_that_something_tests_may_not(
    run: RunArchive, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    number = without(file, *literals(run, tested=True))
    before = contents(run.path)
    assert command("import-model", run.path, file) == 2
    said = capsys.readouterr().err
    assert f"domain.pddl:{number}: " in said
    assert "the run is as it was" in said
    assert "applies where it failed: episode" in said or "says another change of" in said
    assert contents(run.path) == before


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("(:action pick_1", "(:action fly_1", "unknown action 'fly_1'"),
        ("(:action pick_1", "(:action", "expected (:action NAME"),
        ("    :effect (and", "    :effects (and", "expected each of :parameters, :precondition"),
        (":effect (and\n      (", ":effect (and\n      (un", "unknown predicate 'un"),
        (":effect (and\n      (", ":effect (and\n      (and ", "unknown predicate 'and'"),
        ("(:types", "(:types\n    tool - object", "expected :types as they were"),
        ("(define", "(defined", "expected '(define (domain ...'"),
        (":parameters (?arm - arm", ":parameters (?arm - cube", "to be of the type arm"),
        (":parameters (?arm - arm", ":parameters (?arm - (either arm cube)", "expected one type"),
        (":parameters (?arm - arm ", ":parameters (", "parameters of"),
        ("(:action", ")(:action", "closes nothing"),
    ],
)
def test_what_is_no_domain(old: str, new: str, said: str, run: RunArchive, file: Path) -> None:
    before = contents(run.path)
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    with pytest.raises(UserError, match=r"domain\.pddl:\d+: ") as caught:
        import_model(run, file)
    assert said in str(caught.value)
    assert contents(run.path) == before


def test_predicates_that_are_needed_may_not_go(run: RunArchive, tmp_path: Path) -> None:
    model = run.latest().model
    needed = next(x.atom.predicate for o in model.operators for x in o.preconditions)
    words = tmp_path / "predicates.yaml"
    words.write_text(predicates_to_yaml(p for p in model.predicates if p.name != needed))
    before = contents(run.path)
    with pytest.raises(RefusedModelError, match=r"predicates\.yaml: refused") as caught:
        import_model(run, words)
    assert caught.value.reasons
    assert contents(run.path) == before


def test_a_predicate_in_other_words(run: RunArchive, tmp_path: Path) -> None:
    predicates = run.latest().model.predicates
    text, told = predicates_to_yaml(predicates), predicates[0].semantics
    words = tmp_path / "predicates.yaml"
    words.write_text(text.replace(told, "it is so."))
    import_model(run, words)
    again = RunArchive.open(run.path)
    assert again.latest().model.predicates[0].semantics == "it is so."
    assert len(again.corrections()) == 1


def test_a_predicate_that_nobody_has_read(run: RunArchive, tmp_path: Path) -> None:
    words = tmp_path / "predicates.yaml"
    words.write_text("predicates:\n- {name: new_one, types: [cube], semantics: it is new}\n")
    with pytest.raises(
        RefusedModelError, match=r"predicates\.yaml:2: .*was never read off a picture"
    ):
        import_model(run, words)
    assert not run.corrections()


def edited(run: RunArchive, file: Path) -> set[object]:
    """Import a domain without a condition that nothing tests; the operators then."""
    without(file, *literals(run, tested=False))
    import_model(run, file)
    return operators_of(RunArchive.open(run.path))


def test_an_imported_model_stays_when_learning_goes_on(
    run: RunArchive, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    learned, imported = operators_of(run), edited(run, file)
    assert imported != learned
    again = ("--iterations", 3, "--budget", 15, "--seed", 0)
    assert command("learn", run.settings().domain, "--out", run.path, *again) == 0
    assert "those that were imported" in capsys.readouterr().err
    assert operators_of(RunArchive.open(run.path)) == imported
    run.layout.imported.unlink()
    learn_recorded(run.path)
    assert operators_of(RunArchive.open(run.path)) == learned


def test_an_imported_model_gives_way_to_what_speaks_against_it(
    run: RunArchive, file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    imported = edited(run, file)
    name = next(p.name for p in run.latest().model.predicates if p.types == ("box",))
    key, labels = next(iter(run.latest().labels.rows.items()))
    was = labels[f"{name}(box)"]
    form = {"kind": "label", "observation": key, "atom": f"{name}(box)"}
    Review(run).correct({**form, "value": str(not was).lower()})
    assert operators_of(RunArchive.open(run.path)) != imported
    assert command("show", run.path) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "learned ones, not those that were imported: " in said
    assert ": episode " in said
    assert "not those that were imported" in Review(run).page()
    Review(run).correct({**form, "value": str(was).lower()})
    assert operators_of(RunArchive.open(run.path)) == imported


def test_an_imported_model_follows_renamed_predicates(run: RunArchive, file: Path) -> None:
    imported = edited(run, file)
    old = next(p.name for p in run.latest().model.predicates if p.types == ("box",))
    Review(run).correct({"kind": "rename", "predicate": old, "to": "lid_up"})
    renamed = {o.reworded({old: "lid_up"}) for o in imported}  # type: ignore[attr-defined]
    assert operators_of(RunArchive.open(run.path)) == renamed != imported
    Review(run).correct({"kind": "reject", "predicate": "lid_up"})
    assert f"predicate '{old}' that they speak of is gone" in imported_note(run)


def test_a_damaged_import_is_named(run: RunArchive, file: Path) -> None:
    edited(run, file)
    run.layout.imported.write_text('{"domain": "cubes",\n "predicates": [], "operators": 3}')
    before = contents(run.path)
    with pytest.raises(UserError, match=r"imported\.json:2: 'operators'"):
        learn_recorded(run.path)
    assert contents(run.path) == before
