"""Looking at pictures: PNG bytes in, a scene out; every picture is read once."""

from __future__ import annotations

import hashlib
import struct
import threading
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from skillwrapper.domains.burger.scene_reader import read_burger_scene
from skillwrapper.embedded.scene import Scene
from skillwrapper.errors import PictureError

SceneReader = Callable[[bytes], Scene]

BUNDLED_READERS: tuple[SceneReader, ...] = (read_burger_scene,)
"""One scene reader for every bundled domain; each raises ``PictureError`` on other pictures."""


@dataclass(frozen=True)
class Sight:
    """What is seen in one picture.

    Attributes:
        scene: what is where.
        width: of the picture, in pixels.
        height: of the picture, in pixels.
        key: SHA-256 of the picture.
    """

    scene: Scene
    width: int
    height: int
    key: str


Sights = Sequence[Sight | None]
"""What is seen in the pictures of a prompt, in their order; None where nothing is recognised."""


def sight_at(sights: Sights, position: int | None) -> Sight | None:
    """What is seen in one of the pictures; None if there is no such picture."""
    return sights[position] if position is not None and position < len(sights) else None


class Eye:
    """Reads pictures and remembers the last ones. Safe to use from several threads.

    Args:
        readers: tried in order until one knows the picture.
        memory: how many pictures are remembered.
    """

    def __init__(
        self, readers: Sequence[SceneReader] = BUNDLED_READERS, memory: int = 8192
    ) -> None:
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
                scene = reader(png)
            except PictureError:
                continue
            width, height = struct.unpack(">II", png[16:24])
            return Sight(scene, width, height, key)
        return None
