from pathlib import Path

import numpy as np
import pytest
import yaml

from skillwrapper.domains.discovery import find_domain
from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.evaluation.study.contrastive_pairs import read_pairs
from skillwrapper.evaluation.study.invention import study_invention
from skillwrapper.evaluation.study.judge import MeaningJudge
from skillwrapper.evaluation.study.meaning import Meaning, compare_meaning, target_columns
from skillwrapper.evaluation.study.models import StudiedModel
from skillwrapper.evaluation.study.tables import invention_tables
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.world.types import Object

PAIRS = find_domain("burger").pairs


@pytest.fixture(scope="module")
def judge() -> MeaningJudge:
    return MeaningJudge(find_domain("burger"), 80, seed=0)


def predicate(name: str, *types: str, means: str = "") -> Predicate:
    return Predicate(name, types, means)


@pytest.mark.parametrize(
    ("proposed", "target", "meaning"),
    [
        (predicate("hand_empty", "robot"), "hand_empty(?robot)", Meaning.SYNONYM),
        (predicate("hand_full", "robot"), "hand_empty(?robot)", Meaning.ANTONYM),
        (predicate("holding", "robot", "pickupable"), "hand_empty(?robot)", Meaning.OTHER),
        (predicate("is_held", "pickupable"), "holding(?robot, ?item)", Meaning.SYNONYM),
        (predicate("holding", "robot", "pickupable"), "holding(?robot, ?item)", Meaning.SYNONYM),
        (predicate("lies_on_board", "cuttable"), "on_station(?item, board)", Meaning.SYNONYM),
        (predicate("lies_on_board", "cuttable"), "on_station(?item, stove)", Meaning.OTHER),
        (predicate("raw", "cookable"), "is_cooked(?item)", Meaning.ANTONYM),
        (predicate("beneath", "pickupable", "pickupable"), "stacked_on(?a, ?b)", Meaning.SYNONYM),
        (predicate("left_of", "pickupable", "pickupable"), "stacked_on(?a, ?b)", Meaning.OTHER),
        (predicate("zorbs", "robot", means="it zorbs"), "hand_empty(?robot)", Meaning.UNDECIDED),
    ],
)
def test_meaning_is_decided_by_truth_in_many_states(
    judge: MeaningJudge, proposed: Predicate, target: str, meaning: Meaning
) -> None:
    name, _, terms = target.removesuffix(")").partition("(")
    assert judge.judge(proposed, Atom(name, tuple(terms.split(", ")))) is meaning


def test_one_unknown_label_leaves_it_undecided() -> None:
    things = (Object("a", ("thing",)), Object("b", ("thing",)))
    wanted = {("a",): np.array([1, 0], np.int8), ("b",): np.array([0, 0], np.int8)}
    unsure = {("a",): np.array([1, 0], np.int8), ("b",): np.array([0, -1], np.int8)}
    full = predicate("full", "thing")
    assert compare_meaning(full, unsure, wanted, things) is Meaning.UNDECIDED
    wrong = {**unsure, ("a",): np.array([0, 0], np.int8)}
    assert compare_meaning(full, wrong, wanted, things) is Meaning.OTHER


def test_a_constant_target_is_the_meaning_of_nothing() -> None:
    thing = (Object("a", ("thing",)),)
    never = {("a",): np.zeros(3, np.int8)}
    assert compare_meaning(predicate("full", "thing"), never, never, thing) is Meaning.OTHER


def test_the_columns_of_a_target_with_an_object_in_it() -> None:
    columns = {("a", "x"): np.ones(1, np.int8), ("a", "y"): np.zeros(1, np.int8)}
    found = target_columns(Atom("on", ("?item", "y")), columns)
    assert list(found) == [("a",)]
    assert found["a",] is columns["a", "y"]


def test_the_shipped_pairs_have_different_targets(judge: MeaningJudge) -> None:
    pairs = read_pairs(PAIRS, judge.environment, judge.expert)
    assert len(pairs) >= 6
    assert len({pair.target for pair in pairs}) == len({pair.name for pair in pairs}) == len(pairs)
    for pair in pairs:
        # The answer must not be told, unless it is the target with other objects.
        assert pair.target.predicate not in {p.name for p in pair.question.current}


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"target": "hand_emty(?robot)"}, UnknownNameError, "did you mean 'hand_empty'"),
        ({"target": "hand_empty(?a, ?b)"}, ConfigurationError, "expected 1 terms"),
        ({"kind": "unexplained"}, ConfigurationError, "expected one execution"),
        ({"kind": "determinism"}, ConfigurationError, "expected a success of Pick"),
        ({"knwon": []}, ConfigurationError, "unknown key 'pairs.0.knwon'"),
    ],
)
def test_pairs_that_make_no_sense_are_refused_with_their_line(
    judge: MeaningJudge,
    tmp_path: Path,
    change: dict[str, object],
    error: type[Exception],
    message: str,
) -> None:
    content = yaml.safe_load(PAIRS.read_text())
    content["pairs"] = [{**content["pairs"][0], **change}]
    path = tmp_path / "pairs.yaml"
    path.write_text(yaml.safe_dump(content))
    with pytest.raises(error, match=message) as caught:
        read_pairs(path, judge.environment, judge.expert)
    assert f"{path}:" in str(caught.value)


def test_a_study_asks_in_every_run_anew() -> None:
    found = study_invention("burger", [StudiedModel("embedded")], runs=2, states=30)
    assert found.runs == 2
    assert len(found.proposals) == 2 * len(found.targets)
    assert all(p.predicate is not None for p in found.proposals)
    firsts, seconds = ([p.predicate for p in found.proposals if p.run == r] for r in (1, 2))
    assert firsts != seconds
    correct = found.to_json()["correct"]["embedded, noise none"]
    assert 0 < correct < len(found.proposals)
    ours, papers, _ = invention_tables(found)
    assert ours.rows[-1][-1] == f"{correct} of {len(found.proposals)}"
    assert papers.rows[-1][-2:] == ("11 of 12", "2 of 12")
