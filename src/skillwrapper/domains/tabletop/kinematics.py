"""The joints of one arm in a compiled model, and its inverse kinematics."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from skillwrapper.domains.tabletop.arms import GRIP, ArmKind
from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.poses import Pose, Vector, turn_z

Joints = NDArray[np.float64]
_TOLERANCE: Final = 5e-4, 5e-3
"""Of place, in metres, and of direction, in radians."""
_STEPS: Final = 150
_DAMPING: Final = 0.05
_OTHERS: Final = 24
_SCATTER: Final = 1.2
"""Starts around the rest, in radians; the way from one start may end at a joint's limit."""
_PULL_TO_REST: Final = 0.05
_LONGEST_STEP: Final = 0.3
_MARGIN: Final = 0.01
"""How far joints stay from their limits, in radians."""


class Arm:
    """One arm.

    Args:
        model: compiled.
        name: as given to ``add_arm``.
        kind: of arm.
        rest: joints that inverse kinematics prefers (joints,).

    Attributes:
        name: of the arm.
        kind: of arm.
        rest: as above.
        site: number of the site between its fingers.
        addresses: of its joints in ``qpos`` (joints,).
        fingers: of the fingers' joints in ``qpos`` (fingers,).
    """

    def __init__(self, model: Any, name: str, kind: ArmKind, rest: ArrayLike) -> None:
        self.name, self.kind = name, kind
        self.rest: Joints = np.array(rest, float)
        self._model, self._data = model, mujoco().MjData(model)
        scattered = np.random.default_rng(0).uniform(-_SCATTER, _SCATTER, (_OTHERS, kind.joints))
        self._others = np.clip(self.rest + scattered, -2.0, 2.0) if kind.scattered else ()
        self._turn = turn_z(kind.turn)
        self.site = model.site(f"{name}_{GRIP}_grip_site").id
        own_joints = [f"{kind.joint}{k}" for k in range(1, kind.joints + 1)]
        numbers = [model.joint(f"{name}_{joint}").id for joint in own_joints]
        self.addresses = np.array([model.jnt_qposadr[n] for n in numbers])
        self.velocities = np.array([model.jnt_dofadr[n] for n in numbers])
        self._low, self._high = (model.jnt_range[numbers] + [_MARGIN, -_MARGIN]).T
        fingers = [f"{name}_{GRIP}_{finger}" for finger in kind.finger_joints]
        self.fingers = np.array([model.jnt_qposadr[model.joint(f).id] for f in fingers])
        self.servos = np.array([model.actuator(f"{name}_servo_{joint}").id for joint in own_joints])

    def finger_values(self, opening: float) -> Vector:
        """Values of the fingers' joints (fingers,) for an opening between closed and opened."""
        return opening * np.array(list(self.kind.finger_joints.values()))

    def grip(self, data: Any) -> Pose:
        """Where the point between the fingers is; z points out of the hand, y across them."""
        seen = Pose.of(data.site_xpos[self.site], data.site_xmat[self.site])
        return Pose(seen.position, seen.rotation @ self._turn)

    def grip_at(self, joints: Joints) -> Pose:
        """Where that point would be with the joints so."""
        self._data.qpos[self.addresses] = joints
        mujoco().mj_kinematics(self._model, self._data)
        return self.grip(self._data)

    def solve(self, target: Pose, *starts: Joints) -> Joints | None:
        """Joints that bring the grip to a pose; None if it cannot be reached.

        Damped least squares, from each start in turn, drawn to ``rest`` where that is free.

        Args:
            target: of the grip.
            *starts: joints to begin with; then come ``rest``, and others around it.
        """
        for start in (*starts, self.rest, *self._others):
            joints = self._solve_from(start, target)
            if joints is not None:
                return joints
        return None

    def _solve_from(self, start: Joints, target: Pose) -> Joints | None:
        m, data = mujoco(), self._data
        jacobian = np.zeros((6, self._model.nv))
        data.qpos[self.addresses] = start
        for _ in range(_STEPS):
            m.mj_kinematics(self._model, data)
            error = self._error(target)
            if (
                np.linalg.norm(error[:3]) < _TOLERANCE[0]
                and np.linalg.norm(error[3:]) < _TOLERANCE[1]
            ):
                found: Joints = data.qpos[self.addresses].copy()
                return found
            m.mj_comPos(self._model, data)
            m.mj_jacSite(self._model, data, jacobian[:3], jacobian[3:], self.site)
            change = self._step(jacobian[:, self.velocities], error)
            moved = data.qpos[self.addresses] + change
            data.qpos[self.addresses] = np.clip(moved, self._low, self._high)
        return None

    def _error(self, target: Pose) -> Vector:
        """What is missing in place and direction (6,)."""
        present = self.grip(self._data)
        turn, quaternion = np.zeros(3), np.zeros(4)
        rotation = target.rotation @ present.rotation.T
        mujoco().mju_mat2Quat(quaternion, rotation.ravel())
        mujoco().mju_quat2Vel(turn, quaternion, 1.0)
        return np.concatenate([target.position - present.position, turn])

    def _step(self, jacobian: NDArray[np.float64], error: Vector) -> Joints:
        size = float(np.linalg.norm(error))
        wanted = error * min(1.0, _LONGEST_STEP / size)
        damped = jacobian @ jacobian.T + _DAMPING**2 * min(1.0, size) * np.eye(6)
        both = np.linalg.solve(damped, np.column_stack([wanted, jacobian]))
        free = np.eye(jacobian.shape[1]) - jacobian.T @ both[:, 1:]
        pull = (
            _PULL_TO_REST
            * min(1.0, 5 * size)
            * free
            @ (self.rest - self._data.qpos[self.addresses])
        )
        step: Joints = jacobian.T @ both[:, 0] + pull
        return step


def between(start: Joints, end: Joints, longest: float) -> Sequence[Joints]:
    """Joints on the way from start to end, the end included, no joint moving more than so far."""
    count = max(1, int(np.ceil(np.abs(end - start).max() / longest)))
    return [start + (end - start) * k / count for k in range(1, count + 1)]
