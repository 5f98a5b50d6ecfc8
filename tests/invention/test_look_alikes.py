"""D26: pictures that look alike to the vocabulary though other things were done before them."""

from __future__ import annotations

from collections.abc import Sequence

from notebook import Notebook, make_domain, picture

from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.inventor import Inventor
from skillwrapper.invention.look_alikes import LookAlikes, look_alikes
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.inconsistencies import Inconsistency
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate

KITCHEN = make_domain(
    types={"robot": (), "item": ()},
    objects={"r": "robot", "a": "item", "b": "item"},
    skills={"Take": "robot item", "Put": "robot item", "Wave": "robot"},
)
HELD, SHINY = Predicate("held", ("item",)), Predicate("shiny", ("item",))


def put_back() -> Notebook:
    """What is taken and put back looks as before, but for a shine that has no name."""
    notebook = Notebook(KITCHEN)
    notebook.episode(
        ("#0", "Take(r, a)", True, "held(a) #1"),
        ("held(a) #1", "Put(r, a)", True, "shiny(a) #2"),
    )
    return notebook


def next_pair(choice: LookAlikes, notebook: Notebook, *vocabulary: Predicate) -> Inconsistency:
    found = choice.next(Labeller(notebook.recorded, notebook), vocabulary)
    assert found is not None
    return found


def test_two_pictures_that_look_alike_are_compared() -> None:
    asked = next_pair(LookAlikes(3), put_back(), HELD)
    assert (asked.kind, asked.skill, asked.wide) == (InconsistencyKind.UNNOTICED, "Put", True)
    assert (asked.since, asked.culprit) == (0, 1)


def test_the_most_different_deeds_come_first_and_what_was_shown_counts_less() -> None:
    notebook = put_back()
    notebook.episode(
        ("#3", "Take(r, b)", True, "held(b) #4"),
        ("held(b) #4", "Put(r, b)", True, "#5"),
        ("#5", "Wave(r)", True, "#6"),
    )
    choice = LookAlikes(9)
    first = next_pair(choice, notebook, HELD)
    assert (first.since, first.culprit) in ((0, 4), (2, 4), (1, 4))  # everything that was done
    choice.note(first, notebook.recorded, in_vain=True)
    second = next_pair(choice, notebook, HELD)
    assert (second.since, second.culprit) != (first.since, first.culprit)


def test_without_a_difference_in_deeds_or_words_nothing_is_compared() -> None:
    notebook = Notebook(KITCHEN)
    notebook.failure("#0", "Take(r, a)", "#1")
    labeller = Labeller(notebook.recorded, notebook)
    assert LookAlikes(3).next(labeller, [HELD]) is None
    busy = put_back()
    assert LookAlikes(3).next(Labeller(busy.recorded, busy), []) is None


def test_after_questions_in_vain_the_next_one_waits() -> None:
    notebook, choice = put_back(), LookAlikes(1)
    choice.note(next_pair(choice, notebook, HELD), notebook.recorded, in_vain=True)
    notebook.success("#7", "Wave(r)", "#8")
    labeller = Labeller(notebook.recorded, notebook)
    assert choice.next(labeller, [HELD]) is not None  # three executions: half as much again
    choice.note(next_pair(choice, notebook, HELD), notebook.recorded, in_vain=True)
    notebook.success("#9", "Wave(r)", "#10")
    assert choice.next(Labeller(notebook.recorded, notebook), [HELD]) is None


def test_a_pair_is_not_shown_again_where_the_robot_says_that_nothing_changed() -> None:
    notebook = Notebook(KITCHEN)
    notebook.episode(
        ("#0", "Take(r, a)", True, "held(a) #1"),
        ("held(a) #1", "Put(r, a)", False, "shiny(a) #2"),  # it slipped
    )
    notebook.success("shiny(a) #2", "Wave(r)", "shiny(a) #3", changed=False)
    choice, asked = LookAlikes(9), []
    labeller = Labeller(notebook.recorded, notebook)
    while (found := choice.next(labeller, [HELD])) is not None:
        asked.append(found.identity)
        choice.note(found, notebook.recorded, in_vain=True)
        assert len(asked) == len(set(asked))
    assert asked


class Comparer:
    """Proposes what shines where two pictures are compared, and nothing else."""

    def __init__(self) -> None:
        self.asked: list[Inconsistency] = []

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> Sequence[Predicate]:
        self.asked.append(inconsistency)
        return () if inconsistency.since is None else (SHINY,)


def test_what_tells_them_apart_is_kept_for_goals() -> None:
    notebook, proposer = put_back(), Comparer()
    words, settings = Vocabulary(KITCHEN.types, (HELD,)), LearningSettings()
    decisions: list[CandidateDecision] = []
    labeller = Labeller(notebook.recorded, notebook)
    fitter = Fitter(labeller, FaithfulLearner(settings))
    Inventor(fitter, words, proposer, settings, decisions.append).invent()
    assert [p.name for p in words.active] == ["held", "shiny"]
    assert [d.verdict for d in decisions] == [Verdict.ACCEPTED]
    compared = [asked for asked in proposer.asked if asked.since is not None]
    assert proposer.asked[: -len(compared)]  # it was asked first what the skills changed


def test_pictures_before_which_other_things_were_done_are_looked_at_first() -> None:
    notebook = Notebook(KITCHEN)
    notebook.success("held(b) #0", "Wave(r)", "held(b) #1")
    notebook.success("held(b) #1", "Take(r, a)", "held(b) #2")
    for number in range(3, 9):
        notebook.success(f"held(b) #{number}", "Wave(r)", f"shiny(a) #{number}")
    labeller = Labeller(notebook.recorded, notebook)
    kind = InconsistencyKind.UNNOTICED
    asked = Inconsistency(kind, "Wave", 0, None, 0, identity=("Wave", kind, (), ()))
    _, pictures = look_alikes(labeller, [HELD], asked)
    assert picture("held(b) #2") in pictures
    assert picture("held(b) #8") not in pictures
