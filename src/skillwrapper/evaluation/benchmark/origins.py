"""Where the results of an experiment come from: command and code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Origin:
    """A command that ran cells of an experiment.

    Attributes:
        command: as it was given.
        made_with: versions and commit, as ``run.provenance`` tells them.
    """

    command: str
    made_with: Mapping[str, Any]

    @property
    def code(self) -> str:
        """Version and commit in words."""
        made = self.made_with
        commit = made.get("commit")
        where = f"commit {commit[:12]}" if commit else "no commit known"
        changed = " with uncommitted changes" if made.get("changed") else ""
        packages = made.get("packages") or {}
        versions = [f"Python {made.get('python')}", *(f"{n} {v}" for n, v in packages.items() if v)]
        return f"skillwrapper {made.get('skillwrapper')}, {where}{changed} ({', '.join(versions)})"
