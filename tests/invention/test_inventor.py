"""Inventing predicates: what is asked when, what is kept, and why (D6, D8, D9)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from notebook import Notebook, make_domain, picture

from skillwrapper.invention.decisions import CandidateDecision, Verdict
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.inventor import Inventor
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.inconsistencies import Inconsistency, distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate

KITCHEN = make_domain(
    types={"robot": (), "item": (), "place": ()},
    objects={"r": "robot", "a": "item", "b": "item", "x": "place", "y": "place"},
    skills={"Take": "robot item", "Wave": "robot"},
)
EMPTY = Predicate("empty", ("robot",))
HELD = Predicate("held", ("item",))
FREE = Predicate("free", ("place",))
ON = Predicate("on", ("item", "place"))
NEAR = Predicate("near", ("item", "place"))
ROUND = Predicate("round", ("item",))
SHINY = Predicate("shiny", ("item",))


class Proposer:
    """Proposes a list of candidates each time it is asked, and remembers the questions."""

    def __init__(self, *answers: Sequence[Predicate]) -> None:
        self.answers = list(answers)
        self.asked: list[tuple[Inconsistency, tuple[str, ...], tuple[str, ...], int]] = []

    def propose(
        self,
        inconsistency: Inconsistency,
        current: Sequence[Predicate],
        rejected: Sequence[Predicate],
        attempt: int,
    ) -> Sequence[Predicate]:
        self.asked.append(
            (
                inconsistency,
                tuple(p.name for p in current),
                tuple(p.name for p in rejected),
                attempt,
            )
        )
        return self.answers.pop(0) if self.answers else ()

    @property
    def kinds(self) -> list[str]:
        return [str(question[0].kind) for question in self.asked]


class Study:
    """An inventor over a notebook, with all its decisions."""

    def __init__(
        self,
        notebook: Notebook,
        *answers: Sequence[Predicate],
        active: Sequence[Predicate] = (),
        dormant: Sequence[Predicate] = (),
        labeller: type[Labeller] = Labeller,
        **settings: object,
    ) -> None:
        self.proposer = Proposer(*answers)
        self.words = Vocabulary(notebook.domain.types, (*active, *dormant))
        for predicate in dormant:
            self.words.set_dormant(predicate)
        self.decisions: list[CandidateDecision] = []
        chosen = LearningSettings(
            **{"unnoticed_everywhere": False, "look_alikes": False, **settings}
        )
        self.inventor = Inventor(
            Fitter(labeller(notebook.recorded, notebook), FaithfulLearner(chosen)),
            self.words,
            self.proposer,
            chosen,
            self.decisions.append,
        )

    def verdicts(self, *verdicts: Verdict) -> list[str]:
        """The predicates of which that was decided."""
        return [d.predicate.name for d in self.decisions if d.verdict in verdicts]

    @property
    def active(self) -> list[str]:
        return [p.name for p in self.words.active]


def full_hand(*, resets_restore_state: bool = False) -> Notebook:
    """Taking fails as long as something is held."""
    notebook = Notebook(replace(KITCHEN, resets_restore_state=resets_restore_state))
    for item, other in (("a", "b"), ("b", "a")) * 2:
        notebook.success(f"empty(r) round({item})", f"Take(r, {item})", f"held({item}) round(a)")
        notebook.failure(f"held({other})", f"Take(r, {item})")
    return notebook


def test_what_resolves_is_kept_until_nothing_is_left() -> None:
    study = Study(full_hand(), [EMPTY], [HELD])
    fit = study.inventor.invent()
    assert study.active == ["empty"]
    assert study.verdicts(Verdict.ACCEPTED) == ["empty"]
    assert fit.inconsistencies == ()
    assert distinct_causes(fit.inconsistencies) == ()
    (decision,) = study.decisions
    assert decision.score == 1.0
    assert decision.inconsistency == study.proposer.asked[0][0]


def test_nothing_inconsistent_nothing_asked() -> None:
    study = Study(full_hand(), active=[EMPTY])
    assert study.inventor.invent().inconsistencies == ()
    assert study.proposer.asked == []
    assert study.decisions == []


def test_what_cannot_tell_the_two_apart_is_not_labelled_everywhere() -> None:
    notebook = full_hand()
    study = Study(notebook, [SHINY], [EMPTY])
    study.inventor.invent()
    rejected = study.decisions[0]
    assert (rejected.verdict, rejected.predicate) == (Verdict.REJECTED, SHINY)
    assert rejected.score is None
    assert rejected.reason == "does not tell the two transitions apart"
    assert {n for names, n in notebook.asked if names == "shiny"} == {1}


def test_all_promising_candidates_are_labelled_in_one_go() -> None:
    notebook = full_hand()
    Study(notebook, [ROUND, HELD, EMPTY, SHINY]).inventor.invent()
    together = [names for names, n in notebook.asked if names and n > 2]
    assert together[0] == "round empty"


def test_the_pictures_of_the_witnesses_are_labelled_for_all_candidates_in_one_go() -> None:
    notebook = full_hand()
    Study(notebook, [ROUND, HELD, EMPTY, SHINY]).inventor.invent()
    assert [names for names, n in notebook.fetched if n == 1][:2] == ["round held empty shiny"] * 2


def test_the_best_of_several_is_kept() -> None:
    """``round`` tells the first two transitions apart as well, but not all."""
    notebook = full_hand()
    notebook.success("empty(r) #round", "Take(r, b)", "held(b)")
    study = Study(notebook, [ROUND, EMPTY, SHINY])
    study.inventor.invent()
    assert study.active == ["empty"]
    assert {d.predicate.name: d.verdict for d in study.decisions} == {
        "round": Verdict.REJECTED,
        "empty": Verdict.ACCEPTED,
        "shiny": Verdict.REJECTED,
    }


def test_attempts_are_bounded() -> None:
    """D8: until there are new data; asking again next time would not end."""
    study = Study(full_hand(), attempts=2, unnoticed=False)
    fit = study.inventor.invent()
    causes = distinct_causes(fit.inconsistencies)
    assert {c.kind for c in causes} == {InconsistencyKind.PRECONDITION, InconsistencyKind.EFFECT}
    assert sorted(study.proposer.kinds) == sorted(str(c.kind) for c in causes for _ in range(2))
    assert sorted(q[3] for q in study.proposer.asked) == sorted([0, 1] * len(causes))
    study.inventor.invent()
    assert len(study.proposer.asked) == 2 * len(causes)


def test_what_was_given_up_is_asked_again_only_if_its_skill_was_run() -> None:
    """Else the model hears the same question about the same pictures in every iteration."""
    notebook = full_hand()
    study = Study(notebook, attempts=2, unnoticed=False)
    study.inventor.invent()
    asked = len(study.proposer.asked)
    notebook.success("", "Wave(r)", "#1")
    study.inventor.invent()
    assert len(study.proposer.asked) == asked
    notebook.failure("held(a) #2", "Take(r, b)")
    study.inventor.invent()
    assert len(study.proposer.asked) > asked


def test_the_least_tried_cause_comes_first() -> None:
    study = Study(full_hand(), attempts=2, unnoticed=False)
    study.inventor.invent()
    assert study.proposer.kinds == ["precondition", "effect"] * 2


def test_conditions_of_the_paper_come_before_the_other_kinds() -> None:
    notebook = Notebook(KITCHEN)
    notebook.success("free(y)", "Take(r, a)", "held(a) free(x) free(y)")
    notebook.failure("", "Take(r, a)", "held(a)")
    study = Study(notebook, active=[HELD, FREE], attempts=1)
    study.inventor.invent()
    assert study.proposer.kinds[:3] == ["precondition", "effect", "unexplained"]


def test_questions_in_one_iteration_are_bounded() -> None:
    study = Study(full_hand(), attempts=9, max_inventions=3)
    study.inventor.invent()
    assert len(study.proposer.asked) == 3


def test_candidates_tried_in_one_iteration_are_bounded() -> None:
    for most, asked in ((1, 1), (2, 2)):
        study = Study(full_hand(), [ROUND], [ROUND], [ROUND], max_trials=most, threshold=1.0)
        study.inventor.invent()
        tried = [d for d in study.decisions if d.score is not None]
        assert (len(tried), len(study.proposer.asked)) == (most, asked)


def test_rejected_candidates_are_told_and_not_tried_again() -> None:
    study = Study(full_hand(), [SHINY], [], [SHINY, EMPTY])
    study.inventor.invent()
    assert [(str(q[0].kind), q[2]) for q in study.proposer.asked] == [
        ("precondition", ()),
        ("effect", ()),
        ("precondition", ("shiny",)),
    ]
    assert study.verdicts(Verdict.REJECTED) == ["shiny"]


def test_what_is_rejected_for_one_cause_is_tried_for_another() -> None:
    for apart, tried in ((True, 2), (False, 1)):
        study = Study(full_hand(), [SHINY], [SHINY], [EMPTY], reject_by_cause=apart)
        study.inventor.invent()
        assert study.verdicts(Verdict.REJECTED) == ["shiny"] * tried


def test_every_further_question_shows_another_pair() -> None:
    for rotates, partners in ((True, [0, 4, 2]), (False, [0, 0, 0])):
        study = Study(full_hand(), attempts=3, rotate=rotates)
        study.inventor.invent()
        asked = [q[0] for q in study.proposer.asked if q[0].kind == "precondition"]
        assert [i.first for i in asked] == partners
        assert len({i.culprit for i in asked}) == 1


def test_during_an_episode_only_new_causes_are_asked_for() -> None:
    notebook = full_hand()
    study = Study(notebook, attempts=1)
    study.inventor.keep_up()
    asked = len(study.proposer.asked)
    assert asked == 2
    study.inventor.keep_up()
    notebook.failure("held(b) round(b)", "Take(r, a)")
    study.inventor.keep_up()
    assert len(study.proposer.asked) == asked
    notebook.success("", "Wave(r)", "#1")
    notebook.failure("held(a) shiny(b) #2", "Wave(r)")
    study.inventor.keep_up()
    assert {q[0].skill for q in study.proposer.asked[asked:]} == {"Wave"}


def test_nothing_is_asked_during_an_episode_if_so_set() -> None:
    study = Study(full_hand(), new_causes=False)
    study.inventor.keep_up()
    assert study.proposer.asked == []


def test_what_reads_differently_at_starts_is_taken_back() -> None:
    notebook = full_hand(resets_restore_state=True)
    study = Study(notebook, active=[EMPTY, ROUND], dormant=[SHINY])
    scene = notebook.domain.scene()
    study.inventor.note_start(scene, picture("empty(r) round(a) shiny(a)"))
    study.inventor.note_start(scene, picture("empty(r) round(b) shiny(b)"))
    assert study.active == ["empty"]
    assert study.verdicts(Verdict.RETRACTED) == ["round"]


def test_starts_of_which_nothing_is_declared_may_differ() -> None:
    notebook = full_hand()
    study = Study(notebook, active=[EMPTY, ROUND])
    for start in ("round(a)", "round(b)"):
        study.inventor.note_start(notebook.domain.scene(), picture(start))
    assert study.active == ["empty", "round"]


def test_a_better_vocabulary_of_an_earlier_iteration_is_taken_up_again() -> None:
    for keeps, active in ((True, ["empty", "held"]), (False, ["held"])):
        study = Study(full_hand(), active=[EMPTY, HELD], keep_best=keeps)
        study.inventor.invent()
        study.words.set_dormant(EMPTY)
        study.words.drop([EMPTY])
        study.inventor.invent()
        assert study.active == active


def test_dormant_predicates_are_tried_before_the_model_is_asked() -> None:
    """D9"""
    study = Study(full_hand(), dormant=[SHINY, EMPTY])
    fit = study.inventor.invent()
    assert study.proposer.asked == []
    assert study.active == ["empty"]
    assert study.words.dormant == (SHINY,)
    assert study.verdicts(Verdict.REVIVED) == ["empty"]
    assert fit.inconsistencies == ()


def test_dormant_ones_that_do_not_help_are_not_rejected() -> None:
    study = Study(full_hand(), [EMPTY], dormant=[SHINY, NEAR])
    study.inventor.invent()
    assert study.words.dormant == (SHINY, NEAR)
    assert study.proposer.asked[0][2] == ()
    assert study.active == ["empty"]


def test_the_score_must_be_above_the_threshold() -> None:
    study = Study(full_hand(), [EMPTY], threshold=1.0)
    study.inventor.invent()
    assert study.active == []
    assert study.decisions[0].reason == "score 1.00 is not above 1.00"
    assert study.decisions[0].score == 1.0


def test_a_label_that_is_unknown_resolves_nothing() -> None:
    """D10: else whoever sees nothing where it matters would explain everything."""
    notebook = Notebook(KITCHEN)
    for item in "ab":
        notebook.success(f"shiny({item})", f"Take(r, {item})", f"shiny({item}) held({item})")
        notebook.failure(f"?shiny({item})", f"Take(r, {item})")
    study = Study(notebook, [SHINY], active=[HELD])
    fit = study.inventor.invent()
    assert study.active == ["held"]
    assert study.decisions[0].reason == "its labels of what is inconsistent are unknown"
    assert len(fit.inconsistencies) == 2


def test_one_unknown_label_does_not_hide_that_the_others_are_told_apart() -> None:
    """Of the three failures of one cause, the first cannot be read."""
    notebook = Notebook(KITCHEN)
    for number in range(3):
        notebook.success("empty(r)", "Take(r, a)", "held(a)")
        notebook.failure("#1" if number else "?empty(r)", "Take(r, a)")
    study = Study(notebook, [EMPTY], active=[HELD])
    study.inventor.invent()
    assert study.active == ["held", "empty"]


def test_what_it_brings_of_the_other_kinds_is_queued() -> None:
    """D6: ``free`` shows what success changes, but why that place? Then ``on`` is asked for."""
    notebook = Notebook(KITCHEN)
    for item, place in (("a", "x"), ("b", "y"), ("a", "y"), ("b", "x")):
        before = f"empty(r) on({item}, {place})"
        notebook.success(before, f"Take(r, {item})", f"empty(r) free({place}) #taken")
        notebook.failure(f"on({item}, {place})", f"Take(r, {item})")
    study = Study(notebook, [ON], active=[EMPTY, FREE])
    fit = study.inventor.invent()
    assert study.proposer.kinds == ["effect"]
    assert set(study.active) == {"empty", "free", "on"}
    assert fit.inconsistencies == ()


def test_a_link_between_what_changed_and_what_is_unexplained() -> None:
    """D1: neither object of ``on`` is an argument, but it joins two parts of the change."""
    notebook = Notebook(KITCHEN)
    near = Predicate("beside", ("item", "item"))
    notebook.success("beside(a, b) on(b, x)", "Take(r, a)", "held(a) free(x)")
    study = Study(notebook, [ON], active=[HELD, near, FREE])
    fit = study.inventor.invent()
    assert study.active == ["held", "beside", "free", "on"]
    assert fit.inconsistencies == ()


def test_what_does_not_touch_the_unexplained_object_is_no_candidate() -> None:
    notebook = Notebook(KITCHEN)
    notebook.success("on(a, y)", "Take(r, a)", "held(a) free(x)")
    study = Study(notebook, [ON], active=[HELD, FREE], attempts=1)
    study.inventor.invent()
    assert study.decisions[0].reason == "does not tell the two transitions apart"


def test_what_takes_much_more_than_it_explains_is_not_kept() -> None:
    """``near`` explains the failure, but makes of one operator five."""
    for better, kept in (([EMPTY], ["held", "empty"]), ([], ["held"])):
        notebook = Notebook(KITCHEN)
        for number, after in enumerate(("", "near(a, x)", "near(a, y)", "near(a, x) near(a, y)")):
            notebook.success(f"empty(r) near(a, x) #{number}", "Take(r, a)", f"held(a) {after}")
        notebook.failure("", "Take(r, a)")
        study = Study(notebook, [NEAR], better, active=[HELD], attempts=2, operator_cost=2)
        fit = study.inventor.invent()
        assert study.active == kept
        assert bool(distinct_causes(fit.inconsistencies)) == (not better)
        assert study.decisions[0].verdict is Verdict.REJECTED
        assert study.decisions[0].reason == "it takes more operators than it explains transitions"


def test_a_predicate_that_only_splits_the_data_is_taken_back() -> None:
    notebook = Notebook(KITCHEN)
    for number, (before, after) in enumerate(
        (
            ("near(a, x)", "near(a, y)"),
            ("near(a, x) near(a, y)", ""),
            ("", "near(a, x) near(a, y)"),
            ("near(a, y)", ""),
            ("near(a, y)", "near(a, x) near(a, y)"),
        )
    ):
        notebook.success(f"empty(r) {before} #{number}", "Take(r, a)", f"held(a) {after}")
        notebook.failure(f"{before} #{number}", "Take(r, a)")
    study = Study(notebook, active=[EMPTY, HELD, NEAR])
    fit = study.inventor.invent()
    assert study.verdicts(Verdict.RETRACTED) == ["near"]
    assert study.active == ["empty", "held"]
    assert fit.inconsistencies == ()
    assert len(fit.operators) == 1
    (decision,) = study.decisions
    assert (decision.inconsistency, decision.score) == (None, None)


def test_a_likeness_that_leaves_more_inconsistent_than_it_resolves_is_taken_back() -> None:
    """``near`` explains the failure, but splits the successes, and two of them contradict it."""
    notebook = Notebook(KITCHEN)
    for number, (before, after) in enumerate(
        (
            ("near(a, x)", "near(a, y)"),
            ("near(a, x) near(a, y)", ""),
            ("near(a, y)", ""),
            ("near(a, y)", "near(a, x) near(a, y)"),
        )
    ):
        notebook.success(f"empty(r) {before} #{number}", "Take(r, a)", f"held(a) {after}")
    notebook.failure("empty(r)", "Take(r, a)")
    study = Study(notebook, active=[EMPTY, HELD, NEAR])
    fit = study.inventor.invent()
    assert study.verdicts(Verdict.RETRACTED) == ["near"]
    assert len(fit.operators) == 1
    assert {i.kind for i in fit.inconsistencies} == {InconsistencyKind.PRECONDITION}


def blurred(times: int) -> Notebook:
    """Taking takes an empty hand; ``near`` comes and goes with no reason."""
    notebook = Notebook(KITCHEN)
    near = ("near(a, x)", "near(a, x) near(a, y)", "near(a, y)", "near(b, x) near(a, x)", "")
    for number in range(times):
        before, after = (near[(number * step + step) % len(near)] for step in (1, 3))
        notebook.success(f"empty(r) {before} #{number}", "Take(r, a)", f"held(a) {after}")
        notebook.failure(f"{before} #{number}", "Take(r, a)")
    return notebook


def test_what_leaves_far_more_inconsistent_goes_before_anything_is_asked() -> None:
    study = Study(blurred(20), [ROUND] * 9, active=[EMPTY, HELD, NEAR])
    study.inventor.invent()
    assert study.active == ["empty", "held"]
    assert study.proposer.asked == []


def test_the_name_of_a_change_goes_too_if_it_leaves_far_more_inconsistent() -> None:
    study = Study(blurred(20), active=[EMPTY, HELD])
    study.words.accept(NEAR, for_change=True)
    study.inventor.invent()
    assert study.active == ["empty", "held"]


def test_the_name_of_a_change_may_leave_a_little_inconsistent() -> None:
    study = Study(blurred(4), active=[EMPTY, HELD])
    study.words.accept(NEAR, for_change=True)
    fit = study.inventor.invent()
    assert fit.inconsistencies
    assert study.active == ["empty", "held", "near"]


def test_what_takes_more_than_it_explains_goes_also_when_no_question_is_left() -> None:
    study = Study(blurred(4), active=[EMPTY, HELD, NEAR], max_inventions=0)
    study.inventor.invent()
    assert study.active == ["empty", "held"]


def test_same_questions_same_answers_same_vocabulary() -> None:
    """D14"""
    answers = ([SHINY, ROUND], [HELD, EMPTY], [ON], [FREE, NEAR])
    found = [Study(full_hand(), *answers) for _ in range(2)]
    models = [study.inventor.invent().model for study in found]
    assert models[0] == models[1]
    assert found[0].decisions == found[1].decisions


def silent_wave() -> Notebook:
    """Nothing that has a name changes when the robot waves, though its hand is up afterwards."""
    notebook = Notebook(KITCHEN)
    notebook.success("round(a)", "Wave(r)", "round(a) empty(r)")
    notebook.success("round(a) #2", "Wave(r)", "round(a) empty(r) #2")
    return notebook


def test_an_unnoticed_change_is_asked_for_when_an_iteration_ends() -> None:
    """D26"""
    study = Study(silent_wave(), [SHINY], [EMPTY], active=[ROUND])
    study.inventor.keep_up()
    assert study.proposer.asked == []
    fit = study.inventor.invent()
    assert study.proposer.kinds == ["unnoticed"] * 2
    assert study.active == ["round", "empty"]
    assert fit.unnoticed == ()
    assert fit.skill("Wave").operators[0].operator.add_effects


def test_unnoticed_changes_wait_while_misreadings_are_as_frequent() -> None:
    """What else has changed cannot be told then from what was misread (D24)."""
    study = Study(silent_wave(), [SHINY], [EMPTY], active=[ROUND], labeller=Doubting)
    study.inventor.invent()
    assert study.proposer.asked == []


class Doubting(Labeller):
    """Takes a fiftieth of all readings for wrong."""

    @property
    def misread(self) -> float:
        return 0.02


def _kinds_asked_of_one_success(labeller: type[Labeller]) -> list[str]:
    """Of a success that seems to do no more than failures, seen in several states."""
    notebook = Notebook(KITCHEN)
    notebook.success("round(a)", "Take(r, a)", "round(a) held(a)")
    notebook.failure("round(b)", "Take(r, b)")
    notebook.failure("#2", "Take(r, b)")
    study = Study(notebook, active=[ROUND], labeller=labeller, attempts=1, unnoticed=False)
    study.inventor.invent()
    return study.proposer.kinds


def test_of_a_success_it_is_not_asked_again_and_again_what_it_changes() -> None:
    """If readings may be wrong, further failures beside it tell no more (D24)."""
    assert _kinds_asked_of_one_success(Labeller).count("effect") == 2
    assert _kinds_asked_of_one_success(Doubting).count("effect") == 1


def test_after_nothing_other_objects_are_looked_at_too_once_half_as_much_again_was_run() -> None:
    notebook = silent_wave()
    study = Study(notebook, active=[ROUND])
    for number in range(3, 6):
        study.inventor.invent()
        notebook.success(f"round(b) #{number}", "Wave(r)", f"round(b) empty(r) #{number}")
    study.inventor.invent()
    asked = [(question[0].first, question[0].wide) for question in study.proposer.asked]
    assert asked == [(1, False), (1, True), (2, True)]


def test_questions_in_a_row_about_unnoticed_changes_are_bounded() -> None:
    """And it is asked again only when half as much again was executed."""
    notebook = silent_wave()
    study = Study(notebook, *([SHINY] for _ in range(9)), active=[ROUND], attempts=2)
    for number in range(3):
        study.inventor.invent()
        notebook.success(f"round(a) #{number}", "Wave(r)", f"round(a) empty(r) #{number}")
    assert study.proposer.kinds == ["unnoticed"] * 4
    assert [q[0].wide for q in study.proposer.asked] == [False, True, True, True]


def test_all_that_has_changed_gets_a_name() -> None:
    notebook = Notebook(KITCHEN)
    for number in range(2):
        notebook.success(f"round(a) #{number}", "Wave(r)", f"round(a) empty(r) held(a) #{number}")
        notebook.success(f"held(a) #{number}", "Wave(r)", f"held(a) empty(r) #{number}")
    study = Study(notebook, [EMPTY, Predicate("high", ("robot",))], active=[ROUND])
    study.inventor.invent()
    assert study.active == ["round", "empty"]  # nothing is high


def test_a_dormant_name_of_a_change_is_taken_up_when_it_tells_something_apart() -> None:
    notebook = silent_wave()
    study = Study(notebook, [EMPTY], active=[ROUND])
    study.inventor.invent()
    study.words.set_dormant(EMPTY)
    study.inventor.invent()
    assert study.active == ["round", "empty"]
    assert study.verdicts(Verdict.REVIVED) == ["empty"]


def test_unnoticed_changes_are_not_asked_for_if_so_set() -> None:
    study = Study(silent_wave(), [EMPTY], active=[ROUND], unnoticed=False)
    study.inventor.invent()
    assert study.proposer.asked == []


def test_what_the_robot_says_changed_nothing_is_no_question() -> None:
    """D7"""
    notebook = Notebook(KITCHEN)
    notebook.success("round(a)", "Wave(r)", "round(a) empty(r)", changed=False)
    study = Study(notebook, [EMPTY], active=[ROUND])
    study.inventor.invent()
    assert study.proposer.asked == []


LARGE = Predicate("large", ("robot",))


def likeness() -> Notebook:
    """A robot looks smaller as soon as it holds something, but not always."""
    notebook = Notebook(KITCHEN)
    notebook.success("empty(r) large(r)", "Take(r, a)", "held(a)")
    notebook.success("empty(r) large(r) #1", "Take(r, a)", "held(a) large(r)")
    notebook.failure("held(b)", "Take(r, a)")
    return notebook


def test_a_dormant_predicate_takes_the_place_of_a_poor_likeness() -> None:
    study = Study(likeness(), active=[HELD, LARGE], dormant=[EMPTY])
    fit = study.inventor.invent()
    assert fit.inconsistencies == ()
    assert (study.active, study.words.dormant) == (["held", "empty"], (LARGE,))
    assert study.verdicts(Verdict.RETRACTED, Verdict.REVIVED) == ["large", "empty"]
    assert study.proposer.asked == []


def test_nothing_is_exchanged_that_leaves_as_much_inconsistent() -> None:
    study = Study(full_hand(), [EMPTY], active=[HELD], dormant=[SHINY])
    study.inventor.invent()
    assert study.proposer.asked
    assert study.verdicts(Verdict.REVIVED) == []
    assert (study.active, study.words.dormant) == (["held", "empty"], (SHINY,))


def test_without_exchanges_the_model_is_asked() -> None:
    study = Study(likeness(), active=[HELD, LARGE], dormant=[EMPTY], exchange=False)
    study.inventor.invent()
    assert study.proposer.asked
    assert study.verdicts(Verdict.RETRACTED, Verdict.REVIVED) == ["large", "empty"]


def test_what_else_changed_is_rather_asked_where_other_things_hold() -> None:
    """And again only when twice as much was executed (D26)."""
    notebook = Notebook(KITCHEN)
    take = ("Take(r, a)", "held(a)")
    notebook.success("empty(r)", *take)
    notebook.success("empty(r) round(b)", take[0], "held(a) round(b)")
    study = Study(notebook, active=[EMPTY, HELD, ROUND], unnoticed_everywhere=True)
    study.inventor.invent()
    notebook.success("empty(r) round(a)", take[0], "held(a) round(a)")
    study.inventor.invent()
    assert len(study.proposer.asked) == 1
    notebook.success("empty(r) #2", take[0], "held(a) #2")
    study.inventor.invent()
    asked = [question[0].culprit for question in study.proposer.asked]
    assert len(asked) == 2
    assert asked[0] in (0, 1)
    assert asked[1] == 2


def test_of_a_telling_skill_it_is_also_asked_what_changed_where_nothing_seems_to() -> None:
    """What is baked twice is burnt."""
    notebook = Notebook(KITCHEN)
    notebook.success("empty(r)", "Take(r, a)", "held(a)")
    notebook.success("held(a)", "Take(r, a)", "held(a) #2")
    study = Study(notebook, active=[EMPTY, HELD], unnoticed_everywhere=True)
    study.inventor.invent()
    assert {question[0].culprit for question in study.proposer.asked} == {0, 1}


NEXT = Predicate("next", ("robot", "item"))


def test_of_a_silent_skill_it_is_asked_at_once_where_other_things_hold_nearby() -> None:
    """Also of what the arguments stand in a relation with, but once in an iteration."""
    notebook = Notebook(KITCHEN)
    for number in range(9):
        notebook.success(f"next(r, a) #{number}", "Wave(r)", f"next(r, a) held(b) #{number}")
    study = Study(notebook, active=[NEXT, ROUND], attempts=1)
    study.inventor.invent()
    notebook.success("next(r, a) #9", "Wave(r)", "next(r, a) held(b) #9")
    study.inventor.invent()
    assert len(study.proposer.asked) == 1
    for item in "ab":
        there = f"next(r, a) round({item})"
        notebook.success(there, "Wave(r)", f"{there} held(b)")
    study.inventor.invent()
    assert [question[0].culprit for question in study.proposer.asked][1:] == [10]


def test_what_told_nothing_new_is_read_together_when_more_was_executed() -> None:
    notebook = Notebook(KITCHEN)
    notebook.success("empty(r) #0", "Wave(r)", "held(a) shiny(b) #1")
    notebook.failure("held(a) shiny(b) #2", "Wave(r)")
    study = Study(notebook, [HELD, SHINY], active=[EMPTY], unnoticed_everywhere=True)
    study.inventor.invent()
    assert study.active == ["empty"]  # no other picture looks like the first one
    notebook.success("empty(r) held(a) #3", "Wave(r)", "#4")
    notebook.success("empty(r) held(a) #5", "Wave(r)", "shiny(b) #6")
    notebook.waves.clear()
    study.inventor.invent()
    assert notebook.waves[0] == "held shiny"
    assert "held shiny" in notebook.waves[1:]
