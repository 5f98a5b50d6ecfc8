"""MuJoCo, imported when it is needed: all else works without it."""

from __future__ import annotations

import importlib
import os
import sys
from functools import cache
from typing import Any

from skillwrapper.errors import MissingDependencyError

SIM = "pip install 'skillwrapper[sim]'"
DEBIAN_PACKAGES = ("libegl1", "libegl-mesa0", "libopengl0", "libgl1-mesa-dri")
"""What rendering without a screen needs on Debian and its kin."""


@cache
def mujoco() -> Any:
    """The module ``mujoco``, set up to render without a screen.

    Raises:
        MissingDependencyError: if it is not installed, or there is nothing to render with.
    """
    if sys.platform.startswith("linux"):
        os.environ.setdefault("MUJOCO_GL", "egl")
    return _imported("mujoco", "MuJoCo")


def mesh_reduction() -> Any:
    """The module that reduces meshes.

    Raises:
        MissingDependencyError: if it is not installed.
    """
    return _imported("fast_simplification", "fast-simplification")


def no_rendering(error: Exception) -> MissingDependencyError:
    """What to say where MuJoCo finds nothing to render with."""
    what = f"what MuJoCo renders with (MUJOCO_GL={os.environ.get('MUJOCO_GL', '')}: {error})"
    how = f"apt-get install {' '.join(DEBIAN_PACKAGES)} (and leave MUJOCO_GL unset)"
    return MissingDependencyError(what, how)


def _imported(module: str, name: str) -> Any:
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        raise MissingDependencyError(f"{name}, for the simulated arms,", SIM) from error
    except (ImportError, AttributeError, RuntimeError) as error:
        raise no_rendering(error) from error
