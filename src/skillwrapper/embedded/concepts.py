"""Visual concepts: what the embedded model can see, and how it speaks of it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

from skillwrapper.embedded.sight import Sight
from skillwrapper.embedded.words import Wording

Judge = Callable[[Sight, tuple[str, ...]], bool]


@dataclass(frozen=True)
class Concept:
    """A property or relation that can be read off a picture.

    Attributes:
        key: unique in a lexicon.
        idea: what is judged; opposites and inverses share an idea.
        arity: how many things it is about, 0 to 2.
        judge: whether the idea holds of things that are all seen.
        wording: how it is spoken of.
        kinds: the kinds of things it can be said of; None for any.
        local: whether it is about contact or the look of a thing, not about the picture.
        positive: whether it holds when its idea does.
    """

    key: str
    idea: str
    arity: int
    judge: Judge
    wording: Wording
    kinds: frozenset[tuple[str, ...]] | None = None
    local: bool = True
    positive: bool = True

    @cached_property
    def pattern(self) -> re.Pattern[str]:
        """Finds it in a name or meaning that somebody else wrote."""
        return re.compile(rf"\b(?:{'|'.join(self.wording.cues)})\b", re.IGNORECASE)

    def truth(self, sight: Sight, arguments: tuple[str, ...]) -> bool | None:
        """Whether it holds; None if something it is about is not seen."""
        if any(name not in sight.graph for name in arguments):
            return None
        return self.judge(sight, arguments) is self.positive

    def fits(self, kinds: Sequence[str]) -> bool:
        """Whether it can be said of things of these kinds."""
        return len(kinds) == self.arity and (self.kinds is None or tuple(kinds) in self.kinds)

    def describe(self, meaning: str, types: Sequence[str]) -> str:
        """One of its meanings with the types of the parameters filled in."""
        if len(types) == 2 and types[0] == types[1]:
            return meaning.format(f"first {types[0]}", f"second {types[1]}")
        return meaning.format(*types)
