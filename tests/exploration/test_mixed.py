"""Proposed sequences compete with plans by the same measure."""

from __future__ import annotations

from house import HOUSE, House

from skillwrapper.exploration.mixed import MixedExplorer
from skillwrapper.exploration.planned import PlannedExplorer
from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.world import SkillInstance

OPEN_FRONT, OPEN_BACK = (SkillInstance("Open", ("h", door)) for door in ("front", "back"))
LIGHT = SkillInstance("Light", ("h", "lamp"))
SETTINGS = ExplorationSettings(budget=3, least_length=3)


class Proposer:
    def __init__(self, *sequences: tuple[SkillInstance, ...]) -> None:
        self.sequences, self.asked = sequences, 0

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        self.asked += 1
        return ProposalAnswer(self.sequences)


def known_house(explorer: MixedExplorer) -> House:
    """All was tried at the start, and the doors were opened."""
    house = House()
    ties = [i for i in HOUSE.skill_instances if i.skill == "Tie"]
    for attempt in (*ties, LIGHT, OPEN_FRONT, OPEN_BACK):
        house.run(attempt)
    explorer.record(house.reset())
    return house


def test_a_sequence_is_followed_where_all_its_skills_together_are_worth_more() -> None:
    """A plan has the lamp behind the doors in view; the sequence counts the doors too."""
    proposer = Proposer((OPEN_FRONT, OPEN_BACK, LIGHT))
    explorer = MixedExplorer(HOUSE, proposer, SETTINGS, 0)
    house = known_house(explorer)
    chosen = explorer.next_skill(house.situation(3))
    assert chosen.instance == OPEN_FRONT
    assert chosen.reason.startswith("follows proposed sequence 1")
    house.run(OPEN_FRONT)
    assert explorer.next_skill(house.situation(2)).instance is not None
    assert proposer.asked == 1


def test_a_sequence_is_left_when_something_else_was_done() -> None:
    house = House()
    explorer = MixedExplorer(HOUSE, Proposer((OPEN_FRONT, OPEN_BACK, LIGHT)), SETTINGS, 0)
    explorer.next_skill(house.situation(3))
    house.run(SkillInstance("Tie", ("h", "front", "back")))
    assert "proposed" not in explorer.next_skill(house.situation(2)).reason


def test_what_a_sequence_is_worth_on_its_way() -> None:
    """The model knows that the front door opens; so what follows is looked at behind it."""
    house = House()
    house.run(OPEN_FRONT)
    house.reset()
    explorer = PlannedExplorer(HOUSE, SETTINGS, 0)
    explorer.think(house.situation(3))
    values = explorer.follow(house.situation(3), [OPEN_FRONT, OPEN_BACK, LIGHT])
    assert values.shape == (3,)
    assert values[2] > values[0]
    assert (values >= 0).all()
