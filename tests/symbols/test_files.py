"""What is written is read back exactly; what is wrong is said with file and line."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from model_strategies import DOMAIN, models, predicates

from skillwrapper.domains.burger.expert import expert_model
from skillwrapper.errors import ConfigurationError, UnknownNameError, UserError
from skillwrapper.symbols import AbstractModel, Predicate
from skillwrapper.symbols.files import (
    model_to_json,
    predicates_to_yaml,
    read_model,
    read_predicates,
)


@settings(max_examples=60, deadline=None)
@given(models())
def test_model_round_trip(model: AbstractModel) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "model.json")
        path.write_text(model_to_json(model), encoding="utf-8")
        again = read_model(path, DOMAIN)
        assert again == model
        assert [p.semantics for p in again.predicates] == [p.semantics for p in model.predicates]
        assert model_to_json(again) == path.read_text(encoding="utf-8")


@settings(max_examples=60, deadline=None)
@given(predicates())
def test_predicates_round_trip(vocabulary: tuple[Predicate, ...]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "predicates.yaml")
        path.write_text(predicates_to_yaml(vocabulary), encoding="utf-8")
        again = read_predicates(path, DOMAIN)
        assert again == vocabulary
        assert [p.semantics for p in again] == [p.semantics for p in vocabulary]


def broken(tmp_path: Path, old: str, new: str) -> str:
    """The message about the expert's model after a replacement in its file."""
    path = tmp_path / "model.json"
    text = model_to_json(expert_model())
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(UserError) as raised:
        read_model(path, expert_model().domain)
    assert str(path) in str(raised.value)
    return str(raised.value)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('"domain": "burger"', '"domain": "pizza"', "expected a model of the domain 'burger'"),
        ('"robot"', '"robott"', "model.json:4: unknown type 'robott'; did you mean 'robot'?"),
        ('"skill": "Cook"', '"skill": "Coook"', "operator Cook: unknown skill 'Coook'"),
        ('"arity": 2', '"arity": "two"', "'operators.0.arity'"),
        ('"arity": 2', '"arity": 1', "expected the 2 parameters of Cook first"),
        (
            '"holds"',
            '"hold"',
            "preconditions.0.hold'; did you mean 'holds'?",
        ),
        ('"?item"', '"?thing"', "operator Cook: expected '?item' of"),
        ('"hand_empty"', '"hand empty"', "expected a predicate name"),
        ('"name": "holding"', '"name": "hand_empty"', "is defined twice"),
        ("{", "[", "expected valid YAML"),
    ],
)
def test_mistakes_in_a_model(tmp_path: Path, old: str, new: str, expected: str) -> None:
    assert expected in broken(tmp_path, old, new)


def test_wrong_number_of_terms(tmp_path: Path) -> None:
    data = json.loads(model_to_json(expert_model()))
    data["operators"][0]["add_effects"] = [["is_cooked"]]
    path = tmp_path / "model.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    with pytest.raises(ConfigurationError, match="expected 1 terms of is_cooked, got 0"):
        read_model(path, expert_model().domain)


def test_unknown_type_in_predicates(tmp_path: Path) -> None:
    path = tmp_path / "predicates.yaml"
    path.write_text("predicates:\n- name: clear\n  types: [pickupabel]\n", encoding="utf-8")
    with pytest.raises(UnknownNameError, match=r"predicates.yaml:2: .* did you mean 'pickupable'"):
        read_predicates(path, expert_model().domain)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="cannot be read"):
        read_model(tmp_path / "none.json", DOMAIN)
