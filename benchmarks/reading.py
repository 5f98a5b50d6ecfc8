"""What replies of models take to read.

Run: ``python -m benchmarks.reading``; ``benchmarks.calls`` does so too. Replies of about 5 kB,
every one different, in the manners in which models write; and replies of 1 MB, sensible and not.
Processor time of one core.
"""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence

from skillwrapper.domains.discovery import find_domain
from skillwrapper.symbols.predicates import Atom, Predicate, all_groundings
from skillwrapper.vlm.parsing import ParameterNames, parse_labels, parse_predicates, parse_sequences
from skillwrapper.world import Domain

REPLIES, SIZE = 10_000, 5_000
AT_MOST = 2.0
LONG, LONG_AT_MOST = 1_000_000, 0.1

VOCABULARY = (
    Predicate("hand_empty", ("robot",)),
    Predicate("holding", ("robot", "pickupable")),
    Predicate("on_top_of", ("pickupable", "pickupable")),
    Predicate("on_station", ("pickupable", "station")),
    Predicate("is_cut", ("cuttable",)),
)
THOUGHTS = (
    "The patty lies on the stove and looks dark brown, so it has been cooked already.",
    "Wait, is holding(robot, lettuce) true? Nothing floats over the head of the robot.",
    "I have to go through the statements one by one and compare each with the picture.",
    "The lower bun is seen at the bottom of a stack; what lies on it is hard to make out.",
)
VERDICTS = ("true", "false", "unsure")


def plain(atoms: Sequence[Atom], chance: random.Random) -> str:
    return "\n".join(f"{atom}: {chance.choice(VERDICTS)}" for atom in atoms)


def bullets(atoms: Sequence[Atom], chance: random.Random) -> str:
    return "\n".join(f"- **{atom}**: {chance.choice(VERDICTS).title()}" for atom in atoms)


def explained(atoms: Sequence[Atom], chance: random.Random) -> str:
    lines = (f"{n}. `{a}`: {chance.choice(VERDICTS)}. Seen at once." for n, a in enumerate(atoms))
    return "\n".join(lines)


def below(atoms: Sequence[Atom], chance: random.Random) -> str:
    return "\n\n".join(f"{atom}\n{chance.choice(VERDICTS).title()}" for atom in atoms)


def table(atoms: Sequence[Atom], chance: random.Random) -> str:
    rows = (f"| {atom} | {chance.choice(VERDICTS)} |" for atom in atoms)
    return "\n".join(["| Statement | Label |", "|---|---|", *rows])


def in_json(atoms: Sequence[Atom], chance: random.Random) -> str:
    pairs = ",\n".join(f'  "{atom}": "{chance.choice(VERDICTS)}"' for atom in atoms)
    return f"```json\n{{\n{pairs}\n}}\n```"


def label_reply(manner: Callable[..., str], atoms: Sequence[Atom], chance: random.Random) -> str:
    """Reasoning in tags up to the size, then the labels."""
    answer = manner(chance.sample(list(atoms), len(atoms)), chance)
    thoughts = [f"{chance.random():.6f} {chance.choice(THOUGHTS)}" for _ in range(80)]
    return f"<think>{' '.join(thoughts)[: SIZE - len(answer)]}</think>\n{answer}"


def sequence_reply(domain: Domain, chance: random.Random) -> str:
    """Sequences under headings."""
    lines, size = [], 0
    while size < SIZE:
        lines.append(f"\nSequence {len(lines)}:" if len(lines) % 9 == 0 else _step(domain, chance))
        size += len(lines[-1]) + 1
    return "\n".join(lines)


def predicate_reply(chance: random.Random) -> str:
    """A comparison of the pictures, then two candidates."""
    thoughts = "\n".join(f"{chance.random():.6f} {chance.choice(THOUGHTS)}" for _ in range(55))
    return (
        f"{thoughts[: SIZE - 130]}\n\n1. station_free(?station): nothing lies on the station.\n"
        "2. holding(?robot, ?pickupable): the item is in the hand of the robot."
    )


def _step(domain: Domain, chance: random.Random) -> str:
    skill = chance.choice(domain.skills)
    chosen = [
        chance.choice([o.name for o in domain.objects if p.type in o.types])
        for p in skill.parameters
    ]
    return f"{skill.name}({', '.join(chosen)})"


def long_replies(atoms: Sequence[Atom]) -> dict[str, str]:
    """A reply of 1 MB that makes sense, and some that do not."""
    lines = "\n".join(f"{atom}: true" for atom in atoms) + "\n"
    return {
        "reasoning before labels": f"{THOUGHTS[0] * (LONG // 80)}</think>{lines}",
        "labels again and again": lines * (LONG // len(lines)),
        "blanks": "true" + " " * LONG + "x",
        "open brackets": "(" * LONG,
        "open calls": "a(" * (LONG // 2),
        "many names": " ".join(f"w{n}(t{n})" for n in range(LONG // 15)),
        "open objects": '{"a":' * (LONG // 5),
        "tags": "<think>" * (LONG // 7),
        "bars": "|" * LONG,
    }


def main() -> None:
    """Print seconds for each kind of reply."""
    domain, chance = find_domain("burger").domain, random.Random(0)
    atoms = all_groundings(VOCABULARY, domain.objects)
    print(
        f"{REPLIES} replies of {SIZE / 1000:.0f} kB, {len(atoms)} statements in those with labels"
    )
    spent = 0.0
    for manner in (plain, bullets, explained, below, table, in_json):
        replies = [label_reply(manner, atoms, chance) for _ in range(REPLIES // 8)]
        spent += _timed(f"labels, {manner.__name__}", replies, lambda r: parse_labels(r, atoms))
    sequences = [sequence_reply(domain, chance) for _ in range(REPLIES // 8)]
    spent += _timed(
        "sequences", sequences, lambda r: parse_sequences(r, domain.skills, domain.objects)
    )
    names = ParameterNames({"robot": 1, "pickupable": 1, "station": 1})
    proposals = [predicate_reply(chance) for _ in range(REPLIES // 8)]
    spent += _timed("predicates", proposals, lambda r: parse_predicates(r, names))
    print(f"all: {spent:.2f} s, at most {AT_MOST} s: {'yes' if spent <= AT_MOST else 'NO'}")
    for name, reply in long_replies(atoms).items():
        seconds = _timed(f"1 MB, {name}", [reply], lambda r: parse_labels(r, atoms))
        if seconds > LONG_AT_MOST:
            print(f"  longer than {LONG_AT_MOST} s")


def _timed(name: str, replies: Sequence[str], parse: Callable[[str], object]) -> float:
    size = sum(map(len, replies)) / len(replies) / 1000
    began = time.process_time()
    for reply in replies:
        parse(reply)
    seconds = time.process_time() - began
    print(f"{name:32} {len(replies):6} of {size:7.1f} kB: {seconds:.3f} s")
    return seconds


if __name__ == "__main__":
    main()
