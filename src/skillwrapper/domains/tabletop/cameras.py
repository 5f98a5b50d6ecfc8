"""Cameras: where they stand, and where in the picture a point is seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skillwrapper.domains.tabletop.poses import Matrix, Vector

Floats = NDArray[np.float64]
WIDTH, HEIGHT = 640, 480
"""Of the pictures that environments take, in pixels."""
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Camera:
    """A camera without lens errors.

    Attributes:
        position: where it is.
        target: what it looks at, in the middle of its picture.
        field_of_view: angle from the upper to the lower edge, in degrees.
    """

    position: tuple[float, float, float]
    target: tuple[float, float, float]
    field_of_view: float

    @property
    def rotation(self) -> Matrix:
        """Its axes as columns: right, up, and backwards, as MuJoCo has them."""
        forward = np.subtract(self.target, self.position)
        forward = forward / np.linalg.norm(forward)
        right = np.cross(forward, _UP)
        right = right / np.linalg.norm(right)
        return np.column_stack([right, np.cross(right, forward), -forward])

    def project(self, points: ArrayLike, width: int, height: int) -> tuple[Floats, Floats]:
        """Column and row (...) at which points (..., 3) are seen in a picture."""
        seen = (np.asarray(points, float) - self.position) @ self.rotation
        scale = height / 2 / np.tan(np.radians(self.field_of_view) / 2)
        depth = -seen[..., 2]
        return width / 2 + scale * seen[..., 0] / depth, height / 2 - scale * seen[..., 1] / depth

    def ray(self, column: float, row: float, width: int, height: int) -> Vector:
        """Direction (3,) in which a pixel is seen."""
        scale = height / 2 / np.tan(np.radians(self.field_of_view) / 2)
        inside = np.array([(column - width / 2) / scale, (height / 2 - row) / scale, -1.0])
        return np.asarray(self.rotation @ inside)

    def on_plane(
        self, column: float, row: float, width: int, height: int, z: float
    ) -> tuple[float, float]:
        """Where (x, y) a pixel's ray meets the plane of a height z."""
        direction = self.ray(column, row, width, height)
        length = (z - self.position[2]) / direction[2]
        x, y = (self.position[i] + length * direction[i] for i in (0, 1))
        return float(x), float(y)
