"""Answering the prompt that asks for a predicate in general terms: words are replaced."""

from __future__ import annotations

import re

from skillwrapper.embedded.prompt_text import PromptText

_SOME = r"\b(?:an?|some|any|one)[ _-]"


def rephrase(prompt: PromptText) -> str:
    """The candidate with a parameter in place of what it names."""
    (candidate,) = prompt.predicates("Candidate")[:1] or (None,)
    new = [name for name in prompt.allowed if candidate and name not in candidate.types]
    if candidate is None or not new:
        return "I do not see what could be said in more general terms."
    name, meaning = candidate.name, candidate.semantics
    for thing, types in prompt.objects.items():
        if new[0] in types:
            name, meaning = (_replaced(text, thing, new[0]) for text in (name, meaning))
    meaning = re.sub(rf"{_SOME}{re.escape(new[0])}\b", f"the {new[0]}", meaning)
    parameters = ", ".join(f"?{t}" for t in (*candidate.types, new[0]))
    return f"{name}({parameters}): {meaning}"


def _replaced(text: str, thing: str, type_name: str) -> str:
    words = r"[ _-]".join(map(re.escape, re.split(r"[_-]", thing)))
    return re.sub(rf"(?<![A-Za-z0-9]){words}(?![A-Za-z0-9])", type_name, text, flags=re.IGNORECASE)
