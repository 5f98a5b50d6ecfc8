"""Pictures of a world.

Contexts of OpenGL belong to one thread, so one thread of the process takes all pictures; a process
that was forked takes its own.
"""

from __future__ import annotations

import os
from collections import OrderedDict
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from skillwrapper.domains.tabletop.cameras import Camera
from skillwrapper.domains.tabletop.extra import mujoco, no_rendering
from skillwrapper.domains.tabletop.stage import new_stage
from skillwrapper.domains.tabletop.world import TableWorld
from skillwrapper.errors import SkillWrapperError

Pixels = NDArray[np.uint8]
_KEPT_RENDERERS: Final = 4
_SHOWN_GROUP: Final = 1
"""Of geoms; the others are there to be touched."""


class Photographer:
    """Takes pictures.

    Args:
        width: in pixels.
        height: in pixels.
    """

    def __init__(self, width: int = 640, height: int = 480) -> None:
        self.width, self.height = width, height

    def take(self, world: TableWorld, camera: str) -> Pixels:
        """A picture (height, width, 3) of the present.

        Raises:
            MissingDependencyError: if there is nothing to render with.
        """
        return _dark_room(os.getpid()).submit(self._take, world, camera).result()

    def _take(self, world: TableWorld, camera: str) -> Pixels:
        m = mujoco()
        renderer = _renderer(world.model, self.width, self.height)
        m.mj_camlight(world.model, world.data)
        renderer.update_scene(world.data, camera, _options())
        pixels: Pixels = renderer.render()
        return pixels


def check_rendering() -> None:
    """Take a picture of an empty table.

    Raises:
        MissingDependencyError: if MuJoCo, or what it renders with, is missing; says which.
    """
    stage = new_stage({"front": Camera((1.0, 0.0, 1.0), (0.0, 0.0, 0.0), 45.0)})
    Photographer(64, 48).take(TableWorld(stage.compile(), []), "front")


@cache
def _dark_room(process: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(max_workers=1, thread_name_prefix=f"photos of {process}")


_RENDERERS: OrderedDict[tuple[int, int, int], tuple[Any, Any]] = OrderedDict()
"""Renderers with their models, used last at the end; only the thread of the pictures touches it."""


def _renderer(model: Any, width: int, height: int) -> Any:
    key = (id(model), width, height)
    if key not in _RENDERERS:
        while len(_RENDERERS) >= _KEPT_RENDERERS:
            _RENDERERS.popitem(last=False)[1][1].close()
        _RENDERERS[key] = (model, _made(lambda: mujoco().Renderer(model, height, width)))
    _RENDERERS.move_to_end(key)
    return _RENDERERS[key][1]


def _made(make: Callable[[], Any]) -> Any:
    try:
        return make()
    except SkillWrapperError:
        raise
    except Exception as error:  # MuJoCo has many names for "no driver"
        raise no_rendering(error) from error


@cache
def _options() -> Any:
    options = mujoco().MjvOption()
    options.geomgroup[:] = 0
    options.geomgroup[_SHOWN_GROUP] = 1
    options.sitegroup[:] = 0
    return options
