"""What is read without error is what the embedded model without noise answers."""

from __future__ import annotations

from itertools import product

from seen_kitchen import LEXICON, embedded_model, kitchen

from skillwrapper.domains.discovery import find_domain
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.grounding import UNKNOWN, AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.symbols import Predicate
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.world.observation import Observation, Picture

READER = ExactReader.of(find_domain("burger"))
assert READER is not None
TYPES = {"item": "pickupable", "station": "station", "robot": "robot"}


def every_concept() -> tuple[Predicate, ...]:
    """A predicate for every concept of the lexicon, by its name and every meaning."""
    found = {}
    for concept in LEXICON.concepts(kitchen().graph(kitchen().states[0]).outline):
        for number, kinds in enumerate(product(TYPES, repeat=concept.arity)):
            if concept.fits(kinds):
                types = tuple(TYPES[kind] for kind in kinds)
                name = f"{concept.wording.names[0]}_{number}"
                meaning = concept.describe(concept.wording.meanings[0], types)
                found[name] = Predicate(name, types, meaning)
    return (*found.values(), Predicate("is_happy", ("pickupable",), "It is in a good mood."))


def test_the_same_labels_as_by_prompts_and_replies() -> None:
    world = kitchen()
    pictures = [world.look(state) for state in world.states[::400]]
    space = AtomSpace(every_concept(), world.domain.objects)
    by_prompts = TruthTable(world.domain, Assistant(ModelSet.of(embedded_model())))
    labels = READER.labels(space, pictures)
    assert (labels == by_prompts.labels(space, pictures)).all()
    assert (labels[:, -4:] == UNKNOWN).all()
    assert len(space.predicates) > 40


def test_a_picture_of_something_else() -> None:
    blank = Observation((Picture(b"no picture"),))
    space = AtomSpace(every_concept()[:2], kitchen().domain.objects)
    assert (READER.labels(space, [blank]) == UNKNOWN).all()
