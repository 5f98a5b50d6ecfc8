"""A careful reader: a model that knows what is true in a picture, and words for it; no planner."""

from __future__ import annotations

import itertools
import random
import re
import threading
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from benchmarks.worlds.styles import CANDIDATES, VERDICTS
from benchmarks.worlds.world import Concept, Facts, Wording, World
from skillwrapper.embedded.prompt_text import PromptText, WrittenCall
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role

_STATEMENT = re.compile(r"[\w-]+\([^()]*\)")


@dataclass(frozen=True, eq=False)
class _Idea:
    """A concept in certain words, for certain types."""

    concept: Concept
    wording: Wording
    types: tuple[str, ...]

    def holds(self, facts: Facts, world: World, things: Sequence[str]) -> bool:
        """Of things in the order of the predicate."""
        placed = dict(zip(self.wording.order, things, strict=True))
        own = [placed[n] for n in range(len(self.concept.types))]
        known = world.domain.object_by_name
        fit = all(t in known[o].types for o, t in zip(own, self.concept.types, strict=True))
        return fit and self.concept.holds(facts, *own)


class CarefulReader:
    """Reads every picture rightly, and proposes what tells pictures apart, in no clever order.

    Args:
        world: where the pictures come from.
        style: how replies are written (``styles.STYLES``).
        seed: decides which words it finds first.

    Attributes:
        asked: how often, by role.
        strange: names of predicates that it could make nothing of.
    """

    def __init__(self, world: World, style: str = "lines", seed: int = 0) -> None:
        self._world, self._style = world, style
        self._chance = random.Random(f"reader {seed}")
        self._ideas: dict[str, _Idea] = {}
        self._lock = threading.Lock()
        self.asked: Counter[str] = Counter()
        self.strange: Counter[str] = Counter()

    @property
    def name(self) -> str:
        return "careful reader"

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        return {"style": self._style}

    def complete(self, request: ModelRequest) -> ModelReply:
        with self._lock:
            self.asked[request.role] += 1
            return ModelReply(self._answer(request))

    def _answer(self, request: ModelRequest) -> str:
        prompt = PromptText.of(request.prompt)
        match request.role:
            case Role.EVALUATE:
                return VERDICTS[self._style](self._judge(request, prompt))
            case Role.SUMMARISE:
                return _sum_up(prompt)
            case Role.INVENT:
                return self._invent(request, prompt)
            case Role.PROPOSE:
                drawn = [self._chance.choices(prompt.instances, k=15) for _ in range(5)]
                return "\n\n".join("\n".join(map(str, sequence)) for sequence in drawn)
        return "Nothing"

    def _facts(self, request: ModelRequest, number: int) -> Facts:
        facts, picture = self._world.glimpses[request.pictures[number].sha256]
        return facts | {("picture", str(picture))}

    def _judge(self, request: ModelRequest, prompt: PromptText) -> list[tuple[str, bool | None]]:
        facts = self._facts(request, 0)
        return [(str(c), self._is_true(facts, c)) for c in prompt.calls("Statements")]

    def _is_true(self, facts: Facts, call: WrittenCall) -> bool | None:
        idea = self.understand(call)
        if idea is None:
            self.strange[call.name] += 1
            return None
        return idea.holds(facts, self._world, call.arguments)

    def understand(self, call: WrittenCall) -> _Idea | None:
        """The idea of that name, also where something was added to it."""
        named = (n for n in self._ideas if call.name == n or call.name.startswith(f"{n}_"))
        found = max(named, key=len, default=None)
        idea = None if found is None else self._ideas[found]
        return idea if idea and len(idea.wording.order) == len(call.arguments) else None

    def _invent(self, request: ModelRequest, prompt: PromptText) -> str:
        if "Candidate" in prompt:
            return self._rephrase(prompt)
        known = {p.name for title in ("Known predicates", "Rejected candidates")
                 for p in prompt.predicates(title)}  # fmt: skip
        ideas = [i for i in self._telling(request, prompt) if i.wording.name not in known]
        count = prompt.number(r"give (\d+) candidates", 1)
        chosen = self._draw(ideas, count)
        if not chosen:
            return "Nothing"
        self._ideas |= {idea.wording.name: idea for idea in chosen}
        return CANDIDATES[self._style]([_written(idea) for idea in chosen])

    def _draw(self, ideas: Sequence[_Idea], count: int) -> list[_Idea]:
        """Some of them, each concept once; what tells of the state is thought of more readily."""
        order = sorted(
            ideas,
            key=lambda i: self._chance.random() ** (1.0 if i.concept.is_telling else 4.0),
            reverse=True,
        )
        first = {(i.concept, i.types): i for i in reversed(order)}
        return [i for i in order if first[i.concept, i.types] is i][:count]

    def _telling(self, request: ModelRequest, prompt: PromptText) -> Iterator[_Idea]:
        """What tells the pictures apart, about the arguments or what changed for no reason."""
        calls = [call for call, _ in prompt.executions]
        moments = [
            (self._facts(request, prompt.captions[f"before execution {n}"]),
             self._facts(request, prompt.captions[f"after execution {n}"])
             if f"after execution {n}" in prompt.captions else None)
            for n in range(1, len(calls) + 1)
        ]  # fmt: skip
        strangers = {o for c in prompt.calls("Unexplained changes") for o in c.arguments}
        if "in, on or attached" in prompt.text:
            strangers = set(prompt.objects)
        things = [[*c.arguments, *sorted(strangers - set(c.arguments))] for c in calls]
        allowed = prompt.allowed
        for concept in self._world.concepts:
            for types in self._fitting(concept, allowed):
                for wording in concept.wordings:
                    idea = _Idea(concept, wording, types)
                    seen = [
                        self._look(idea, facts, own)
                        for facts, own in zip(moments, things, strict=True)
                    ]
                    if _differ(*seen) if len(seen) > 1 else any(seen[0].values()):
                        yield idea
                    elif "Unexplained changes" in prompt and len(types) > 1:
                        before = moments[0][0], None
                        if any(self._look(idea, before, things[0]).values()):
                            yield idea

    def _fitting(self, concept: Concept, allowed: Mapping[str, int]) -> Iterator[tuple[str, ...]]:
        """The allowed types in which a concept can be put."""
        of = {t: {o.name for o in self._world.domain.objects if t in o.types}
              for t in self._world.domain.types.names}  # fmt: skip
        choices = [
            [t for t in allowed if of[t] <= of[own] or of[own] < of[t]] for own in concept.types
        ]
        for types in itertools.product(*choices):
            if all(times <= allowed[t] for t, times in Counter(types).items()):
                yield types

    def _look(
        self, idea: _Idea, moment: tuple[Facts, Facts | None], things: Sequence[str]
    ) -> dict[tuple[int, ...], int]:
        """What can be said of things, by their places: how it is, or whether it changed."""
        known, found = self._world.domain.object_by_name, {}
        before, after = moment
        for places in itertools.permutations(range(len(things)), len(idea.types)):
            own = [things[n] for n in places]
            if all(t in known[o].types for o, t in zip(own, idea.types, strict=True)):
                ordered = [own[n] for n in idea.wording.order]
                held = idea.holds(before, self._world, ordered)
                later = 0 if after is None else idea.holds(after, self._world, ordered)
                found[places] = held if after is None else later - held
        return found

    def _rephrase(self, prompt: PromptText) -> str:
        (candidate,) = prompt.predicates("Candidate")
        idea = self.understand(WrittenCall(candidate.name, candidate.types))
        general = idea.concept.general if idea else None
        listed = re.search(r"parameters are \(([^)]*)\)", prompt.text)
        wanted = re.findall(r"\?([\w-]+)", listed[1] if listed else "")
        if general is None or len(wanted) != len(general.types):
            return "I cannot say it otherwise."
        wording = next(w for w in general.wordings if w.order == tuple(range(len(w.order))))
        found = _Idea(general, wording, tuple(wanted))
        self._ideas[wording.name] = found
        return CANDIDATES[self._style]([_written(found)])


def _differ(first: Mapping[tuple[int, ...], int], second: Mapping[tuple[int, ...], int]) -> bool:
    """Whether something is not the same of things in the same places."""
    return any(first[places] != second[places] for places in first.keys() & second.keys())


def _written(idea: _Idea) -> tuple[str, list[tuple[str, str]], str]:
    """Name, parameters and meaning of a predicate."""
    types = [idea.types[n] for n in idea.wording.order]
    letters = [(f"{t[0]}{n}", t) for n, t in enumerate(types, start=1)]
    return idea.wording.name, letters, idea.wording.meaning.format(*idea.types)


def _sum_up(prompt: PromptText) -> str:
    """What somebody concluded, a line each."""
    text = prompt.quotation
    word = {"it is the case that": "true", "it is not the case that": "false"}
    lines = []
    for call in prompt.calls("Statements"):
        before = text.partition(f"{call}.")[0] if f"{call}." in text else ""
        said = next((v for k, v in word.items() if before.rstrip().endswith(k)), "unsure")
        lines.append(f"{call}: {said}")
    return "\n".join(lines)
