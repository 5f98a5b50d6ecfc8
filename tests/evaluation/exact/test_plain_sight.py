"""What is read in plain sight is what the embedded model without noise answers."""

from __future__ import annotations

from itertools import product

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.embedded.lexicon import all_concepts
from skillwrapper.embedded.model import EmbeddedModel
from skillwrapper.evaluation.exact.plain_sight import PlainSight
from skillwrapper.grounding import UNKNOWN, AtomSpace
from skillwrapper.perception.truth_table import TruthTable
from skillwrapper.symbols import Predicate
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.world.observation import Observation, Picture

TYPES = {"item": "pickupable", "station": "station", "robot": "robot"}


def every_concept() -> tuple[Predicate, ...]:
    """A predicate for every concept of the lexicon, by its name and every meaning."""
    found = {}
    for concept in all_concepts(("board", "stove")):
        choices = [TYPES.values() if k == "any" else (TYPES.get(k),) for k in concept.kinds]
        for number, types in enumerate(product(*choices)):
            if None not in types and types:
                name = f"{concept.names[0]}_{number}"
                meaning = concept.describe(concept.meanings[0], types)
                found[name] = Predicate(name, types, meaning)
    return (*found.values(), Predicate("is_happy", ("pickupable",), "It is in a good mood."))


def test_the_same_labels_as_by_prompts_and_replies() -> None:
    kitchen = BurgerEnvironment()
    kitchen.reset(seed=11)
    states = kitchen.reachable_states()[::400]
    pictures = [kitchen.observe_state(state) for state in states]
    space = AtomSpace(every_concept(), kitchen.domain.objects)
    by_prompts = TruthTable(kitchen.domain, Assistant(ModelSet.of(EmbeddedModel())))
    labels = PlainSight().labels(space, pictures)
    assert (labels == by_prompts.labels(space, pictures)).all()
    assert (labels[:, -4:] == UNKNOWN).all()
    assert len(space.predicates) > 40


def test_a_picture_of_something_else() -> None:
    blank = Observation((Picture(b"no picture"),))
    kitchen = BurgerEnvironment()
    space = AtomSpace(every_concept()[:2], kitchen.domain.objects)
    assert (PlainSight().labels(space, [blank]) == UNKNOWN).all()
