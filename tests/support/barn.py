"""Crates that a hand lifts, to learn and to explore what lifting needs."""

from __future__ import annotations

from notebook import Notebook, atom, make_domain

from skillwrapper.symbols import Absence, Literal, Predicate

BARN = make_domain(
    types={"hand": (), "crate": (), "frail": ("crate",), "shelf": (), "low": ("shelf",)},
    objects={"h": "hand", "a": "crate", "b": "crate", "f": "frail", "s": "shelf", "l": "low"},
    skills={"Lift": "hand crate"},
)
FULL = Predicate("full", ("hand",))
ON = Predicate("on", ("crate", "crate"))
AT = Predicate("at", ("crate", "shelf"))
HELD = Predicate("held", ("crate",))

EMPTY_HAND = Literal(atom("full(?hand_0)"), False)
NOT_HELD = Literal(atom("held(?crate_1)"), False)
NOTHING_ATOP = Absence(atom("on(?any, ?crate_1)"), ("?any",))
ON_NOTHING = Absence(atom("on(?crate_1, ?any)"), ("?any",))


def barn(*failures: str, crates: str = "ab") -> Notebook:
    """Crates that were lifted from nowhere, and failures to lift ``a``."""
    notebook = Notebook(BARN, FULL, ON, HELD)
    for crate in crates:
        notebook.success("", f"Lift(h, {crate})", f"full(h) held({crate})")
    for state in failures:
        notebook.failure(state, "Lift(h, a)")
    return notebook
