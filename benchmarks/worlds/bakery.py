"""A bakery in two scenes: dough that rises, an oven that burns what is baked twice."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where


class Bakery(World):
    make = make_domain(
        "bakery",
        {"baker": "", "good": "", "loaf": "good", "roll": "good", "surface": "", "board": "surface",
         "shelf": "surface", "oven": "surface"},
        {"hand": "baker", "rye": "loaf", "wheat": "loaf", "bun": "roll", "slab": "board",
         "rack": "shelf", "kiln": "oven"},
        {"Lift": "baker good", "Lay": "baker good surface", "Knead": "baker good",
         "Heat": "baker oven", "Bake": "baker oven", "Cut": "baker loaf", "Sugar": "baker roll"},
        {"shop": "hand rye bun slab rack kiln", "home": "hand wheat bun slab kiln"},
    )  # fmt: skip

    def start(self) -> Facts:
        goods = [o.name for o in self.scene.objects if "good" in o.types]
        return frozenset({("on", good, "slab") for good in goods})

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        held = {f[1] for f in now if f[0] == "on" and f[2] == "hand"}
        match skill, *things[1:]:
            case "Lift", good if not held and ("cut", good) not in now:
                return move(now, "on", good, "hand")
            case "Lay", good, surface if good in held:
                return move(now, "on", good, surface)
            case "Knead", good if (
                not held and where(now, "on", good) == "slab" and ("baked", good) not in now
            ):
                return now | {("smooth", good)}
            case "Heat", oven:
                return now | {("hot", oven)}
            case "Bake", oven if ("hot", oven) in now and not held:
                inside = {f[1] for f in now if f[0] == "on" and f[2] == oven}
                burnt = {("burnt", g) for g in inside if ("baked", g) in now}
                return (now - {("hot", oven)}) | {("baked", g) for g in inside} | burnt
            case "Cut", good if (
                {("baked", good), ("on", good, "slab"), ("smooth", good)} <= now
                and ("burnt", good) not in now and not held
            ):  # fmt: skip
                return now | {("cut", good)}
            case "Sugar", good if {("baked", good), ("on", good, "slab")} <= now:
                return now | {("sugared", good)}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        on = concept("good surface", "on", "rests_on(0, 1): the {0} rests on the {1}.",
                     "bears(1, 0): the {1} bears the {0}.")  # fmt: skip
        yield on
        yield concept("good", lambda f, g: ("on", g, "slab") in f,
                      "rests_on_slab(0): the {0} rests on the slab.", general=on)  # fmt: skip
        yield concept("baker good", lambda f, b, g: ("on", g, "hand") in f,
                      "has_in_hand(0, 1): the {0} has the {1} in the fingers.",
                      "held_up_by(1, 0): the {1} is held up by the {0}.")  # fmt: skip
        yield concept("baker", lambda f, b: not any(x[-1] == "hand" for x in f),
                      "fingers_free(0): the fingers of the {0} are free.")  # fmt: skip
        yield concept("", lambda f: not any(x[-1] == "hand" for x in f),
                      "nothing_is_lifted(): nothing is lifted.")  # fmt: skip
        yield concept("good", "smooth", "looks_smooth(0): the surface of the {0} is smooth.")
        yield concept("oven", "hot", "glows(0): the {0} glows red.",
                      "is_heated(0): the {0} is heated.")  # fmt: skip
        yield concept("good", "baked", "is_brown(0): the crust of the {0} is brown.",
                      "has_crust(0): the {0} has a crust.")  # fmt: skip
        yield concept("good", "burnt", "is_black(0): the {0} is black.")
        yield concept("loaf", "cut", "in_slices(0): the {0} is in slices.")
        yield concept("roll", "sugared", "has_sugar(0): there is sugar on the {0}.")
        yield concept("surface", lambda f, s: not any(x[0] == "on" and x[2] == s for x in f),
                      "is_bare(0): the {0} is bare.")  # fmt: skip
