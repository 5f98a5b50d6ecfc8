"""Pictures out of messages of ROS, as rosbridge sends them."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from typing import Any

import numpy as np

_COMPRESSED = "/compressed"
_CHANNELS = {
    "rgb8": (0, 1, 2),
    "bgr8": (2, 1, 0),
    "rgba8": (0, 1, 2),
    "bgra8": (2, 1, 0),
    "mono8": (0, 0, 0),
    "8UC3": (2, 1, 0),
}
"""Where red, green and blue are; ``8UC3`` is what OpenCV publishes."""
_DEPTH = {"mono8": 1, "rgba8": 4, "bgra8": 4}


def message_type(topic: str) -> str:
    """The type of a topic of pictures, by the convention of ``image_transport``."""
    kind = "CompressedImage" if topic.endswith(_COMPRESSED) else "Image"
    return f"sensor_msgs/msg/{kind}"


def picture_of(message: Mapping[str, Any]) -> Any:
    """A message as the bytes of a file (``CompressedImage``), or an array (height, width, 3).

    Raises:
        KeyError: if a field is missing.
        ValueError: if the encoding is not known, or there are too few bytes.
    """
    data = base64.b64decode(message["data"], validate=True)
    if "format" in message:
        return data
    encoding = message["encoding"]
    if encoding not in _CHANNELS:
        known = ", ".join(_CHANNELS)
        raise ValueError(f"expected an encoding of {known}; got '{encoding}'")
    height, width, step = (int(message[name]) for name in ("height", "width", "step"))
    depth = _DEPTH.get(encoding, 3)
    if len(data) < height * step or step < width * depth:
        raise ValueError(f"expected {height} rows of {step} bytes, got {len(data)} bytes")
    rows = np.frombuffer(data, np.uint8, height * step).reshape(height, step)
    pixels = rows[:, : width * depth].reshape(height, width, depth)
    return np.ascontiguousarray(pixels[:, :, _CHANNELS[encoding]])
