"""Pictures small enough to travel inside a page."""

from __future__ import annotations

import base64
import hashlib
import io

from PIL import Image, UnidentifiedImageError

from skillwrapper.runs.archive.pictures import PictureStore

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
        pictures: those of the run.
        width: of the copies in pixels, at most; heights follow.
    """

    def __init__(self, pictures: PictureStore, width: int) -> None:
        self._pictures, self._thumbnails = pictures, Thumbnails(width)
        self._made: dict[str, str | None] = {}

    def uri(self, sha256: str) -> str | None:
        """The picture as a data URI; None if it is missing or damaged."""
        if sha256 not in self._made:
            self._made[sha256] = self._make(self._pictures.find(sha256))
        return self._made[sha256]

    def _make(self, png: bytes | None) -> str | None:
        try:
            return None if png is None else self._thumbnails.uri(png)
        except (OSError, ValueError, UnidentifiedImageError):
            return None
