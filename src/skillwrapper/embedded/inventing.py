"""Answering the prompts of invention: concepts that tell pictures apart, chosen by chance."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

from skillwrapper.embedded.chance import Chance
from skillwrapper.embedded.comparing import Comparison, Idea, Views
from skillwrapper.embedded.lexicon import Lexicon
from skillwrapper.embedded.prompt_text import PromptText, WrittenPredicate, covers
from skillwrapper.embedded.sight import Sight, Sights, first_sight, sight_at

_LOCAL_MASS = 3.0
"""Weight of all local concepts together, against 1 for all others together."""
_COUNT = r"[Gg]ive (\d+) candidate"
_OPENINGS = (
    "Comparing the pictures, this is what I notice.",
    "The situations differ in how things lie and look.",
    "I looked for what is different between the pictures.",
)


def invent(prompt: PromptText, sights: Sights, lexicon: Lexicon, chance: Chance) -> str:
    """Propose predicates for an inconsistency."""
    ideas = list(_compare(prompt, sights, Comparison(prompt, lexicon)))
    return _reply(prompt, _Writer(prompt, sights, lexicon), ideas, chance)


def invent_vocabulary(prompt: PromptText, sights: Sights, lexicon: Lexicon, chance: Chance) -> str:
    """Propose predicates for anything that varies between many pictures."""
    seen = [sight for sight in sights if sight is not None]
    ideas = list(_varying(prompt, seen, lexicon))
    return _reply(prompt, _Writer(prompt, sights, lexicon), ideas, chance)


def _compare(prompt: PromptText, sights: Sights, comparison: Comparison) -> Iterator[Idea]:
    views = [_views(prompt, sights, number) for number in range(len(prompt.executions))]
    seen = [view for view in views if view is not None]
    if "Unexplained changes" in prompt:
        others = [name for call in prompt.calls("Unexplained changes") for name in call.arguments]
        for view in seen[:1]:
            new = [name for name in dict.fromkeys(others) if name not in view.arguments]
            yield from comparison.of_relations(view, new)
    elif _asks_for_one_change(prompt):
        for view in seen:
            yield from (idea for idea in comparison.of_one_change(view) if idea.telling)
    elif len(seen) == 2:
        first, second = seen
        if first.after is None:
            yield from comparison.of_situations(first, second)
        elif prompt.executions[0][1]:
            yield from comparison.of_changes(first, second)
        else:
            yield from comparison.of_changes(second, first)


def _asks_for_one_change(prompt: PromptText) -> bool:
    """Whether one execution is shown, and the question is what it has changed."""
    return len(prompt.executions) == 1 and "Unexplained changes" not in prompt


def _views(prompt: PromptText, sights: Sights, number: int) -> Views | None:
    """What the prompt shows of an execution; None if the picture before it is not understood."""
    call, _ = prompt.executions[number]
    before, after = (
        sight_at(sights, prompt.captions.get(f"{moment} execution {number + 1}"))
        for moment in ("before", "after")
    )
    return Views(call.arguments, before, after) if before is not None else None


def _varying(prompt: PromptText, sights: Sequence[Sight], lexicon: Lexicon) -> Iterator[Idea]:
    """Concepts over the widest types of one kind of thing, telling if they vary."""
    if not sights:
        return
    graph = sights[0].graph
    by_kind: dict[str, list[str]] = {}
    for name in prompt.objects:
        by_kind.setdefault(graph.kind(name), []).append(name)
    for concept in lexicon.concepts(graph.outline):
        kinds = [kind for kind in by_kind if kind]
        for chosen in itertools.product(kinds, repeat=concept.arity):
            if not concept.fits(chosen):
                continue
            groundings = [
                names
                for names in itertools.product(*(by_kind[kind] for kind in chosen))
                if len(set(names)) == len(names)
            ]
            values = {
                names: {concept.truth(sight, names) for sight in sights} for names in groundings
            }
            varying = [names for names, seen in values.items() if {True, False} <= seen]
            types = _smallest_types(prompt, varying or groundings, len(chosen))
            if types is not None:
                yield Idea(concept, types, bool(varying))


def _smallest_types(
    prompt: PromptText, groundings: Sequence[tuple[str, ...]], arity: int
) -> tuple[str, ...] | None:
    """For each position the allowed type with the fewest objects that has all that occur."""
    types = []
    for position in range(arity):
        names = {grounding[position] for grounding in groundings}
        shared = [t for t in prompt.allowed if all(t in prompt.objects[n] for n in names)]
        if not names or not shared:
            return None
        sizes = {t: sum(t in has for has in prompt.objects.values()) for t in shared}
        types.append(min(shared, key=lambda t: (sizes[t], t)))
    return tuple(types)


def _reply(prompt: PromptText, writer: _Writer, ideas: Sequence[Idea], chance: Chance) -> str:
    count = prompt.number(_COUNT, 1)
    fresh = [idea for idea in dict.fromkeys(ideas) if writer.is_fresh(idea)]
    # If nothing that is new tells the situations apart, say something all the same: people do.
    telling = [idea for idea in fresh if idea.telling] or fresh
    chosen: list[Idea] = []
    while telling and len(chosen) < count:
        chosen.append(chance.pick_weighted(telling, _weights(telling)))
        telling = [idea for idea in telling if not _alike(idea, chosen[-1])]
    lines = [writer.write(idea, chance) for idea in chosen]
    if not lines and _asks_for_one_change(prompt):
        return "I compared what can be seen of the arguments before and after.\n\nNothing"
    if not lines:
        return "The pictures look alike to me; I find nothing new that could be named."
    return "\n".join([chance.pick(_OPENINGS), "", *lines])


def _alike(one: Idea, other: Idea) -> bool:
    return one.concept.idea == other.concept.idea and sorted(one.types) == sorted(other.types)


def _weights(ideas: Sequence[Idea]) -> list[float]:
    """By salience, scaled so that local concepts together have a fixed share."""
    mass = {True: 0.0, False: 0.0}
    for idea in ideas:
        mass[idea.concept.local] += idea.concept.wording.salience
    share = {True: _LOCAL_MASS, False: 1.0}
    return [
        idea.concept.wording.salience * share[idea.concept.local] / mass[idea.concept.local]
        for idea in ideas
    ]


class _Writer:
    """Puts ideas into words, and knows which are taken."""

    def __init__(self, prompt: PromptText, sights: Sights, lexicon: Lexicon) -> None:
        self._prompt, self._lexicon = prompt, lexicon
        self._seen = first_sight(sights)
        self._known = self._ideas_of("Known predicates")
        self._rejected = self._ideas_of("Rejected candidates")
        self._taken = {p.name for title in ("Known predicates", "Rejected candidates")
                       for p in prompt.predicates(title)}  # fmt: skip

    def is_fresh(self, idea: Idea) -> bool:
        """Whether no known or rejected predicate says it of these objects already."""
        return not any(
            covers(predicate.types, self._prompt.objects, *idea.types)
            for meant, predicate in (*self._known, *self._rejected)
            if meant == idea.concept.idea
        )

    def write(self, idea: Idea, chance: Chance) -> str:
        """The line that proposes it; a known predicate for other types keeps its name."""
        wording = idea.concept.wording
        parameters = ", ".join(f"?{name}" for name in idea.types)
        for meant, predicate in self._known:
            if meant == idea.concept.idea and self._are_alike(predicate.types, idea.types):
                return f"{predicate.name}({parameters}): {predicate.semantics}"
        free = [name for name in wording.names if name not in self._taken]
        name = chance.pick(free or wording.names)
        name = name if free else f"{name}_{len(self._taken)}"
        self._taken.add(name)
        meaning = idea.concept.describe(chance.pick(wording.meanings), idea.types)
        return f"{name}({parameters}): {meaning}."

    def _are_alike(self, types: Sequence[str], others: Sequence[str]) -> bool:
        """Whether, parameter by parameter, one type has all objects of both."""
        return len(types) == len(others) and all(
            bool(self._types_of_all(one, other)) for one, other in zip(types, others, strict=True)
        )

    def _types_of_all(self, *types: str) -> frozenset[str]:
        """The types that all objects of any of the given types have."""
        objects = self._prompt.objects.values()
        having = [has for has in objects if not has.isdisjoint(types)]
        return frozenset.intersection(*having) if having else frozenset()

    def _ideas_of(self, title: str) -> list[tuple[str, WrittenPredicate]]:
        found = []
        for predicate in self._prompt.predicates(title) if self._seen else ():
            meaning = self._understand(predicate)
            if meaning is not None:
                found.append((meaning, predicate))
        return found

    def _understand(self, predicate: WrittenPredicate) -> str | None:
        if self._seen is None:
            return None
        graph = self._seen.graph
        kinds = []
        for type_name in predicate.types:
            having = [n for n, types in self._prompt.objects.items() if type_name in types]
            kinds.append(next((graph.kind(name) for name in having if name in graph), ""))
        meant = self._lexicon.understand(predicate.name, kinds, predicate.semantics, graph)
        return meant.concept.idea if meant else None
