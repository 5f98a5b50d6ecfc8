"""Visual concepts: what the embedded model can see in a scene, and how it speaks of it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.embedded.sight import Sight

ANY = "any"
"""A parameter of a concept that may be a thing of any kind."""

Judge = Callable[[Sight, tuple[str, ...]], bool]


@dataclass(frozen=True)
class Concept:
    """A property or relation that can be read off a scene.

    Attributes:
        key: unique in the lexicon.
        kinds: the kind of thing of every parameter, or ``ANY``.
        idea: what is judged; opposites and inverses share an idea.
        judge: whether the idea holds of things that are all in the scene.
        names: what a predicate for it may be called; no two concepts share a name.
        meanings: sentences that say what it means; ``{0}`` and ``{1}`` are the parameters.
        cue: finds it in a name or meaning that somebody else wrote.
        salience: how readily it comes to mind, against others.
        local: whether it is about contact or the look of a thing, not about the picture.
        positive: whether it holds when its idea does.
    """

    key: str
    kinds: tuple[str, ...]
    idea: str
    judge: Judge
    names: tuple[str, ...]
    meanings: tuple[str, ...]
    cue: str
    salience: float = 1.0
    local: bool = False
    positive: bool = True

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        """The compiled cue."""
        return re.compile(self.cue, re.IGNORECASE)

    def truth(self, sight: Sight, arguments: tuple[str, ...]) -> bool | None:
        """Whether it holds; None if something it is about is not seen."""
        if any(name not in sight.scene for name in arguments):
            return None
        return self.judge(sight, arguments) is self.positive

    def fits(self, kinds: Sequence[str]) -> bool:
        """Whether it can be said of things of these kinds."""
        return len(kinds) == len(self.kinds) and all(
            mine in {ANY, given} for mine, given in zip(self.kinds, kinds, strict=True)
        )

    def describe(self, meaning: str, types: Sequence[str]) -> str:
        """One of its meanings with the types of the parameters filled in."""
        if len(types) == 2 and types[0] == types[1]:
            return meaning.format(f"first {types[0]}", f"second {types[1]}")
        return meaning.format(*types)
