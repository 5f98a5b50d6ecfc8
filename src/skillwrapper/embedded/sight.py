"""Looking at pictures: PNG bytes in, a sight out; every picture is read once."""

from __future__ import annotations

import hashlib
import struct
import threading
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from skillwrapper.embedded.facts import Fact
from skillwrapper.embedded.scene_graph import SceneGraph
from skillwrapper.errors import PictureError

SceneReader = Callable[[bytes], SceneGraph]
"""Reads the bytes of a PNG; raises ``PictureError`` on pictures of something else."""


@dataclass(frozen=True)
class Sight:
    """What is seen in one picture, every fact of it rightly.

    Attributes:
        graph: what is where.
        size: width and height of the picture, in pixels.
        key: SHA-256 of the picture.
    """

    graph: SceneGraph
    size: tuple[int, int]
    key: str

    def holds(self, fact: Fact) -> bool:
        """Whether a fact seems to be the case."""
        return fact.truth(self.graph, self.size)


Sights = Sequence[Sight | None]
"""What is seen in the pictures of a prompt, in their order; None where nothing is recognised."""


def sight_at(sights: Sights, position: int | None) -> Sight | None:
    """What is seen in one of the pictures; None if there is no such picture."""
    return sights[position] if position is not None and position < len(sights) else None


def first_sight(sights: Sights) -> Sight | None:
    """What is seen in the first picture that shows anything known."""
    return next((sight for sight in sights if sight is not None), None)


class Eye:
    """Reads pictures and remembers the last ones. Safe to use from several threads.

    Args:
        readers: tried in order until one knows the picture.
        memory: how many pictures are remembered.
    """

    def __init__(self, readers: Sequence[SceneReader], memory: int = 8192) -> None:
        self._readers, self._memory = tuple(readers), memory
        self._seen: OrderedDict[str, Sight | None] = OrderedDict()
        self._lock = threading.Lock()

    def look(self, png: bytes, key: str | None = None) -> Sight | None:
        """What a picture shows; None if it is of nothing that any reader knows.

        Args:
            png: the picture.
            key: its SHA-256, if it is known already.
        """
        key = key or hashlib.sha256(png).hexdigest()
        with self._lock:
            if key in self._seen:
                self._seen.move_to_end(key)
                return self._seen[key]
        sight = self._read(png, key)
        with self._lock:
            self._seen[key] = sight
            while len(self._seen) > self._memory:
                self._seen.popitem(last=False)
        return sight

    def _read(self, png: bytes, key: str) -> Sight | None:
        for reader in self._readers:
            try:
                graph = reader(png)
            except PictureError:
                continue
            width, height = struct.unpack(">II", png[16:24])
            return Sight(graph, (width, height), key)
        return None
