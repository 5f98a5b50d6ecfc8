"""A harbour: a ferry with room for one, a crane, a customs seal, and cargo that sinks for good."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.worlds.world import Concept, Facts, World, concept, make_domain, move, where


class Harbour(World):
    make = make_domain(
        "harbour",
        {"ferry": "", "cargo": "", "barrel": "cargo", "bale": "cargo", "quay": "", "pier": "quay",
         "beach": "quay"},
        {"boat": "ferry", "keg": "barrel", "cask": "barrel", "wool": "bale", "east": "pier",
         "west": "pier", "sand": "beach"},
        {"Sail": "ferry quay quay", "Moor": "ferry quay", "Load": "ferry cargo",
         "Unload": "ferry cargo quay", "Seal": "ferry cargo pier", "Dump": "ferry cargo",
         "Tap": "cargo pier"},
        resets_restore_state=False,
    )  # fmt: skip

    def start(self) -> Facts:
        return frozenset({
            ("at", "boat", "east"), ("lies", "keg", "east"), ("lies", "cask", "west"),
            ("lies", "wool", "west"),
        })  # fmt: skip

    def after(self, now: Facts, skill: str, *things: str) -> Facts | None:
        here = where(now, "at", "boat")
        aboard = {f[1] for f in now if f[0] == "lies" and f[2] == "boat"}
        match skill, *things:
            case "Sail", boat, start, goal if start == here and ("moored", boat) not in now:
                return move(now, "at", boat, goal)
            case "Moor", boat, quay if quay == here and quay != "sand":
                moored = {("moored", boat)}
                return now - moored if moored <= now else now | moored
            case "Load", boat, cargo if (
                not aboard and ("moored", boat) in now and where(now, "lies", cargo) == here
            ):
                return move(now, "lies", cargo, boat)
            case "Unload", boat, cargo, quay if cargo in aboard and quay == here:
                return move(now, "lies", cargo, quay) if ("moored", boat) in now else None
            case "Seal", _, cargo, pier if where(now, "lies", cargo) == pier == "west":
                return now | {("sealed", cargo)}
            case "Dump", boat, cargo if cargo in aboard and here == "sand":
                return move(now, "lies", cargo, "sea")
            case "Tap", cargo, pier if (
                where(now, "lies", cargo) == pier == "east" and ("sealed", cargo) in now
                and cargo != "wool"
            ):  # fmt: skip
                return now | {("tapped", cargo)}
        return None

    def own_concepts(self) -> Iterator[Concept]:
        at = concept("ferry quay", "at", "berthed(0, 1): the {0} is at the {1}.",
                     "quay_has(1, 0): at the {1} is the {0}.")  # fmt: skip
        yield at
        yield concept("ferry", "moored", "roped(0): there is a rope on the {0}.")
        lies = concept("cargo quay", "lies", "ashore(0, 1): the {0} lies on the {1}.",
                       "stores(1, 0): on the {1} lies the {0}.")  # fmt: skip
        yield lies
        yield concept("cargo", lambda f, c: ("lies", c, "west") in f,
                      "on_west(0): the {0} lies on the west.", general=lies)  # fmt: skip
        yield concept("ferry cargo", lambda f, b, c: ("lies", c, b) in f,
                      "on_deck(1, 0): the {1} is on the deck of the {0}.",
                      "ships(0, 1): the {0} ships the {1}.")  # fmt: skip
        yield concept("ferry", lambda f, b: not any(x[0] == "lies" and x[2] == b for x in f),
                      "deck_free(0): there is nothing on the deck of the {0}.")  # fmt: skip
        yield concept("ferry cargo", lambda f, b, c: where(f, "at", b) == where(f, "lies", c),
                      "alongside(0, 1): the {0} is alongside the {1}.")  # fmt: skip
        yield concept("cargo", "sealed", "has_seal(0): there is a seal on the {0}.")
        yield concept("cargo", "tapped", "drips(0): something drips out of the {0}.")
        yield concept("cargo", lambda f, c: ("lies", c, "sea") in f,
                      "is_sunk(0): the {0} is under water.")  # fmt: skip
        yield concept("cargo", lambda f, c: c != "wool", "is_round(0): the {0} is round.")
        yield concept("quay", lambda f, q: q == "west", "has_office(0): an office is at the {0}.")
        yield concept("quay", lambda f, q: q == "east", "has_tavern(0): a tavern is at the {0}.")
