"""A workshop behind doors with keys, and a gate through which nobody comes back."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where

_SIDES = {"oak": ("hall", "store"), "iron": ("hall", "shed"), "gate": ("hall", "yard")}


class Workshop(World):
    make = make_domain(
        "workshop",
        {"robot": "", "room": "", "passage": "", "door": "passage", "turnstile": "passage",
         "item": "", "key": "item", "wood": "item"},
        {"rover": "robot", "hall": "room", "store": "room", "shed": "room", "yard": "room",
         "oak": "door", "iron": "door", "gate": "turnstile", "brass": "key", "steel": "key",
         "board": "wood"},
        {"Enter": "robot passage room", "Take": "robot item", "Leave": "robot item",
         "Unlock": "robot door key", "Saw": "robot wood", "Paint": "robot wood"},
        resets_restore_state=False,
    )  # fmt: skip

    def start(self) -> Facts:
        sides = {("side", p, room) for p, rooms in _SIDES.items() for room in rooms}
        return frozenset(sides) | {
            ("in", "rover", "hall"), ("at", "brass", "hall"), ("at", "steel", "store"),
            ("at", "board", "store"), ("fits", "brass", "oak"), ("fits", "steel", "iron"),
            ("open", "gate"),
        }  # fmt: skip

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        here = where(now, "in", "rover")
        held = {f[1] for f in now if f[0] == "at" and f[2] == "hand"}
        match skill, *things[1:]:
            case "Enter", passage, room if (
                ("open", passage) in now and room != here and {room, here} == {*_SIDES[passage]}
                and (passage != "gate" or room == "yard")
            ):  # fmt: skip
                return move(now, "in", "rover", room)
            case "Take", item if not held and where(now, "at", item) == here:
                return move(now, "at", item, "hand")
            case "Leave", item if item in held:
                return move(now, "at", item, here)
            case "Unlock", door, key if (
                key in held and ("fits", key, door) in now and here in _SIDES[door]
            ):
                return now | {("open", door)}
            case "Saw", wood if not held and here == where(now, "at", wood) == "shed":
                return now | {("sawn", wood)}
            case "Paint", wood if (
                not held and ("sawn", wood) in now and here == where(now, "at", wood) == "shed"
            ):
                return now | {("painted", wood)}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        inside = concept("robot room", "in", "robot_in(0, 1): the {0} is in the {1}.",
                         "room_of_robot(1, 0): in the {1} is the {0}.")  # fmt: skip
        yield inside
        yield concept("robot", lambda f, r: ("in", r, "shed") in f,
                      "is_in_shed(0): the {0} is in the shed.", general=inside)  # fmt: skip
        at = concept("item room", "at", "lies_in(0, 1): the {0} lies on the floor of the {1}.",
                     "floor_of_room_has(1, 0): on the floor of the {1} is the {0}.")  # fmt: skip
        yield at
        yield concept("item", lambda f, i: ("at", i, "store") in f,
                      "lies_in_store(0): the {0} lies in the store.", general=at)  # fmt: skip
        yield concept("robot item", lambda f, r, i: ("at", i, "hand") in f,
                      "grips(0, 1): the {0} grips the {1}.",
                      "is_gripped(1, 0): the {1} is gripped by the {0}.")  # fmt: skip
        yield concept("robot", lambda f, r: any(x[-1] == "hand" for x in f),
                      "loaded(0): the {0} carries something.")  # fmt: skip
        yield concept("robot item",
                      lambda f, r, i: where(f, "in", r) == where(f, "at", i),
                      "same_room(0, 1): the {1} lies in the room where the {0} is.")  # fmt: skip
        yield concept("passage", "open", "is_open(0): the {0} stands open.",
                      "unbolted(0): no bolt is before the {0}.")  # fmt: skip
        yield concept("passage room", "side", "leads_to(0, 1): one side of the {0} is the {1}.",
                      "has_exit(1, 0): the {1} has the {0} in its wall.")  # fmt: skip
        yield concept("key door", "fits", "same_colour(0, 1): the {0} has the colour of the {1}.")
        yield concept("robot passage",
                      lambda f, r, p: where(f, "in", r) in _SIDES[p],
                      "stands_before(0, 1): the {0} stands in a room that the {1} leads to.",
                      )  # fmt: skip
        yield concept("wood", "sawn", "in_two_pieces(0): the {0} is in two pieces.")
        yield concept("wood", "painted", "is_red(0): the {0} is red.",
                      "covered_with_paint(0): there is paint on the {0}.")  # fmt: skip
        yield concept("robot room passage", lambda f, r, p, d: ("in", r, p) in f,
                      "robot_between(0, 1, 2): the {0} is by the {1} and the {2}.")  # fmt: skip
