"""A warehouse in several scenes: tables that hold one box each, and boxes that are sent away."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where


class Warehouse(World):
    make = make_domain(
        "warehouse",
        {"truck": "", "box": "", "fragile": "box", "sturdy": "box", "table": "", "dock": "table",
         "bench": "table"},
        {"lift": "truck", "crate": "sturdy", "case": "sturdy", "vase": "fragile",
         "north": "bench", "south": "bench", "ramp": "dock"},
        {"Drive": "truck table", "Raise": "truck box", "Lower": "truck box table",
         "Wrap": "truck box", "Mark": "truck box", "Ship": "truck box dock"},
        {"small": "lift crate case north ramp", "glass": "lift vase north south ramp",
         "large": "lift crate vase north south ramp"},
    )  # fmt: skip

    def start(self) -> Facts:
        boxes = [o.name for o in self.scene.objects if "box" in o.types]
        places = ["north", "south" if "south" in self.scene.names else "ramp"]
        return frozenset({("on", b, p) for b, p in zip(boxes, places, strict=False)}) | {
            ("by", "lift", "north")
        }

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        here = where(now, "by", "lift")
        held = {f[1] for f in now if f[0] == "on" and f[2] == "fork"}
        match skill, *things[1:]:
            case "Drive", table:
                return move(now, "by", "lift", table)
            case "Raise", box if not held and where(now, "on", box) == here:
                return move(now, "on", box, "fork")
            case "Lower", box, table if (
                box in held and table == here
                and not any(f[0] == "on" and f[2] == table for f in now)
            ):  # fmt: skip
                return move(now, "on", box, table)
            case "Wrap", box if box in held:
                return now | {("wrapped", box)}
            case "Mark", box if (
                not held and where(now, "on", box) == here and ("wrapped", box) in now
            ):
                return now | {("marked", box)}
            case "Ship", box, dock if (
                not held and where(now, "on", box) == dock == here
                and (box != "vase" or ("wrapped", box) in now)
            ):  # fmt: skip
                return frozenset(f for f in now if f[1] != box) | {("gone", box)}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        on = concept("box table", "on", "lies_on(0, 1): the {0} lies on the {1}.",
                     "table_bears(1, 0): on the {1} lies the {0}.")  # fmt: skip
        yield on
        yield concept("box", lambda f, b: ("on", b, "ramp") in f,
                      "is_on_ramp(0): the {0} lies on the ramp.", general=on)  # fmt: skip
        yield concept("box", lambda f, b: where(f, "on", b) not in ("", "fork"),
                      "on_some_table(0): the {0} lies on a table.", general=on)  # fmt: skip
        yield concept("table", lambda f, t: not any(x[0] == "on" and x[2] == t for x in f),
                      "clear(0): nothing lies on the {0}.",
                      "is_bare(0): the {0} is bare.")  # fmt: skip
        yield concept("truck box", lambda f, t, b: ("on", b, "fork") in f,
                      "carries(0, 1): the {0} carries the {1}.",
                      "on_fork(1, 0): the {1} is on the fork of the {0}.")  # fmt: skip
        yield concept("truck", lambda f, t: not any(x[-1] == "fork" for x in f),
                      "fork_empty(0): the fork of the {0} is empty.")  # fmt: skip
        yield concept("truck table", "by", "parked_at(0, 1): the {0} is parked beside the {1}.",
                      "has_beside(1, 0): beside the {1} is the {0}.")  # fmt: skip
        yield concept("truck box", lambda f, t, b: where(f, "on", b) == where(f, "by", t),
                      "in_front_of(0, 1): the {0} is in front of the table with the {1}.",
                      )  # fmt: skip
        yield concept("box", "wrapped", "in_foil(0): there is foil around the {0}.",
                      "shines(0): the {0} shines of foil.")  # fmt: skip
        yield concept("box", "marked", "has_label(0): there is a label on the {0}.")
        yield concept("box", "gone", "not_to_be_seen(0): the {0} is not to be seen.")
