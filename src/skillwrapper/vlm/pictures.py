"""Preparing pictures for a request: not larger than wanted, as data URLs."""

from __future__ import annotations

import base64
import io
import threading
from collections import OrderedDict

from PIL import Image

from skillwrapper.world.observation import Picture
from skillwrapper.world.pictures import encode_png, upright


class PictureEncoder:
    """Turns pictures into data URLs and remembers the last ones. Safe to use from threads.

    Args:
        largest: a picture with a longer side is scaled down to this many pixels; None for never.
        memory: how many pictures are remembered.
    """

    def __init__(self, largest: int | None, memory: int = 64) -> None:
        self._largest, self._memory = largest, memory
        self._known: OrderedDict[str, str] = OrderedDict()
        self._lock = threading.Lock()

    def data_url(self, picture: Picture) -> str:
        """The picture as ``data:image/png;base64,...``; small ones byte for byte as they are."""
        with self._lock:
            if picture.sha256 in self._known:
                self._known.move_to_end(picture.sha256)
                return self._known[picture.sha256]
        png = picture.png if self._largest is None else scaled_down(picture.png, self._largest)
        url = f"data:image/png;base64,{base64.b64encode(png).decode('ascii')}"
        with self._lock:
            self._known[picture.sha256] = url
            while len(self._known) > self._memory:
                self._known.popitem(last=False)
        return url


def scaled_down(png: bytes, largest: int) -> bytes:
    """The picture with its longer side at most ``largest`` pixels, as ``world`` would show it."""
    with Image.open(io.BytesIO(png)) as image:
        if max(image.size) <= largest:
            return png
        shown = upright(image)
    factor = largest / max(shown.size)
    size = (max(1, round(shown.width * factor)), max(1, round(shown.height * factor)))
    return encode_png(shown.resize(size, Image.Resampling.LANCZOS))
