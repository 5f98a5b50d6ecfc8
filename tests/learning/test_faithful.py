"""The faithful learner: nothing is learned twice; tautologies take no part."""

from __future__ import annotations

import pytest
from notebook import Notebook, make_domain

from skillwrapper.grounding import AtomSpace
from skillwrapper.learning import faithful
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.symbols import Predicate

KITCHEN = make_domain(
    types={"robot": (), "item": ()},
    objects={"r": "robot", "a": "item", "b": "item"},
    skills={"Take": "robot item", "Drop": "robot item", "Wave": "robot"},
)
HELD = Predicate("held", ("item",))
EMPTY = Predicate("empty", ("robot",))
SUNNY = Predicate("sunny", ())


@pytest.fixture
def learned(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The skills that were learned, in order."""
    names: list[str] = []
    original = faithful.fit_skill

    def spy(language, data):
        names.append(language.skill.name)
        return original(language, data)

    monkeypatch.setattr(faithful, "fit_skill", spy)
    return names


def some_data() -> Notebook:
    notebook = Notebook(KITCHEN, EMPTY, HELD)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.success("held(a)", "Drop(r, a)", "empty(r)")
    return notebook


def test_an_episode_relearns_only_its_skills(learned: list[str]) -> None:
    notebook = some_data()
    fitter = notebook.fitter()
    first = fitter.fit([EMPTY, HELD])
    assert set(first.skills) == {"Take", "Drop", "Wave"}
    assert learned == ["Take", "Drop", "Wave"]
    notebook.success("empty(r)", "Take(r, b)", "held(b)")
    learned.clear()
    second = fitter.fit([EMPTY, HELD])
    assert second.skills["Drop"] is first.skills["Drop"]
    assert len(second.skills["Take"].predictions[0].table) == 2
    assert learned == ["Take"]


def test_the_same_question_twice_learns_nothing(learned: list[str]) -> None:
    fitter = some_data().fitter()
    for _ in range(2):
        for words in ([EMPTY, HELD], [HELD]):
            assert fitter.fit(words).operators
        assert sorted(learned) == ["Drop", "Drop", "Take", "Take", "Wave"]


def test_what_is_remembered_is_what_would_be_learned_afresh() -> None:
    notebook = some_data()
    fitter = notebook.fitter()
    assert fitter.fit([EMPTY, HELD]).operators
    notebook.success("empty(r)", "Take(r, b)", "held(b)")
    notebook.failure("held(a)", "Drop(r, b)")
    assert fitter.fit([EMPTY, HELD]).model == notebook.fitter().fit([EMPTY, HELD]).model


def test_tautologies_take_no_part() -> None:
    """D9: nor do they count as new when they are joined by data that change them."""
    notebook = some_data()
    fit = notebook.fit(EMPTY, HELD, SUNNY)
    assert fit.predicates == (EMPTY, HELD, SUNNY)
    assert fit.operators
    used = {p.atom.predicate for o in fit.operators for p in o.operator.preconditions}
    assert used == {"empty", "held"}
    notebook.success("empty(r) sunny()", "Take(r, b)", "held(b) sunny()")
    operators = notebook.fit(SUNNY).operators
    assert {p.atom.predicate for o in operators for p in o.operator.preconditions} == {"sunny"}


def test_a_tautology_that_ends_relearns_all(learned: list[str]) -> None:
    notebook = some_data()
    fitter = notebook.fitter()
    assert fitter.fit([EMPTY, HELD, SUNNY]).operators
    learned.clear()
    notebook.success("empty(r) sunny()", "Wave(r)", "empty(r)")
    assert fitter.fit([EMPTY, HELD, SUNNY]).operators
    assert learned == ["Take", "Drop", "Wave"]


def test_unknown_labels_make_no_difference_to_a_tautology() -> None:
    notebook = some_data()
    notebook.failure("?sunny()", "Wave(r)")
    assert notebook.fitter().labeller.label([SUNNY]).varying == ()


def test_only_the_labels_of_the_skills_pictures_count() -> None:
    notebook = some_data()
    fit = notebook.fit(EMPTY, HELD)
    for name, skill in fit.skills.items():
        assert sum(len(p.table) for p in skill.predictions) == (name != "Wave")
        for prediction in skill.predictions:
            assert prediction.table.space == AtomSpace((EMPTY, HELD), KITCHEN.objects)


def test_cost_counts_operators_and_wrong_transitions() -> None:
    notebook = some_data()
    price = LearnerSettings().operator_cost
    assert notebook.fit(EMPTY, HELD).cost == 2 * price
    notebook.failure("empty(r) #2", "Take(r, b)")
    notebook.failure("empty(r) #3", "Take(r, b)")
    assert notebook.fit(EMPTY, HELD).cost == 2 * price + 2


def test_skills_are_learned_as_far_as_somebody_looks(learned: list[str]) -> None:
    fitter = some_data().fitter()
    first = next(fitter.fit([EMPTY, HELD]).each())
    assert learned == ["Take"]
    assert fitter.fit([EMPTY, HELD]).skill("Drop").skill == "Drop"
    assert learned == ["Take", "Drop"]
    assert fitter.fit([EMPTY, HELD]).skills["Take"] is first
    assert learned == ["Take", "Drop", "Wave"]
