from dataclasses import replace
from pathlib import Path

import pytest

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.states import BurgerState
from skillwrapper.domains.discovery import find_domain
from skillwrapper.embedded.noise import read_profile
from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.evaluation.published import published_figures
from skillwrapper.evaluation.study.conditions import CONDITIONS, find_conditions
from skillwrapper.evaluation.study.models import StudiedModel, open_studied
from skillwrapper.evaluation.study.perception import PerceptionStudy, study_perception
from skillwrapper.evaluation.study.profiles import profile_of_study
from skillwrapper.evaluation.study.scoring import mean_accuracy, score_predicate
from skillwrapper.evaluation.study.subjects import subject_of
from skillwrapper.evaluation.study.tables import EMBEDDED_NOTE, perception_tables
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.estimated_noise import print_profile
from skillwrapper.runs.launch import learn
from skillwrapper.runs.settings import RunSettings
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.vlm.store import CallStore
from skillwrapper.world.types import Object

CUP, JUG = Object("cup", ("thing",)), Object("jug", ("thing",))
FULL = Predicate("full", ("thing",))


def labels(cup: bool | None, jug: bool | None) -> dict[Atom, bool | None]:
    return {Atom("full", ("cup",)): cup, Atom("full", ("jug",)): jug}


def test_a_lifted_predicate_is_right_only_if_all_its_groundings_are() -> None:
    truth = [labels(True, False), labels(True, True), labels(False, False)]
    read = [labels(True, False), labels(True, False), labels(True, None)]
    score = score_predicate(FULL, (CUP, JUG), truth, read)
    assert (score.readings, score.true) == (6, 3)
    assert (score.false_positives, score.false_negatives, score.unknown) == (1, 1, 1)
    assert score.accuracy == pytest.approx(3 / 6)
    assert score.lifted_accuracy == pytest.approx(1 / 3)


def test_the_papers_figure_over_all_predicates_is_the_mean_of_its_table() -> None:
    """Table of the Franka: 60, 60, 100, 100, 100, 100; printed over all predicates: 86.7."""
    wrong, right = [labels(False, False)] * 2, [labels(True, True)] * 3
    truth = [labels(True, True)] * 5
    sixty = score_predicate(FULL, (CUP, JUG), truth, [*wrong, *right])
    hundred = score_predicate(FULL, (CUP, JUG), truth, truth)
    mean = mean_accuracy([sixty] * 2 + [hundred] * 4, lifted=True)
    printed = published_figures(find_domain("burger")).perception.conditions["clean"][0]
    assert mean == pytest.approx(printed, abs=5e-4)


@pytest.fixture(scope="module")
def study() -> PerceptionStudy:
    models = [StudiedModel("embedded"), StudiedModel("embedded", "gpt5")]
    conditions = find_conditions(["clean", "layouts", "drawing"])
    return study_perception(subject_of("burger", pictures=12), models, conditions)


def test_without_noise_the_usual_pictures_are_read_rightly(study: PerceptionStudy) -> None:
    for name in ("clean", "layouts"):
        result = study.result(StudiedModel("embedded"), CONDITIONS[name])
        assert result.lifted_accuracy == result.accuracy == 1.0
        noisy = study.result(StudiedModel("embedded", "gpt5"), CONDITIONS[name])
        assert 0.5 < noisy.lifted_accuracy <= noisy.accuracy < 1.0


def test_a_drawing_that_the_reader_does_not_know_is_unknown_and_not_false(
    study: PerceptionStudy,
) -> None:
    result = study.result(StudiedModel("embedded"), CONDITIONS["drawing"])
    assert result.lifted_accuracy == 0.0
    assert all(s.unknown == s.readings and s.false_negatives == 0 for s in result.scores)


def test_the_papers_figures_and_the_stand_in_are_named(study: PerceptionStudy) -> None:
    overall, *by_predicate = perception_tables(study)
    assert len(by_predicate) == len(study.results)
    assert overall.rows[0][-1] == "86.7 % / 98.5 %"
    assert overall.rows[1][-1] == ""
    assert EMBEDDED_NOTE in overall.notes
    text = overall.to_markdown()
    assert text.count("\n| ") == 2 + len(overall.rows) - 1 + 1
    assert study.to_json()["results"][0]["embedded"] is True


def test_distortions_change_pictures_and_keep_their_size() -> None:
    seen = BurgerEnvironment().set_state(BurgerState(), seed=1)
    shown = {name: condition.apply(seen) for name, condition in CONDITIONS.items()}
    for name, condition in CONDITIONS.items():
        assert (shown[name].key == seen.key) is (condition.distort is None)
        assert shown[name].pictures[0].png[16:24] == seen.pictures[0].png[16:24]


def test_unknown_conditions_models_and_domains_are_named() -> None:
    with pytest.raises(UnknownNameError, match="did you mean 'blur'"):
        find_conditions(["blurr"])
    with pytest.raises(UnknownNameError, match="unknown domain"):
        subject_of("burgr")
    with pytest.raises(UnknownNameError), open_studied(StudiedModel("embeded"), "burger"):
        pass


def test_a_models_noise_can_be_part_of_its_name() -> None:
    assert StudiedModel.parse("embedded:gpt5", "none") == StudiedModel("embedded", "gpt5")
    assert StudiedModel.parse("embedded", "gpt5") == StudiedModel("embedded", "gpt5")
    assert StudiedModel.parse("openai:gpt-5", "gpt5") == StudiedModel("openai:gpt-5")


def test_the_learned_predicates_of_a_run_are_studied_too(tmp_path: Path) -> None:
    run = tmp_path / "run"
    exploration = ExplorationSettings(budget=20)
    learn(RunSettings(domain="burger", seed=5, iterations=1, exploration=exploration), run)
    subject = subject_of(str(run), pictures=4)
    found = study_perception(subject, [StudiedModel("embedded")], find_conditions(["clean"]))
    assert found.results[0].accuracy == 1.0
    assert "true by the embedded model without noise" in found.origin


@pytest.fixture
def label_file(tmp_path: Path) -> Path:
    environment = BurgerEnvironment()
    (tmp_path / "start.png").write_bytes(environment.reset(seed=5).pictures[0].png)
    path = tmp_path / "labels.yaml"
    path.write_text(
        "start.png:\n- hand_empty(robot)\n- station_free(stove)\n- station_free(board)\n"
        + "".join(f"- nothing_on({i})\n" for i in ("lettuce", "patty", "topbun", "bottombun"))
    )
    return path


def test_pictures_of_ones_own_bring_their_labels(label_file: Path) -> None:
    subject = subject_of("burger", labels=label_file)
    conditions = find_conditions(["clean", "layouts"])
    found = study_perception(subject, [StudiedModel("embedded")], conditions)
    assert found.pictures == 1
    assert found.left_out == ("layouts",)
    assert found.results[0].lifted_accuracy == 1.0


def test_a_label_that_is_no_atom_is_named_with_its_line(label_file: Path) -> None:
    label_file.write_text("start.png:\n- hand_empy(robot)\n")
    with pytest.raises(UnknownNameError, match=r"labels\.yaml:1: .*did you mean 'hand_empty"):
        subject_of("burger", labels=label_file)
    label_file.write_text("start.png: yes\n")
    with pytest.raises(ConfigurationError, match="expected a list of true atoms"):
        subject_of("burger", labels=label_file)


def test_kept_calls_are_not_made_again(label_file: Path, tmp_path: Path) -> None:
    calls = tmp_path / "calls.sqlite"
    subject = subject_of("burger", labels=label_file)
    for _ in range(2):
        study_perception(
            subject, [StudiedModel("embedded")], find_conditions(["clean"]), calls=calls
        )
    with CallStore(calls, read_only=True) as store:
        assert {total.role: (total.made, total.served) for total in store.totals()} == {
            "evaluate": (1, 1),
        }


def test_one_of_a_domains_drawings_is_a_condition() -> None:
    chalk, oil = find_conditions(["drawing:chalk", "drawing:oil"])
    subject = subject_of("burger", pictures=2)
    assert (subject.supports(chalk), subject.supports(oil)) == (True, False)
    assert len(subject.samples(chalk)) == 2


def test_a_profile_tells_the_counts_of_one_model_under_one_condition(
    study: PerceptionStudy, tmp_path: Path
) -> None:
    """What is written can be read back, and errs as the model did."""
    noisy = study.result(StudiedModel("embedded", "gpt5"), CONDITIONS["clean"])
    with pytest.raises(ConfigurationError, match="one model and one condition"):
        profile_of_study(study)
    path = tmp_path / "measured.yaml"
    path.write_text(print_profile(profile_of_study(replace(study, results=(noisy,)))))
    profile = read_profile(path)
    assert profile.clean_pictures == pytest.approx(noisy.clean, abs=1e-3)
    counted = {f.name: (f.false_positives, f.false_negatives) for f in profile.facts}
    assert counted == {s.predicate: (s.false_positives, s.false_negatives) for s in noisy.scores}
    assert sum(map(sum, counted.values())) > 0
