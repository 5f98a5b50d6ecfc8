from __future__ import annotations

import pytest

from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.world import Object, TypeHierarchy


@pytest.fixture
def diamond() -> TypeHierarchy:
    return TypeHierarchy(
        {"thing": (), "food": ("thing",), "tool": ("thing",), "cutlery": ("food", "tool")}
    )


def test_ancestors_go_through_every_parent(diamond: TypeHierarchy) -> None:
    assert diamond.ancestors["cutlery"] == {"cutlery", "food", "tool", "thing"}
    assert diamond.ancestors["thing"] == {"thing"}


def test_subtype_is_reflexive_and_directed(diamond: TypeHierarchy) -> None:
    assert diamond.is_subtype("food", of="food")
    assert diamond.is_subtype("cutlery", of="thing")
    assert not diamond.is_subtype("thing", of="cutlery")


def test_closure_and_most_specific_undo_each_other(diamond: TypeHierarchy) -> None:
    closure = diamond.closure(["food", "tool"])
    assert closure == {"food", "tool", "thing"}
    assert diamond.most_specific(closure) == ("food", "tool")
    assert diamond.most_specific(diamond.closure(["cutlery"])) == ("cutlery",)


def test_only_single_parents_make_a_tree(diamond: TypeHierarchy) -> None:
    assert not diamond.is_tree()
    assert TypeHierarchy({"thing": (), "food": ("thing",)}).is_tree()


def test_cycle_is_named() -> None:
    with pytest.raises(ConfigurationError, match="form a cycle: a -> b -> a"):
        TypeHierarchy({"a": ("b",), "b": ("a",)})


def test_unknown_parent_gets_a_hint() -> None:
    with pytest.raises(UnknownNameError, match="'thign'; did you mean 'thing'"):
        TypeHierarchy({"thing": (), "food": ("thign",)})


def test_object_has_all_or_not() -> None:
    knife = Object("knife", ("cutlery", "tool"))
    assert knife.has_types(["tool", "cutlery"])
    assert not knife.has_types(["tool", "food"])
