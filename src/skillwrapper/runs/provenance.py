"""Which code made a result: versions, commit, machine."""

from __future__ import annotations

import importlib.metadata
import platform
import subprocess
from pathlib import Path

from pydantic import BaseModel, ConfigDict

import skillwrapper

_PACKAGES = ("numpy", "pillow", "pydantic", "openai", "kstar-planner", "jinja2")


class Provenance(BaseModel):
    """Which code made something.

    Attributes:
        skillwrapper: its version.
        commit: of a source checkout; None outside one.
        changed: whether files of the checkout differed from the commit; None outside one.
        python: its version.
        packages: versions of the packages that results depend on most; None if not installed.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    skillwrapper: str
    commit: str | None
    changed: bool | None
    python: str
    packages: dict[str, str | None]


def provenance() -> Provenance:
    """The code that runs now."""
    commit = _git("rev-parse", "HEAD")
    return Provenance(
        skillwrapper=skillwrapper.__version__,
        commit=commit,
        changed=bool(_git("status", "--porcelain", "--untracked-files=no")) if commit else None,
        python=platform.python_version(),
        packages={name: _version(name) for name in _PACKAGES},
    )


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def _git(*arguments: str) -> str | None:
    folder = Path(skillwrapper.__file__).parent
    try:
        done = subprocess.run(
            ["git", "-C", str(folder), *arguments],
            capture_output=True,
            text=True,
            check=True,
            timeout=10,
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout.strip() or None
