"""Operators of clusters: types, names, effects (D1 to D4)."""

from __future__ import annotations

import numpy as np
from notebook import Notebook, atom, make_domain

from skillwrapper.grounding import UNKNOWN, GroundModel
from skillwrapper.symbols import Literal, Operator, Predicate, Variable

ZOO = make_domain(
    types={
        "keeper": (),
        "animal": (),
        "bird": ("animal",),
        "pet": ("animal",),
        "cage": (),
    },
    objects={
        "k": "keeper",
        "parrot": "bird pet",
        "eagle": "bird",
        "cat": "pet",
        "cow": "animal",
        "c1": "cage",
        "c2": "cage",
    },
    skills={"Feed": "keeper animal", "Lock": "keeper cage"},
)
FED = Predicate("fed", ("animal",))
FLIES = Predicate("flies", ("bird",))
IN = Predicate("in", ("animal", "cage"))
SHUT = Predicate("shut", ("cage",))


def operators(notebook: Notebook, skill: str = "Feed") -> list[Operator]:
    return [o.operator for o in notebook.fit_skill(skill).operators]


def fed(*animals: str) -> Notebook:
    notebook = Notebook(ZOO, FED)
    for animal in animals:
        notebook.success("", f"Feed(k, {animal})", f"fed({animal})")
    return notebook


def test_the_most_specific_type_of_all_seen() -> None:
    """D3: an object may be of several types, none of which implies another."""
    types = {
        ("parrot",): ("bird", "pet"),
        ("parrot", "eagle"): ("bird",),
        ("parrot", "cat"): ("pet",),
        ("eagle", "cat"): ("animal",),
        ("parrot", "cow"): ("animal",),
    }
    for animals, expected in types.items():
        (operator,) = operators(fed(*animals))
        assert operator.parameters == (
            Variable("?keeper_0", ("keeper",)),
            Variable("?animal_1", expected),
        )
        assert operator.arity == 2


def test_effect_context_becomes_a_parameter() -> None:
    """D2: never by identity; another cage is another binding of the same operator."""
    notebook = Notebook(ZOO, FED, IN)
    notebook.success("in(cow, c1)", "Feed(k, cow)", "fed(cow)")
    notebook.success("in(cat, c2)", "Feed(k, cat)", "fed(cat)")
    (operator,) = operators(notebook)
    assert operator.context == (Variable("?other_cage", ("cage",)),)
    assert operator.add_effects == {atom("fed(?animal_1)")}
    assert operator.delete_effects == {atom("in(?animal_1, ?other_cage)")}
    assert Literal(atom("in(?animal_1, ?other_cage)")) in operator.preconditions


def test_context_of_the_same_type_gets_numbers() -> None:
    notebook = Notebook(ZOO, IN)
    notebook.success("in(cow, c1)", "Feed(k, cow)", "in(cow, c2)")
    (operator,) = operators(notebook)
    assert [v.name for v in operator.context] == ["?other_cage", "?other_cage_2"]


def test_names_of_context_never_hide_parameters() -> None:
    domain = make_domain(
        types={"a": (), "other_a_0": ()},
        objects={"x": "other_a_0", "y": "a", "z": "a"},
        skills={"Do": "other_a_0"},
    )
    near = Predicate("near", ("other_a_0", "a"))
    notebook = Notebook(domain, near)
    notebook.success("near(x, y)", "Do(x)", "near(x, z)")
    (operator,) = operators(notebook, "Do")
    assert len({v.name for v in operator.parameters}) == 3


def test_context_objects_without_a_common_type() -> None:
    near = Predicate("near", ("keeper", "animal"))
    beside = Predicate("beside", ("keeper", "cage"))
    notebook = Notebook(ZOO, near, beside, FED)
    notebook.success("", "Feed(k, cow)", "near(k, cat)")
    notebook.success("", "Feed(k, cow)", "beside(k, c1)")
    found = operators(notebook)
    assert [o.context[0].types for o in found] == [("cage",), ("pet",)]


def test_literals_need_the_type_in_every_transition() -> None:
    """``flies`` says nothing of a cow, so it is no condition of feeding animals."""
    notebook = Notebook(ZOO, FED, FLIES)
    notebook.success("flies(eagle)", "Feed(k, eagle)", "flies(eagle) fed(eagle)")
    (operator,) = operators(notebook)
    assert Literal(atom("flies(?animal_1)")) in operator.preconditions
    notebook.success("flies(eagle)", "Feed(k, cow)", "flies(eagle) fed(cow)")
    (operator,) = operators(notebook)
    assert operator.preconditions == {Literal(atom("fed(?animal_1)"), False)}


def test_different_parameters_are_different_objects() -> None:
    """D4"""
    notebook = Notebook(ZOO, FED, IN)
    notebook.success("in(cow, c1)", "Feed(k, cow)", "in(cow, c2)")
    model = notebook.fit(FED, IN).model
    ground = GroundModel.of(model, ZOO.objects)
    unknown = np.full((1, len(ground.space.atoms)), UNKNOWN, dtype=np.int8)
    bound = [objects for bindings in ground.bind_all(unknown) for objects in bindings.objects]
    assert bound
    assert all(len(set(objects)) == len(objects) for objects in bound)


def test_one_operator_for_each_change() -> None:
    notebook = Notebook(ZOO, FED, SHUT)
    notebook.success("", "Lock(k, c1)", "shut(c1)")
    notebook.success("shut(c2)", "Lock(k, c2)", "")
    notebook.success("", "Lock(k, c2)", "shut(c2)")
    found = operators(notebook, "Lock")
    assert [o.name for o in found] == ["Lock_1", "Lock_2"]
    assert [(o.add_effects, o.delete_effects) for o in found] == [
        (set(), {atom("shut(?cage_1)")}),
        ({atom("shut(?cage_1)")}, set()),
    ]


def test_nothing_depends_on_the_names_of_objects_or_the_order_of_episodes() -> None:
    """D14"""
    steps = [
        ("in(cow, c1) in(eagle, c1)", "Feed(k, cow)", "in(eagle, c1) fed(cow)"),
        ("in(cat, c2)", "Feed(k, cat)", "fed(cat)"),
        ("", "Feed(k, eagle)", "fed(eagle)"),
    ]
    swapped = [
        tuple(t.replace("c1", "c0").replace("c2", "c1").replace("c0", "c2") for t in s)
        for s in steps
    ]
    found = []
    for some in (steps, steps[::-1], swapped):
        notebook = Notebook(ZOO, FED, IN)
        for step in some:
            notebook.success(*step)
        found.append(operators(notebook))
    assert found[0] == found[1] == found[2]
