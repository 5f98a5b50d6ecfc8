"""Ways over a skill that led elsewhere are relied on again once that is explained."""

from __future__ import annotations

from notebook import make_domain, picture

from skillwrapper.exploration.memory import Memory
from skillwrapper.world.episode import Transition
from skillwrapper.world.skills import SkillInstance

ROOM = make_domain(types={"cup": ()}, objects={"a": "cup", "b": "cup"}, skills={"Take": "cup"})
TAKE = SkillInstance("Take", ("a",))
OTHER = SkillInstance("Take", ("b",))


def attempt(memory: Memory, instance: SkillInstance) -> None:
    seen = picture(f"#{len(memory.signatures)}")
    memory.note(ROOM.scene(), Transition(seen, instance, False, seen))


def remembering(*, kept: bool) -> Memory:
    memory = Memory(ROOM)
    memory.start(ROOM.scene())
    attempt(memory, TAKE)
    memory.rely(TAKE, kept=kept)
    return memory


def reliability(memory: Memory, unexplained: set[int]) -> float:
    scene = memory.scene(ROOM.scene())
    return float(memory.reliability(scene, unexplained)[scene.number[TAKE]])


def test_what_always_led_where_it_should_is_relied_on() -> None:
    assert reliability(remembering(kept=True), set()) == 1


def test_what_led_elsewhere_is_not_as_long_as_that_is_unexplained() -> None:
    memory = remembering(kept=False)
    for _ in range(20):
        attempt(memory, OTHER)
    assert reliability(memory, {0}) < 0.5


def test_once_explained_it_is_relied_on_again_bit_by_bit() -> None:
    memory = remembering(kept=False)
    shares = []
    for _ in range(20):
        shares.append(reliability(memory, set()))
        attempt(memory, OTHER)
    assert shares == sorted(shares)
    assert shares[0] < 0.5
    assert shares[-1] > 0.95
