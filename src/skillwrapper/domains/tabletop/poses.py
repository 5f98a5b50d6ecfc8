"""Where things are in space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Pose:
    """A place and a direction.

    Attributes:
        position: in metres (3,).
        rotation: its axes as columns (3, 3).
    """

    position: Vector
    rotation: Matrix

    @classmethod
    def at(cls, x: float, y: float, z: float, yaw: float = 0.0) -> Pose:
        """Upright at a place, turned around z by ``yaw`` radians."""
        return cls(np.array([x, y, z], float), turn_z(yaw))

    @classmethod
    def of(cls, position: ArrayLike, rotation: ArrayLike) -> Pose:
        """From three numbers, and nine or three by three."""
        return cls(np.array(position, float).reshape(3), np.array(rotation, float).reshape(3, 3))

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(self.position + self.rotation @ other.position, self.rotation @ other.rotation)

    def inverse(self) -> Pose:
        """The pose that this one is undone by."""
        return Pose(-self.rotation.T @ self.position, self.rotation.T)

    def shifted(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Pose:
        """The same direction elsewhere, in the world's axes."""
        return Pose(self.position + np.array([x, y, z]), self.rotation)

    def ahead(self, distance: float) -> Pose:
        """The same direction farther along its own z axis."""
        return Pose(self.position + distance * self.rotation[:, 2], self.rotation)

    @property
    def quaternion(self) -> Vector:
        """The rotation as a unit quaternion (w, x, y, z)."""
        return quaternion_of(self.rotation)


def turn_z(angle: float) -> Matrix:
    """A turn around z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def turn_y(angle: float) -> Matrix:
    """A turn around y."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def grip_down(fingers: float = 0.0) -> Matrix:
    """A gripper that points down.

    Args:
        fingers: direction of the line on which they close, as an angle around z from x.
    """
    y, z = np.array([np.cos(fingers), np.sin(fingers), 0.0]), np.array([0.0, 0.0, -1.0])
    return np.column_stack([np.cross(y, z), y, z])


def grip_along(forward: ArrayLike, across: ArrayLike) -> Matrix:
    """A gripper that points somewhere.

    Args:
        forward: where it points (3,).
        across: about the line on which its fingers close (3,).
    """
    z = np.array(forward, float)
    z /= np.linalg.norm(z)
    y = np.array(across, float)
    y -= z * (y @ z)
    y /= np.linalg.norm(y)
    return np.column_stack([np.cross(y, z), y, z])


def quaternion_of(rotation: Matrix) -> Vector:
    """A rotation (3, 3) as a unit quaternion (w, x, y, z) with w >= 0."""
    m = rotation
    k = np.array(
        [
            [m[0, 0] + m[1, 1] + m[2, 2], 0.0, 0.0, 0.0],
            [m[2, 1] - m[1, 2], m[0, 0] - m[1, 1] - m[2, 2], 0.0, 0.0],
            [m[0, 2] - m[2, 0], m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], 0.0],
            [m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1]],
        ]
    )
    _, vectors = np.linalg.eigh(k, "L")  # Bar-Itzhack: the eigenvector of the largest eigenvalue
    quaternion: Vector = vectors[:, -1] * (1.0 if vectors[0, -1] >= 0 else -1.0)
    return quaternion


def rotation_of(quaternion: Any) -> Matrix:
    """The rotation (3, 3) of a unit quaternion (w, x, y, z)."""
    w, x, y, z = (float(v) for v in quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
