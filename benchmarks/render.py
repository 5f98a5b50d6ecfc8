"""Frames a second of the burger kitchen, drawn and encoded, on one core.

Run: ``python -m benchmarks.render``.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from skillwrapper.domains.burger.environment import BurgerEnvironment
from skillwrapper.domains.burger.layout import make_layout
from skillwrapper.domains.burger.renderer import BurgerRenderer
from skillwrapper.world.pictures import encode_png

DRAWN_AT_LEAST = 400
ENCODED_AT_LEAST = 150
ROUNDS = 5


def frames_per_second(draw: Callable[[], int]) -> float:
    """The best of several rounds, in processor time, since other programs may run as well."""
    best = 0.0
    for _ in range(ROUNDS):
        start = time.process_time()
        frames = draw()
        best = max(best, frames / (time.process_time() - start))
    return best


def main() -> None:
    """Print frames a second and their ratio to what is asked for."""
    states = BurgerEnvironment().reachable_states()[::12]
    renderer, layout = BurgerRenderer(), make_layout(0)

    def drawn() -> int:
        return sum(1 for state in states if renderer.render(state, layout))

    def encoded() -> int:
        return sum(1 for state in states if encode_png(renderer.render(state, layout)))

    for name, draw, least in (
        ("drawn", drawn, DRAWN_AT_LEAST),
        ("drawn and encoded", encoded, ENCODED_AT_LEAST),
    ):
        speed = frames_per_second(draw)
        print(f"{name}: {speed:.0f} frames/s, {speed / least:.2f} of the {least} asked for")


if __name__ == "__main__":
    main()
