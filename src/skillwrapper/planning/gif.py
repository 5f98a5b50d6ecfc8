"""An attempt as an animated picture."""

from __future__ import annotations

import io
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from skillwrapper.files.writing import write_atomically
from skillwrapper.planning.execution import Attempt
from skillwrapper.world.observation import Observation

_CAPTION_HEIGHT = 44
_TEXT_SIZE = 20
_PAPER, _INK = (250, 248, 244), (48, 44, 56)
_GOOD, _BAD = (46, 140, 82), (196, 60, 52)


def save_gif(path: Path, attempt: Attempt, *, seconds: float = 0.9, goal: str = "") -> None:
    """Save what was seen during an attempt, every picture with the skill that led to it.

    Args:
        path: the file to write.
        attempt: the attempt.
        seconds: how long each picture is shown; the last one three times as long.
        goal: shown under the first picture.
    """
    total = len(attempt.plan)
    captions = [(f"Goal: {goal}" if goal else "Start", _INK)]
    for number, outcome in enumerate(attempt.outcomes):
        end = "done" if outcome.success else "failed"
        text = f"{number + 1}/{total}  {attempt.plan[number]}: {end}"
        captions.append((text, _GOOD if outcome.success else _BAD))
    if attempt.failed_at is None:
        text, colour = captions[-1]
        reached = "goal reached" if attempt.goal_reached else "goal not reached"
        captions[-1] = (f"{text}, {reached}", colour if attempt.goal_reached else _BAD)
    frames = [
        _frame(observation, text, colour)
        for observation, (text, colour) in zip(attempt.observations, captions, strict=True)
    ]
    shown = [round(1000 * seconds)] * len(frames)
    shown[-1] *= 3
    data = io.BytesIO()
    frames[0].save(
        data, "GIF", save_all=True, append_images=frames[1:], duration=shown, loop=0, optimize=False
    )
    write_atomically(path, data.getvalue())


def _frame(observation: Observation, text: str, colour: tuple[int, int, int]) -> Image.Image:
    """All cameras side by side over a caption."""
    views = [Image.open(io.BytesIO(p.png)).convert("RGB") for p in observation.pictures]
    width, height = sum(v.width for v in views), max(v.height for v in views)
    frame = Image.new("RGB", (width, height + _CAPTION_HEIGHT), _PAPER)
    left = 0
    for view in views:
        frame.paste(view, (left, 0))
        left += view.width
    draw = ImageDraw.Draw(frame)
    draw.rectangle((0, height, 7, height + _CAPTION_HEIGHT), colour)
    font = _font_that_fits(text, width - 24)
    middle = height + _CAPTION_HEIGHT // 2
    draw.text((16, middle), text, fill=colour, font=font, anchor="lm")
    return frame


def _font_that_fits(text: str, width: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    for size in range(_TEXT_SIZE, 8, -1):
        font = ImageFont.load_default(size)
        if font.getlength(text) <= width:
            return font
    return ImageFont.load_default(8)
