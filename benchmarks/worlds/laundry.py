"""A laundry without a robot to be seen: machines change all in them, folding is last."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where


class Laundry(World):
    make = make_domain(
        "laundry",
        {"garment": "", "place": "", "machine": "place", "washer": "machine", "dryer": "machine",
         "basket": "place"},
        {"shirt": "garment", "sock": "garment", "hamper": "basket", "front": "washer",
         "tumbler": "dryer"},
        {"Move": "garment place", "Open": "machine", "Shut": "machine", "Wash": "washer",
         "Dry": "dryer", "Fold": "garment"},
        failures_change_nothing=False, resets_restore_state=False,
    )  # fmt: skip

    def start(self) -> Facts:
        return frozenset({("in", "shirt", "hamper"), ("in", "sock", "hamper"), ("open", "front")})

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        inside = {f[1] for f in now if f[0] == "in" and f[2] == things[-1]}
        match skill, *things:
            case "Move", garment, place if ("folded", garment) not in now:
                before = where(now, "in", garment)
                shut = {m for m in ("front", "tumbler") if ("open", m) not in now}
                if place != before and not {place, before} & shut:
                    return move(now, "in", garment, place)
            case "Open", machine:
                return now | {("open", machine)}
            case "Shut", machine:
                return now - {("open", machine)}
            case "Wash", machine if ("open", machine) not in now and inside:
                return now | {(w, g) for g in inside for w in ("clean", "wet")}
            case "Dry", machine if ("open", machine) not in now:
                return now - {("wet", g) for g in inside}
            case "Fold", garment if (
                ("clean", garment) in now and not {("wet", garment), ("folded", garment)} & now
                and ("in", garment, "hamper") in now
            ):  # fmt: skip
                return now | {("folded", garment)}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        inside = concept("garment place", "in", "inside(0, 1): the {0} is in the {1}.",
                         "contains(1, 0): the {1} contains the {0}.")  # fmt: skip
        yield inside
        yield concept("garment", lambda f, g: ("in", g, "hamper") in f,
                      "in_hamper(0): the {0} is in the hamper.", general=inside)  # fmt: skip
        yield concept("machine", "open", "stands_open(0): the hatch of the {0} stands open.")
        yield concept("machine", lambda f, m: ("open", m) not in f,
                      "hatch_closed(0): the hatch of the {0} is closed.")  # fmt: skip
        yield concept("garment", "clean", "is_white(0): the {0} is spotless.",
                      "no_stains(0): there are no stains on the {0}.")  # fmt: skip
        yield concept("garment", lambda f, g: ("clean", g) not in f,
                      "has_stains(0): there are stains on the {0}.")  # fmt: skip
        yield concept("garment", "wet", "is_wet(0): water drips from the {0}.")
        yield concept("garment", "folded", "is_flat(0): the {0} is folded flat.")
        yield concept("place", lambda f, p: not any(x[0] == "in" and x[2] == p for x in f),
                      "is_empty(0): there is nothing in the {0}.")  # fmt: skip
