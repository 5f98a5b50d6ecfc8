from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillwrapper.domains.tabletop.cameras import Camera
from skillwrapper.domains.tabletop.poses import Pose, grip_down, quaternion_of, rotation_of

CAMERA = Camera((1.3, 0.1, 0.8), (0.4, 0.0, 0.1), 42.0)
numbers = st.floats(-1, 1)


@st.composite
def poses(draw: st.DrawFn) -> Pose:
    quaternion = np.array([draw(st.floats(0.1, 1)), *(draw(numbers) for _ in range(3))])
    rotation = rotation_of(quaternion / np.linalg.norm(quaternion))
    return Pose(np.array([draw(numbers) for _ in range(3)]), rotation)


@given(poses(), poses())
def test_poses_are_undone_by_their_inverse(first: Pose, second: Pose) -> None:
    back = first.inverse() @ (first @ second)
    assert np.allclose(back.position, second.position)
    assert np.allclose(back.rotation, second.rotation)


@given(poses())
def test_quaternions_mean_their_rotation(pose: Pose) -> None:
    assert np.allclose(rotation_of(quaternion_of(pose.rotation)), pose.rotation)


@given(st.floats(-3, 3))
def test_a_gripper_down_is_a_rotation_that_closes_where_it_shall(angle: float) -> None:
    rotation = grip_down(angle)
    assert np.linalg.det(rotation) == pytest.approx(1)
    assert rotation[:, 2] @ [0, 0, -1] == pytest.approx(1)
    closing = np.array([np.cos(angle), np.sin(angle), 0])
    assert abs(rotation[:, 1] @ closing) == pytest.approx(1)


def test_the_target_is_in_the_middle() -> None:
    column, row = CAMERA.project(CAMERA.target, 640, 480)
    assert (float(column), float(row)) == pytest.approx((320, 240))


@given(st.floats(0.2, 0.8), st.floats(-0.4, 0.4), st.floats(0, 0.2))
def test_a_pixel_leads_back_to_its_point(x: float, y: float, z: float) -> None:
    column, row = CAMERA.project((x, y, z), 640, 480)
    assert CAMERA.on_plane(float(column), float(row), 640, 480, z) == pytest.approx((x, y))
