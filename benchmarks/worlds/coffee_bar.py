"""A coffee bar: one machine that must be loaded anew, and cups that are served for good."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where


class CoffeeBar(World):
    make = make_domain(
        "coffee_bar",
        {"robot": "", "item": "", "cup": "item", "jug": "item", "place": "", "table": "place",
         "machine": "place", "steamer": "place"},
        {"arm": "robot", "mug": "cup", "glass": "cup", "pitcher": "jug", "bar": "table",
         "terrace": "table", "espresso": "machine", "wand": "steamer"},
        {"Take": "robot item", "Put": "robot item place", "Grind": "robot machine",
         "Brew": "robot machine cup", "Steam": "robot steamer jug", "Pour": "robot jug cup",
         "Serve": "robot cup table"},
    )  # fmt: skip

    def start(self) -> Facts:
        return frozenset({("at", "mug", "bar"), ("at", "glass", "bar"), ("at", "pitcher", "bar")})

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        held = {f[1] for f in now if f[0] == "at" and f[2] == "hand"}
        match skill, *things[1:]:
            case "Take", item if not held and ("served", item) not in now:
                return move(now, "at", item, "hand")
            case "Put", item, place if item in held and self._takes(now, item, place):
                return move(now, "at", item, place)
            case "Grind", machine if not held:
                return now | {("loaded", machine)}
            case "Brew", machine, cup if (
                not held and ("loaded", machine) in now and where(now, "at", cup) == machine
                and not {("coffee", cup), ("milky", cup)} & now
            ):  # fmt: skip
                return (now - {("loaded", machine)}) | {("coffee", cup)}
            case "Steam", steamer, jug if where(now, "at", jug) == steamer:
                return now | {("hot", jug)}
            case "Pour", jug, cup if (
                jug in held and {("hot", jug), ("coffee", cup)} <= now
                and where(now, "at", cup) in ("bar", "terrace")
            ):  # fmt: skip
                return (now - {("hot", jug), ("coffee", cup)}) | {("milky", cup)}
            case "Serve", cup, table if cup in held and ("milky", cup) in now:
                return move(now, "at", cup, table) | {("served", cup)}
        return None

    def _takes(self, now: Facts, item: str, place: str) -> bool:
        kind = {"espresso": ("mug", "glass"), "wand": ("pitcher",)}.get(place)
        full = any(f[0] == "at" and f[2] == place for f in now)
        return kind is None or (item in kind and not full)

    def own_concepts(self) -> Iterator[Concept]:
        at = concept("item place", "at", "stands_at(0, 1): the {0} stands at the {1}.",
                     "place_holds(1, 0): at the {1} stands the {0}.")  # fmt: skip
        yield at
        for name in ("bar", "espresso"):
            yield concept("item", lambda f, i, name=name: ("at", i, name) in f,
                          f"on_{name}(0): the {{0}} stands at the {name}.", general=at)  # fmt: skip
        yield concept("robot item", lambda f, r, i: ("at", i, "hand") in f,
                      "holding(0, 1): the {0} holds the {1} in its gripper.",
                      "carried_by(1, 0): the {1} is carried by the {0}.")  # fmt: skip
        yield concept("robot", lambda f, r: not any(x[-1] == "hand" for x in f),
                      "gripper_free(0): the gripper of the {0} is empty.",
                      "holds_nothing(0): the {0} holds nothing at all.")  # fmt: skip
        yield concept("", lambda f: any(x[-1] == "hand" for x in f),
                      "something_lifted(): something is lifted up.")  # fmt: skip
        yield concept("place", lambda f, p: not any(x[0] == "at" and x[2] == p for x in f),
                      "vacant(0): nothing stands at the {0}.")  # fmt: skip
        yield concept("machine", "loaded", "has_grounds(0): there are grounds in the {0}.",
                      "portafilter_full(0): the filter of the {0} is full.")  # fmt: skip
        yield concept("cup", "coffee", "has_coffee(0): there is black coffee in the {0}.")
        yield concept("cup", "milky", "has_milk(0): there is milk in the {0}.",
                      "latte_in(0): the {0} is filled with white coffee.")  # fmt: skip
        yield concept("cup", lambda f, c: not {("coffee", c), ("milky", c)} & f,
                      "is_empty(0): there is nothing in the {0}.")  # fmt: skip
        yield concept("jug", "hot", "milk_is_foamy(0): the milk in the {0} is foamy.",
                      "steaming(0): steam rises from the {0}.")  # fmt: skip
        yield concept("cup", "served", "has_saucer(0): the {0} stands on a saucer.")
