"""A depot, to see how long an iteration takes: 3,900 states, 98 skill instances."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where

_TABLES = "a b c d e"


class Depot(World):
    make = make_domain(
        "depot",
        {"truck": "", "box": "", "table": ""},
        {"cart": "truck", "crate": "box", "case": "box", "chest": "box"}
        | dict.fromkeys((f"table_{name}" for name in _TABLES.split()), "table"),
        {"Drive": "truck table table", "Carry": "truck box table table",
         "Mark": "truck box", "Stamp": "truck box table"},
    )  # fmt: skip

    def start(self) -> Facts:
        places = zip(("crate", "case", "chest"), "abc", strict=True)
        return frozenset({("on", b, f"table_{t}") for b, t in places} | {("by", "cart", "table_a")})

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        here = where(now, "by", "cart")
        taken = {f[2] for f in now if f[0] == "on"}
        match skill, *things[1:]:
            case "Drive", start, goal if start == here:
                return move(now, "by", "cart", goal)
            case "Carry", box, start, goal if (
                start == here == where(now, "on", box) and goal not in taken
            ):
                return move(move(now, "on", box, goal), "by", "cart", goal)
            case "Mark", box if where(now, "on", box) == here:
                return frozenset(f for f in now if f[0] != "marked") | {("marked", box)}
            case "Stamp", box, table if (
                where(now, "on", box) == table == here and ("marked", box) in now
            ):
                return frozenset(f for f in now if f[0] != "stamped") | {("stamped", box)}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        yield concept("box table", "on", "lies_on(0, 1): the {0} lies on the {1}.")
        yield concept("table", lambda f, t: not any(x[0] == "on" and x[2] == t for x in f),
                      "clear(0): nothing lies on the {0}.")  # fmt: skip
        yield concept("truck table", "by", "parked_at(0, 1): the {0} is parked beside the {1}.")
        yield concept("box", "marked", "has_label(0): there is a label on the {0}.")
        yield concept("box", "stamped", "has_stamp(0): there is a stamp on the {0}.")
