"""What a concept is called, and how it is described."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from skillwrapper.embedded.concepts import Concept


def wordings(concept: Concept) -> Iterator[tuple[str, str]]:
    """Its names and its meanings in pairs, until each of them had its turn."""
    names, meanings = concept.wording.names, concept.wording.meanings
    turns = max(len(names), len(meanings))
    return itertools.islice(zip(itertools.cycle(names), itertools.cycle(meanings)), turns)
