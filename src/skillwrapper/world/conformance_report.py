"""What an examination of an environment has seen beside the rules that it kept."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any


class Level(StrEnum):
    """How much is asked of an environment."""

    ROBOT = "robot"
    SIMULATOR = "simulator"


@dataclass(frozen=True)
class SkillTally:
    """How the random runs of a skill went.

    Attributes:
        runs: how many.
        successes: how many of them succeeded.
        longest: seconds that the longest one took.
    """

    runs: int = 0
    successes: int = 0
    longest: float = 0.0

    def with_run(self, success: bool, seconds: float) -> SkillTally:
        """The tally with one more run."""
        return SkillTally(self.runs + 1, self.successes + success, max(self.longest, seconds))


@dataclass(frozen=True)
class ConformanceReport:
    """An environment that keeps every rule of its level.

    Attributes:
        level: what was asked.
        picture_sizes: width and height in pixels, by camera.
        skills: how they went, by name; all skills of the domain.
    """

    level: Level
    picture_sizes: Mapping[str, tuple[int, int]]
    skills: Mapping[str, SkillTally]

    def remarks(self) -> Iterator[str]:
        """What breaks no rule and still deserves a look."""
        for name, skill in self.skills.items():
            if not skill.runs:
                yield f"{name} was not tried; run more skills (--steps)"
            elif not skill.successes:
                yield f"{name} never succeeded; nothing can be learned of it until it does"

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "kept_rules_of": str(self.level),
            "picture_sizes": {camera: list(size) for camera, size in self.picture_sizes.items()},
            "skills": {
                name: {"runs": s.runs, "successes": s.successes, "longest_seconds": s.longest}
                for name, s in self.skills.items()
            },
            "remarks": list(self.remarks()),
        }
