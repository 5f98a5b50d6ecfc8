"""Which code made a result: versions, commit, machine."""

from __future__ import annotations

import importlib.metadata
import platform
import subprocess
from pathlib import Path

import skillwrapper

_PACKAGES = ("numpy", "pillow", "pydantic", "openai", "kstar-planner", "jinja2")


def provenance() -> dict[str, object]:
    """Versions of skillwrapper, Python and packages, and the commit of a source checkout.

    ``commit`` is None outside a checkout; ``changed`` says whether files differ from it.
    """
    commit = _git("rev-parse", "HEAD")
    return {
        "skillwrapper": skillwrapper.__version__,
        "commit": commit,
        "changed": bool(_git("status", "--porcelain", "--untracked-files=no")) if commit else None,
        "python": platform.python_version(),
        "packages": {name: _version(name) for name in _PACKAGES},
    }


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
