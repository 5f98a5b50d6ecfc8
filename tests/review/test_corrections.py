"""What a person corrects is kept, stands above the model, and is learned from."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.errors import RunFolderError, UserError
from skillwrapper.review.doubts import INCONSISTENT, UNTOUCHED, review_pictures
from skillwrapper.review.session import Review
from skillwrapper.runs.archive import RunArchive, reserved
from skillwrapper.runs.launch import learn, learn_recorded
from skillwrapper.runs.relearning import relearn


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def correct_label(run: RunArchive, atom: str, value: str) -> str:
    """Label the first picture that shows the atom; its key."""
    labels = run.latest().labels.rows
    key = next(key for key, row in labels.items() if atom in row)
    Review(run).correct({"kind": "label", "observation": key, "atom": atom, "value": value})
    return key


def predicate(run: RunArchive, start: str) -> str:
    """The name of the predicate of one parameter of a type."""
    return next(p.name for p in run.latest().model.predicates if p.types == (start,))


def test_without_corrections_the_same_is_learned(run: RunArchive) -> None:
    model, iteration = files(run.layout.model), files(run.latest().folder)
    relearn(run)
    assert files(run.layout.model) == model
    assert files(run.latest().folder) == iteration


def test_a_wrong_label_does_harm_and_taking_it_back_mends_it(run: RunArchive) -> None:
    model, atom = files(run.layout.model), f"{predicate(run, 'box')}(box)"
    key = next(iter(run.latest().labels.rows))
    was = run.latest().labels.of(key)[atom]
    assert not run.latest().certificate.violations
    correct_label(run, atom, "false" if was else "true")
    assert run.latest().certificate.violations or run.latest().unresolved
    assert run.latest().labels.of(key)[atom] is (not was)
    assert files(run.layout.model) != model
    correct_label(run, atom, str(was).lower())
    assert files(run.layout.model) == model
    assert [c.root.read for c in run.corrections()] == [was, not was]  # type: ignore[union-attr]


def test_doubtful_pictures_come_first(run: RunArchive) -> None:
    assert not any(picture.doubts for picture in review_pictures(run))
    atom = f"{predicate(run, 'box')}(box)"
    key = list(run.latest().labels.rows)[3]
    was = run.latest().labels.of(key)[atom]
    value = "false" if was else "true"
    Review(run).correct({"kind": "label", "observation": key, "atom": atom, "value": value})
    pictures = review_pictures(run)
    assert pictures[0].doubts
    assert [p.weight for p in pictures] == sorted((p.weight for p in pictures), reverse=True)
    mistaken = next(p for p in pictures if p.observation.key == key)
    assert mistaken.corrected == {atom}
    assert atom not in mistaken.doubts  # a person's word is not in doubt
    assert {r for p in pictures for r in p.doubts.values()} <= {INCONSISTENT, UNTOUCHED}


def test_learning_on_keeps_what_was_corrected(run: RunArchive) -> None:
    old, unwanted = predicate(run, "box"), predicate(run, "arm")
    Review(run).correct({"kind": "rename", "predicate": old, "to": "lid_up"})
    meaning = "the box stands open."
    Review(run).correct({"kind": "reword", "predicate": "lid_up", "semantics": meaning})
    Review(run).correct({"kind": "reject", "predicate": unwanted})
    key = correct_label(run, "lid_up(box)", "unsure")
    model = run.latest().model
    assert model.predicate_by_name["lid_up"].semantics == meaning
    assert unwanted not in model.predicate_by_name
    domain = run.settings().domain
    for again in (
        lambda: learn_recorded(run.path),
        lambda: learn({"domain": domain, "iterations": 4, "exploration.budget": 15}, run.path),
    ):
        again()
        predicates = run.latest().model.predicate_by_name
        assert predicates["lid_up"].semantics == meaning
        assert not {old, unwanted} & set(predicates)
        assert run.latest().labels.of(key)["lid_up(box)"] is None
    assert run.layout.finished_iterations() == 4


@pytest.mark.parametrize(
    "form",
    [
        {},
        {"kind": "label", "observation": "0" * 64, "atom": "a(b)", "value": "true"},
        {"kind": "label", "atom": "a(b)", "value": "true", "known": "yes"},
        {"kind": "rename", "predicate": "no_such", "to": "other"},
        {"kind": "rename", "predicate": "", "to": "not a name"},
        {"kind": "rename", "predicate": "", "to": ""},
        {"kind": "reword", "predicate": "", "semantics": " "},
        {"kind": "reject", "predicate": "no_such"},
    ],
)
def test_what_is_no_correction_is_refused_and_leaves_nothing(
    run: RunArchive, form: dict[str, str]
) -> None:
    form = {k: v or predicate(run, "box") if k == "predicate" else v for k, v in form.items()}
    if "known" in form:
        form["observation"] = next(iter(run.latest().labels.rows))
    with pytest.raises(UserError):
        Review(run).correct(form)
    assert not run.layout.corrections.exists()


def test_a_name_that_was_used_is_not_given_again(run: RunArchive) -> None:
    first = predicate(run, "box")
    Review(run).correct({"kind": "rename", "predicate": first, "to": "lid_up"})
    for taken in (first, "lid_up", predicate(run, "arm")):
        with pytest.raises(UserError, match="no predicate has or had"):
            Review(run).correct({"kind": "rename", "predicate": "lid_up", "to": taken})


def test_nobody_corrects_while_somebody_learns(run: RunArchive) -> None:
    with reserved(run.path), pytest.raises(RunFolderError, match="another process"):
        correct_label(run, f"{predicate(run, 'box')}(box)", "unsure")
    assert not run.layout.corrections.exists()
