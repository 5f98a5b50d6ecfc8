"""What a line of a recording says (docs/running.md)."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import BaseModel, ConfigDict, Field, field_validator

_TRUTH: Mapping[str, bool] = {"true": True, "false": False, "1": True, "0": False}
COLUMNS = ("episode", "skill", "arguments", "success", "before", "after", "scene")
"""Of a recording; ``scene`` may be missing."""


class RecordedRow(BaseModel):
    """A line of a recording: one execution of a skill.

    In CSV, arguments are separated by blanks; several cameras are ``front=a.png top=b.png``.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    episode: str = Field(min_length=1, coerce_numbers_to_str=True)
    skill: str
    arguments: tuple[str, ...]
    success: bool
    before: dict[str, str]
    after: dict[str, str]
    scene: str | None = None

    @field_validator("arguments", mode="before")
    @classmethod
    def _split_arguments(cls, value: object) -> object:
        return tuple(value.replace(",", " ").split()) if isinstance(value, str) else value

    @field_validator("success", mode="before")
    @classmethod
    def _read_truth(cls, value: object) -> object:
        known = _TRUTH.get(str(value).strip().lower())
        if known is None:
            raise ValueError("expected true or false")
        return known

    @field_validator("before", "after", mode="before")
    @classmethod
    def _split_cameras(cls, value: object) -> object:
        if not isinstance(value, str):
            return value
        parts = [part.partition("=") for part in value.split()] if "=" in value else []
        if parts and all(equals and file for _, equals, file in parts):
            return {camera: file for camera, _, file in parts}
        return {"main": value.strip()}

    @field_validator("scene", mode="before")
    @classmethod
    def _no_scene(cls, value: object) -> object:
        return value or None
