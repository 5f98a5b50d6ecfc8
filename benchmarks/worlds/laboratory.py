"""A laboratory: tubes that are spun all at once, and a pipette with a tip."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain


class Laboratory(World):
    make = make_domain(
        "laboratory",
        {"arm": "", "tool": "", "tube": "", "device": ""},
        {"left": "arm", "pipette": "tool", "amber": "tube", "cyan": "tube", "lime": "tube",
         "centrifuge": "device"},
        {"FitTip": "arm tool", "DropTip": "arm tool", "Draw": "arm tool tube",
         "Drip": "arm tool tube", "Cap": "arm tube", "Uncap": "arm tube",
         "Insert": "arm tube device", "Remove": "arm tube device", "Spin": "arm device"},
        failures_change_nothing=False,
    )  # fmt: skip

    def start(self) -> Facts:
        return frozenset({("full", "amber"), ("capped", "lime")})

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        match skill, *things[1:]:
            case "FitTip", tool if ("tip", tool) not in now:
                return now | {("tip", tool)}
            case "DropTip", tool if ("drawn", tool) not in now:
                return now - {("tip", tool)}
            case "Draw", tool, tube if {("tip", tool), ("full", tube)} <= now and not {
                ("drawn", tool),
                ("capped", tube),
                ("in", tube),
            } & now:
                return (now - {("full", tube), ("parted", tube)}) | {("drawn", tool)}
            case "Drip", tool, tube if ("drawn", tool) in now and not {
                ("capped", tube),
                ("full", tube),
            } & now:
                return (now - {("drawn", tool)}) | {("full", tube)}
            case "Cap", tube:
                return now | {("capped", tube)}
            case "Uncap", tube if ("capped", tube) in now and ("in", tube) not in now:
                return now - {("capped", tube)}
            case "Insert", tube, _ if ("capped", tube) in now and ("in", tube) not in now:
                return now | {("in", tube)}
            case "Remove", tube, _ if ("in", tube) in now:
                return now - {("in", tube)}
            case "Spin", _:
                spun = {t for t in ("amber", "cyan", "lime") if {("in", t), ("full", t)} <= now}
                return now | {("parted", t) for t in spun}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        yield concept("tool", "tip", "tip_attached(0): there is a tip on the {0}.",
                      "ends_in_tip(0): the lower end of the {0} is a white tip.")  # fmt: skip
        yield concept("tool", "drawn", "tool_filled(0): there is liquid in the {0}.")
        yield concept("tube", "full", "contains_liquid(0): there is liquid in the {0}.",
                      "is_filled(0): the {0} is filled.")  # fmt: skip
        yield concept("tube", lambda f, t: ("full", t) not in f,
                      "see_through(0): one can see through the {0}.")  # fmt: skip
        yield concept("tube", "capped", "has_cap(0): there is a cap on the {0}.",
                      "is_closed(0): the {0} is closed.")  # fmt: skip
        yield concept("tube", lambda f, t: ("capped", t) not in f,
                      "is_open(0): the {0} is open at its top.")  # fmt: skip
        yield concept("tube device", lambda f, t, d: ("in", t) in f,
                      "sits_in(0, 1): the {0} sits in the {1}.",
                      "device_holds(1, 0): the {1} holds the {0}.")  # fmt: skip
        yield concept("tube", lambda f, t: ("in", t) not in f,
                      "in_stand(0): the {0} is in the stand.")  # fmt: skip
        yield concept("device", lambda f, d: any(x[0] == "in" for x in f),
                      "occupied(0): there is some tube in the {0}.")  # fmt: skip
        yield concept("tube", "parted", "shows_layers(0): the liquid in the {0} has two layers.",
                      "is_separated(0): the {0} is separated into light and dark.")  # fmt: skip
        yield concept("tube tube", lambda f, a, b: (("full", a) in f) == (("full", b) in f),
                      "same_level(0, 1): the first and the second are filled alike.")  # fmt: skip
