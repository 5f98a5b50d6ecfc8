"""D5: an operator that predicts more than one change is split before a predicate is invented."""

from __future__ import annotations

from notebook import Notebook, atom, make_domain

from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols import Literal, Predicate

LAUNDRY = make_domain(
    types={
        "robot": (),
        "thing": (),
        "shirt": ("thing",),
        "stone": ("thing",),
        "basket": (),
        "shelf": (),
    },
    objects={
        "r": "robot",
        "shirt1": "shirt",
        "shirt2": "shirt",
        "stone1": "stone",
        "stone2": "stone",
        "b1": "basket",
        "b2": "basket",
        "s1": "shelf",
        "s2": "shelf",
    },
    skills={"Wash": "robot thing", "Move": "robot"},
    failures_change_nothing=True,
)
WET = Predicate("wet", ("thing",))
SOFT = Predicate("soft", ("thing",))
TIRED = Predicate("tired", ("robot",))
ON = Predicate("on", ("basket", "shelf"))
CHOSEN = Predicate("chosen", ("robot", "basket"))


def test_split_by_types() -> None:
    """Washing makes shirts soft and stones only wet."""
    notebook = Notebook(LAUNDRY, WET, SOFT, TIRED)
    for item in ("shirt1", "shirt2"):
        notebook.success("", f"Wash(r, {item})", f"wet({item}) soft({item})")
    for item in ("stone1", "stone2"):
        notebook.success("", f"Wash(r, {item})", f"wet({item})")
    fit = notebook.fit_skill("Wash")
    found = {o.operator.parameters[1].types: o.operator.add_effects for o in fit.operators}
    assert found == {
        ("shirt",): {atom("wet(?thing_1)"), atom("soft(?thing_1)")},
        ("stone",): {atom("wet(?thing_1)")},
    }
    assert fit.inconsistencies == ()


def test_clusters_are_split_only_where_it_helps() -> None:
    """Two shirts that came out differently: types tell nothing, both operators are kept."""
    notebook = Notebook(LAUNDRY, WET, SOFT)
    notebook.success("", "Wash(r, shirt1)", "wet(shirt1) soft(shirt1)")
    notebook.success("", "Wash(r, stone1)", "wet(stone1) soft(stone1)")
    notebook.success("", "Wash(r, shirt1)", "wet(shirt1)")
    fit = notebook.fit_skill("Wash")
    assert len(fit.operators) == 2
    assert {i.kind for i in fit.inconsistencies} == {InconsistencyKind.DETERMINISM}


def test_one_cluster_may_be_split_into_several_types() -> None:
    """Stones and shirts become wet and soft, but one kind only if the robot is fresh."""
    notebook = Notebook(LAUNDRY, WET, SOFT, TIRED)
    for item in ("shirt1", "stone1"):
        notebook.success("", f"Wash(r, {item})", f"wet({item}) soft({item})")
    notebook.success("tired(r)", "Wash(r, stone1)", "tired(r) wet(stone1) soft(stone1)")
    notebook.success("tired(r)", "Wash(r, shirt1)", "tired(r) wet(shirt1)")
    fit = notebook.fit_skill("Wash")
    names = [o.operator.name for o in fit.operators]
    assert names == ["Wash_1", "Wash_2", "Wash_3"]
    assert fit.inconsistencies == ()


def swap(notebook: Notebook) -> None:
    """The basket that is chosen changes places with nothing; two baskets, two shelves."""
    for basket, here, there in (("b1", "s1", "s2"), ("b2", "s2", "s1")):
        other = "b2" if basket == "b1" else "b1"
        notebook.success(
            f"chosen(r, {basket}) on({basket}, {here}) on({other}, {here})",
            "Move(r)",
            f"on({basket}, {there}) on({other}, {here})",
        )


def test_literals_between_context_objects_tell_bindings_apart() -> None:
    """The chosen basket leaves the shelf it is on; any other binding predicts another change."""
    notebook = Notebook(LAUNDRY, CHOSEN, ON)
    swap(notebook)
    fit = notebook.fit_skill("Move")
    (learned,) = fit.operators
    between = Literal(atom("on(?other_basket, ?other_shelf)"))
    assert between in learned.operator.preconditions
    assert fit.inconsistencies == ()


def test_without_need_there_are_none() -> None:
    """With a single shelf to leave and to reach, the bindings are told apart already."""
    notebook = Notebook(LAUNDRY, CHOSEN, ON)
    notebook.episode(("chosen(r, b1) on(b1, s1)", "Move(r)", True, ""), scene=("r", "b1", "s1"))
    (learned,) = notebook.fit_skill("Move").operators
    predicates = {p.atom.predicate for p in learned.operator.preconditions}
    assert predicates == {"chosen"}


def test_types_that_never_work_together_split_a_cluster() -> None:
    """Shirts hang on shelves and stones lie in baskets; one failure of another pair is no rule."""
    domain = make_domain(
        types={"thing": (), "shirt": ("thing",), "stone": ("thing",)}
        | {"place": (), "basket": ("place",), "shelf": ("place",)},
        objects={"shirt1": "shirt", "stone1": "stone", "b1": "basket", "s1": "shelf"},
        skills={"Put": "thing place"},
        failures_change_nothing=True,
    )
    notebook = Notebook(domain, Predicate("at", ("thing", "place")), WET)
    notebook.success("", "Put(shirt1, s1)", "at(shirt1, s1)")
    notebook.success("", "Put(stone1, b1)", "at(stone1, b1)")
    notebook.failure("", "Put(shirt1, b1)")
    assert len(notebook.fit_skill("Put").operators) == 1
    for number in range(2):
        notebook.failure(f"#{number}", "Put(shirt1, b1)")
    fit = notebook.fit_skill("Put")
    assert {o.operator.parameters[0].types for o in fit.operators} == {("shirt",), ("stone",)}
    assert fit.inconsistencies == ()


def test_a_place_is_empty_once_the_last_thing_is_taken() -> None:
    """What stands around a context object tells the two outcomes apart."""
    domain = make_domain(
        types={"cup": (), "table": ()},
        objects={"a": "cup", "b": "cup", "t": "table", "u": "table"},
        skills={"Take": "cup"},
    )
    on, bare = Predicate("on", ("cup", "table")), Predicate("bare", ("table",))
    notebook = Notebook(domain, on, bare)
    for one, other in (("a", "b"), ("b", "a")):
        for table, free in (("t", "u"), ("u", "t")):
            both, rest = f"on({one}, {table}) on({other}, {table})", f"on({other}, {table})"
            notebook.success(f"{both} bare({free})", f"Take({one})", f"{rest} bare({free})")
            notebook.success(
                f"{rest} bare({free})", f"Take({other})", f"bare({table}) bare({free})"
            )
    fit = notebook.fit_skill("Take")
    assert len(fit.operators) == 2
    assert fit.inconsistencies == ()


PASSAGES = make_domain(
    types={"robot": (), "room": (), "passage": (), "door": ("passage",), "turnstile": ("passage",)},
    objects={"r": "robot", "hall": "room", "shed": "room", "yard": "room"}
    | {"oak": "door", "gate": "turnstile"},
    skills={"Enter": "robot passage room"},
)
INSIDE, SIDE = Predicate("inside", ("robot", "room")), Predicate("side", ("passage", "room"))
SIDES = "side(oak, hall) side(oak, shed) side(gate, hall) side(gate, yard)"


def passages(times_in: int) -> Notebook:
    """A door is passed both ways; a turnstile leads into the yard, and not out of it."""
    notebook = Notebook(PASSAGES)
    for n in range(3):
        for start, goal in (("hall", "shed"), ("shed", "hall")):
            here = f"{SIDES} inside(r, {start}) #{n}"
            notebook.success(here, f"Enter(r, oak, {goal})", f"{SIDES} inside(r, {goal}) #{n}")
        if n < times_in:
            here = f"{SIDES} inside(r, hall) #{n}"
            notebook.success(here, "Enter(r, gate, yard)", f"{SIDES} inside(r, yard) #{n}")
        notebook.failure(f"{SIDES} inside(r, yard) #{n}", "Enter(r, gate, hall)")
    return notebook


def test_what_needs_more_with_one_kind_is_learned_by_itself() -> None:
    fit = passages(3).fit(INSIDE, SIDE)
    assert fit.inconsistencies == ()
    assert {o.operator.parameters[1].types for o in fit.operators} == {("door",), ("turnstile",)}


def test_of_few_successes_of_a_kind_it_is_not_believed() -> None:
    """What they happen to have in common would hide that a predicate is missing."""
    fit = passages(2).fit(INSIDE, SIDE)
    assert fit.inconsistencies
