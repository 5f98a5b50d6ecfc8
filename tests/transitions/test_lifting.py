"""Lifted changes: what belongs to them, and that only the roles of objects count."""

from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st
from notebook import atom

from skillwrapper.symbols import Atom, Literal
from skillwrapper.transitions.lifting import MAX_PERMUTED_CONTEXT, lift_change

OBJECTS = "abcdef"
ARGUMENTS = ("a", "b")


def literals(*texts: str) -> list[Literal]:
    """``"+on(a, b)"`` became true, ``"-on(a, b)"`` became false."""
    return [Literal(atom(text[1:]), text[0] == "+") for text in texts]


@st.composite
def changes(draw: st.DrawFn) -> list[Literal]:
    """Changed atoms over two arguments and up to four other objects, a sign each."""
    terms = st.lists(st.sampled_from(OBJECTS), max_size=3, unique=True).map(tuple)
    atoms = draw(st.sets(st.builds(Atom, st.sampled_from("pqr"), terms), max_size=8))
    return [Literal(a, draw(st.booleans())) for a in sorted(atoms)]


@given(changes(), st.permutations(OBJECTS), st.randoms())
def test_renaming_objects_changes_nothing(changed, names, random) -> None:
    renaming = dict(zip(OBJECTS, names, strict=True))
    renamed = [x.substitute(renaming) for x in changed]
    random.shuffle(renamed)
    lifted = lift_change(changed, ARGUMENTS)
    other = lift_change(renamed, [renaming[a] for a in ARGUMENTS])

    assert other.change == lifted.change
    assert set(other.unexplained) == {a.substitute(renaming) for a in lifted.unexplained}


@given(changes())
def test_change_and_unexplained_are_all_of_it(changed) -> None:
    lifted = lift_change(changed, ARGUMENTS)
    back = {
        Literal(Atom(name, tuple(lifted.objects[t] for t in terms)), sign)
        for sign, name, terms in lifted.change
    }
    signs = {x.atom: x.positive for x in changed}
    assert back | {Literal(a, signs[a]) for a in lifted.unexplained} == set(changed)
    assert not {x.atom for x in back} & set(lifted.unexplained)
    assert lifted.objects[:2] == ARGUMENTS


@given(changes())
def test_unexplained_atoms_touch_nothing_that_is_explained(changed) -> None:
    lifted = lift_change(changed, ARGUMENTS)
    for unexplained in lifted.unexplained:
        assert unexplained.terms
        assert not set(unexplained.terms) & set(lifted.objects)


def test_an_effect_may_concern_what_is_no_argument() -> None:
    """D1: picking an item up frees the station under it."""
    changed = literals("+holding(robot, soup)", "-on(soup, stove)", "+free(stove)")
    lifted = lift_change(changed, ("robot", "soup"))
    assert lifted.objects == ("robot", "soup", "stove")
    assert lifted.change == (
        (False, "on", (1, 2)),
        (True, "free", (2,)),
        (True, "holding", (0, 1)),
    )
    assert lifted.unexplained == ()


def test_without_the_relation_the_change_is_unexplained() -> None:
    lifted = lift_change(literals("+holding(robot, soup)", "+free(stove)"), ("robot", "soup"))
    assert lifted.objects == ("robot", "soup")
    assert lifted.unexplained == (atom("free(stove)"),)


def test_nullary_atoms_belong_to_every_change() -> None:
    lifted = lift_change(literals("+dark()"), ("robot",))
    assert lifted.change == ((True, "dark", ()),)
    assert lifted.unexplained == ()


def test_signs_and_arguments_are_told_apart() -> None:
    one = lift_change(literals("+on(a, b)"), ("a", "b")).change
    assert lift_change(literals("-on(a, b)"), ("a", "b")).change != one
    assert lift_change(literals("+on(b, a)"), ("a", "b")).change != one
    assert lift_change(literals("+on(c, d)"), ("c", "d")).change == one


def test_more_context_than_is_permuted_is_still_matched_by_roles() -> None:
    size = MAX_PERMUTED_CONTEXT + 2
    for order in itertools.islice(itertools.permutations(range(size)), 0, 5000, 777):
        changed = [
            x
            for number, name in enumerate(order)
            for x in literals(f"-on(x{name}, tray)", f"+{'wet' if number % 2 else 'dry'}(x{name})")
        ]
        lifted = lift_change(changed, ("tray",))
        assert len(lifted.objects) == 1 + size
        assert [c for c in lifted.change if c[1] == "wet"] == [
            (True, "wet", (n,)) for n in range(5, 8)
        ]


def test_context_of_one_role_is_ordered_by_types() -> None:
    """D2: what is called differently in another transition is matched by its type."""
    changed = literals("+near(robot, a)", "+near(robot, b)")
    one = lift_change(changed, ("robot",), {"a": ("cup",), "b": ("door",)})
    other = lift_change(changed, ("robot",), {"a": ("door",), "b": ("cup",)})
    assert one.change == other.change
    assert (one.objects, other.objects) == (("robot", "a", "b"), ("robot", "b", "a"))
