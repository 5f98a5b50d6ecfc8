"""Meshes and compounds that the objects on the table are made of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skillwrapper.domains.tabletop.extra import mujoco

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Vertices (n, 3) and faces (m, 3)."""

VISIBLE: Final[Mapping[str, Any]] = MappingProxyType(
    {"contype": 0, "conaffinity": 0, "group": 1, "mass": 0.0}
)
"""For geoms that are seen and never touched."""
SOLID: Final[Mapping[str, Any]] = MappingProxyType({"group": 3})
"""For geoms that are touched and never seen."""


def lathe(profile: Sequence[tuple[float, float]], sides: int = 40) -> Mesh:
    """A surface of revolution around z.

    Args:
        profile: radius and height from point to point.
        sides: of the polygon that stands for a circle.
    """
    angles = 2 * np.pi * np.arange(sides) / sides
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    vertices = np.concatenate(
        [np.column_stack([r * circle, np.full(sides, z)]) for r, z in profile]
    )
    return vertices, _quads(len(profile), sides)


def sweep(path: ArrayLike, radii: ArrayLike, sides: int = 16) -> Mesh:
    """A tube along a path in the plane of x and z, closed at both ends.

    Args:
        path: points (n, 3).
        radii: of the tube at each point (n,).
        sides: of the polygon that stands for a circle.
    """
    points = np.asarray(path, float)
    along = np.gradient(points, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, np.newaxis]
    across = np.cross(np.array([0.0, 1.0, 0.0]), along)
    across /= np.linalg.norm(across, axis=1)[:, np.newaxis]
    beside = np.cross(along, across)
    angles = 2 * np.pi * np.arange(sides) / sides
    rings = [
        p + r * (np.outer(np.cos(angles), u) + np.outer(np.sin(angles), v))
        for p, r, u, v in zip(points, np.asarray(radii, float), across, beside, strict=True)
    ]
    first, last, count = len(points) * sides, len(points) * sides + 1, len(points)
    following = (np.arange(sides) + 1) % sides
    end = (count - 1) * sides
    lids = [
        np.column_stack([np.full(sides, first), np.arange(sides), following]),
        np.column_stack([np.full(sides, last), end + following, end + np.arange(sides)]),
    ]
    vertices = np.concatenate([*rings, points[[0, -1]]])
    return vertices, np.concatenate([_quads(count, sides)[:, ::-1], *(lid for lid in lids)])


def add_mesh(spec: Any, name: str, mesh: Mesh) -> str:
    """Give a mesh to a model.

    Returns:
        Its name, for ``add_geom(meshname=...)``.
    """
    vertices, faces = mesh
    added = spec.add_mesh(name=name)
    added.uservert = vertices.ravel().tolist()
    added.userface = faces.ravel().tolist()
    added.inertia = mujoco().mjtMeshInertia.mjMESH_INERTIA_SHELL
    return name


def add_ring(
    body: Any,
    name: str,
    radius: float,
    height: float,
    bottom: float,
    *,
    thickness: float = 0.004,
    sides: int = 14,
    **options: Any,
) -> None:
    """An upright wall around z, of boxes, since what is hollow must not be one convex geom.

    Args:
        body: what it is added to.
        name: of the geoms, before a number.
        radius: of its middle.
        height: from its lower to its upper edge.
        bottom: height of its lower edge.
        thickness: half of that of the wall.
        sides: how many boxes.
        **options: of the geoms.
    """
    for side in range(sides):
        angle = 2 * np.pi * side / sides
        c, s = np.cos(angle), np.sin(angle)
        body.add_geom(
            name=f"{name}{side}",
            type=mujoco().mjtGeom.mjGEOM_BOX,
            size=[thickness, radius * np.tan(np.pi / sides) + 0.001, height / 2],
            pos=[radius * c, radius * s, bottom + height / 2],
            quat=[np.cos(angle / 2), 0, 0, np.sin(angle / 2)],
            **options,
        )


def _quads(rings: int, sides: int) -> NDArray[np.int64]:
    """Faces between rings of vertices, seen from outside."""
    ring, side = (grid.ravel() for grid in np.mgrid[: rings - 1, :sides])
    a, b = ring * sides + side, ring * sides + (side + 1) % sides
    c, d = a + sides, b + sides
    return np.concatenate([np.column_stack([a, b, d]), np.column_stack([a, d, c])])
