"""What is said between skillwrapper and a robot in another process (docs/running.md).

One JSON object a line, in turns: a call on the standard input of the robot, its answer on its
standard output. Whatever else a robot wants to say goes to standard error.

============================================================ =====================================
call                                                         answer
============================================================ =====================================
``{"call": "hello", "protocol": 1, "domain": NAME}``         ``{"protocol": 1}``, may say
                                                             ``"replayable"``, ``"lasting"``
``{"call": "prepare", "seed": 3, "scene": NAME}``            ``{}``, may say ``"scene"``: a name,
                                                             or names of the objects present
``{"call": "look"}``                                         ``{"pictures": {CAMERA: PICTURE}}``
``{"call": "run", "skill": NAME, "arguments": [NAME, ...]}`` ``{"success": true}``, may say
                                                             ``"message"``, ``"changed"``
``{"call": "stop"}``                                         ``{}``
============================================================ =====================================

A picture is the path of a file, or the bytes of one in base64 after ``base64:``. Any answer may be
``{"error": TEXT}`` instead: the robot itself does not work.
"""

from __future__ import annotations

import base64
import binascii

from pydantic import BaseModel, ConfigDict, Field

from skillwrapper.errors import PictureError

PROTOCOL = 1
_BYTES = "base64:"


class Answer(BaseModel):
    """Any answer: nothing to say, or what is wrong."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)

    error: str | None = None


class HelloAnswer(Answer):
    """What the robot is."""

    protocol: int = PROTOCOL
    replayable: bool = False
    lasting: bool = False


class PrepareAnswer(Answer):
    """What is present."""

    scene: str | list[str] | None = None


class LookAnswer(Answer):
    """What is seen, by camera."""

    pictures: dict[str, str] = Field(default_factory=dict)


class RunAnswer(Answer):
    """What came of a skill; without an error, ``success`` is there."""

    success: bool | None = None
    message: str = ""
    changed: bool | None = None


def pack_picture(png: bytes) -> str:
    """The bytes of a picture as text."""
    return _BYTES + base64.b64encode(png).decode("ascii")


def unpack_picture(text: str) -> str | bytes:
    """What an answer means by a picture: a path, or the bytes of a file.

    Raises:
        PictureError: if it is no base64.
    """
    if not text.startswith(_BYTES):
        return text
    try:
        return base64.b64decode(text.removeprefix(_BYTES), validate=True)
    except binascii.Error as error:
        raise PictureError(f"expected base64 after '{_BYTES}', got something else") from error
