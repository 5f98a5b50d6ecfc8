"""Pictures small enough to travel inside a page."""

from __future__ import annotations

import base64
import hashlib
import io
from pathlib import Path

from PIL import Image, UnidentifiedImageError

_QUALITY = 82


class Thumbnails:
    """Downscaled copies of pictures as data URIs; equal pictures are made once.

    Args:
        width: of the copies in pixels, at most; heights follow.
    """

    def __init__(self, width: int) -> None:
        self._width = width
        self._made: dict[bytes, str] = {}

    def uri(self, png: bytes) -> str:
        """The picture as a data URI.

        Raises:
            OSError: if it is no picture.
        """
        key = hashlib.sha256(png).digest()
        if key not in self._made:
            self._made[key] = self._make(png)
        return self._made[key]

    def _make(self, png: bytes) -> str:
        with Image.open(io.BytesIO(png)) as image:
            small = image.convert("RGB")
        height = round(small.height * self._width / small.width)
        if small.width > self._width:
            small = small.resize((self._width, max(1, height)), Image.Resampling.LANCZOS)
        data = io.BytesIO()
        small.save(data, "WEBP", quality=_QUALITY, method=4)
        return f"data:image/webp;base64,{base64.b64encode(data.getvalue()).decode('ascii')}"


class PictureBook:
    """Downscaled copies of a run's pictures as data URIs; each is made once.

    Args:
        folder: where ``<sha256>.png`` stand.
        width: of the copies in pixels, at most; heights follow.
    """

    def __init__(self, folder: Path, width: int) -> None:
        self._folder, self._thumbnails = folder, Thumbnails(width)
        self._made: dict[str, str | None] = {}

    def uri(self, sha256: str) -> str | None:
        """The picture as a data URI; None if it is missing or damaged."""
        if sha256 not in self._made:
            self._made[sha256] = self._make(self._folder / f"{sha256}.png")
        return self._made[sha256]

    def _make(self, path: Path) -> str | None:
        try:
            return self._thumbnails.uri(path.read_bytes())
        except (OSError, UnidentifiedImageError):
            return None
