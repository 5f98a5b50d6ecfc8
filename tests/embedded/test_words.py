"""Words: read from files, joined over domains, and bare names where there are none."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillwrapper.embedded.words import Words, general_words, joined_words, read_words
from skillwrapper.errors import ConfigurationError


def test_the_general_words_name_no_world() -> None:
    words = general_words()
    assert set(words.relations) == {"held", "in", "on"}
    assert not words.attributes
    assert all(not relation.between for relation in words.relations.values())


def test_what_has_no_words_is_called_by_its_name() -> None:
    words = Words()
    assert words.attribute("dusty").names == ("is_dusty",)
    assert words.attribute("dusty").opposite.meanings == ("the {0} is not dusty",)
    assert words.condition("raining").names == ("it_is_raining",)
    tied_to = words.relation("tied_to")
    assert tied_to.direct is not None
    assert tied_to.direct.meanings == ("the {0} is tied to the {1}",)
    assert tied_to.vacant is not None
    assert tied_to.inverse is None


def test_own_words_take_the_place_of_bare_ones_and_add_to_cues() -> None:
    own = Words.model_validate({"attributes": {"dusty": {"names": ["grey"], "cues": ["grey"]}}})
    words = own.attribute("dusty")
    assert words.names == ("grey",)
    assert words.meanings == ("the {0} is dusty",)
    assert words.cues == ("grey", "dusty")


def test_words_of_several_domains_are_joined() -> None:
    one = Words.model_validate(
        {"relations": {"on": {"between": [["cup", "desk"]]}}, "look_alikes": [["a", "b"]]}
    )
    two = Words.model_validate({"relations": {"on": {"between": [["pot", "desk"]]}}})
    joined = joined_words((one, two))
    assert set(joined.relation("on").between) == {("cup", "desk"), ("pot", "desk")}
    assert joined.look_alikes == (("a", "b"),)
    assert joined.relation("on").direct == general_words().relations["on"].direct


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("attributes: {wet: {name: [damp]}}", "unknown key.*did you mean 'names'"),
        ("attributes: {wet: {cues: ['(damp']}}", "expected a regular expression"),
        ("relations: {in: {between: [[cup]]}}", "between"),
        ("attributes: [", "expected valid YAML"),
    ],
)
def test_mistakes_are_named_with_their_place(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "words.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError, match=rf"words\.yaml:1.*{message}"):
        read_words(path)
