"""What only things of some types ever become is said of these alone (D3, D9)."""

from __future__ import annotations

from notebook import Notebook, make_domain

from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.pruning import Pruned, prune
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate

KITCHEN = make_domain(
    types={"food": (), "fruit": ("food",)},
    objects={"apple": "fruit", "pear": "fruit", "bread": "food"},
    skills={"Peel": "fruit", "Take": "food"},
)
PEELED, HELD = Predicate("peeled", ("food",), "the food is peeled."), Predicate("held", ("food",))
OF_FRUIT = Predicate("peeled", ("fruit",), "the fruit is peeled.")


class Doubting(Labeller):
    """Takes a fiftieth of all readings for wrong."""

    @property
    def misread(self) -> float:
        return 0.02


def pruned(
    notebook: Notebook, words: Vocabulary, labeller: type[Labeller] = Doubting
) -> tuple[Pruned, ...]:
    return prune(Fitter(labeller(notebook.recorded, notebook), FaithfulLearner()), words)


def peeling() -> Notebook:
    notebook = Notebook(KITCHEN)
    for fruit in ("apple", "pear"):
        notebook.success("", f"Peel({fruit})", f"peeled({fruit})")
        notebook.failure(f"peeled({fruit})", f"Peel({fruit})")
    for food in ("apple", "bread"):
        notebook.success("", f"Take({food})", f"held({food})")
        notebook.failure(f"held({food})", f"Take({food})")
    return notebook


def test_what_a_skill_does_to_some_types_is_said_of_these() -> None:
    words = Vocabulary(KITCHEN.types, (PEELED, HELD))
    (narrowed,) = pruned(peeling(), words)
    assert (narrowed.predicate, narrowed.instead) == (PEELED, OF_FRUIT)
    assert set(words.active) == {OF_FRUIT, HELD}
    assert not words.dormant


def test_what_something_else_hangs_on_stays_as_wide() -> None:
    """Peeled things cannot be taken, and the skill takes all kinds of food."""
    notebook = peeling()
    notebook.failure("peeled(apple)", "Take(apple)")
    words = Vocabulary(KITCHEN.types, (PEELED, HELD))
    assert pruned(notebook, words) == ()
    assert set(words.active) == {PEELED, HELD}


def test_where_readings_are_taken_for_right_nothing_is_read_anew() -> None:
    words = Vocabulary(KITCHEN.types, (PEELED, HELD))
    assert pruned(peeling(), words, Labeller) == ()
    assert set(words.active) == {PEELED, HELD}
