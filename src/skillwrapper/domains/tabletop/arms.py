"""Arms with their grippers, as they stand on a stage."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.robot_models import load_model
from skillwrapper.domains.tabletop.welds import USUAL, Firmness, add_weld

GRIP: Final = "grip"
"""What the names of everything of a gripper begin with, after the arm's."""
_DRIVE: Final = "drive"
"""The servo of a linkage."""


@dataclass(frozen=True)
class ArmKind:
    """A kind of arm with its gripper.

    Attributes:
        arm: name of its model.
        gripper: name of the gripper's model.
        finger_joints: of the gripper, each with how it moves when the gripper's value grows by one.
        finger_servos: likewise its servos; none for a linkage that one servo of ours drives by its
            first joint.
        opened: value of the fingers when the gripper is open.
        closed: value of the fingers when it is closed.
        stiffness: of each joint of the arm, in newton metres per radian, for physics.
        strength: largest torque of each joint, in newton metres.
        joint: what its joints are called before their number, from 1.
        turn: of the gripper's site around z that brings y across the fingers, in radians.
        scattered: whether inverse kinematics also starts from joints around the rest.
    """

    arm: str
    gripper: str
    finger_joints: Mapping[str, float]
    finger_servos: Mapping[str, float]
    opened: float
    closed: float
    stiffness: tuple[float, ...]
    strength: tuple[float, ...]
    joint: str = "joint"
    turn: float = 0.0
    scattered: bool = False

    @property
    def joints(self) -> int:
        """Number of the arm's own joints."""
        return len(self.stiffness)

    @property
    def servos(self) -> Mapping[str, float]:
        """Of the fingers on the stage, each with how it moves with the gripper's value."""
        return self.finger_servos or {_DRIVE: 1.0}


PANDA: Final = ArmKind(
    arm="panda",
    gripper="panda_gripper",
    finger_joints=MappingProxyType({"finger_joint1": 1.0, "finger_joint2": -1.0}),
    finger_servos=MappingProxyType({"gripper_finger_joint1": 1.0, "gripper_finger_joint2": -1.0}),
    opened=0.04,
    closed=0.0,
    stiffness=(4500, 4500, 3500, 3500, 2000, 2000, 2000),
    strength=(87, 87, 87, 87, 40, 40, 40),
)
IIWA: Final = ArmKind(
    arm="iiwa",
    gripper="robotiq_gripper_140",
    finger_joints=MappingProxyType(
        {
            "finger_joint": 1.0,
            "left_inner_finger_joint": 1.0,
            "left_inner_knuckle_joint": -1.0,
            "right_outer_knuckle_joint": -1.0,
            "right_inner_finger_joint": 1.0,
            "right_inner_knuckle_joint": -1.0,
        }
    ),
    finger_servos=MappingProxyType({}),
    opened=0.0,
    closed=0.7,
    stiffness=(4500, 4500, 3500, 3500, 2000, 2000, 2000),
    strength=(176, 176, 110, 110, 110, 40, 40),
    joint="joint_",
    turn=math.pi / 2,
    scattered=True,
)


def add_arm(
    stage: Any,
    kind: ArmKind,
    name: str,
    position: Sequence[float] = (0.0, 0.0, 0.0),
    quaternion: Sequence[float] = (1.0, 0.0, 0.0, 0.0),
) -> None:
    """Put an arm with its gripper onto a stage.

    Args:
        stage: an MjSpec.
        kind: of arm.
        name: what the names of everything of it begin with, before an underscore.
        position: of its base (3,).
        quaternion: of its base (w, x, y, z).

    Raises:
        MissingDependencyError: if the models are missing; says how to get them.
    """
    arm, gripper = load_model(kind.arm), load_model(kind.gripper)
    for part in (arm, gripper):
        _strip(part)
    if not kind.finger_servos:
        _couple(gripper, kind)
    for motor in list(arm.actuators):
        arm.delete(motor)
    own_joints = [joint for joint in arm.joints if joint.name.startswith("joint")]
    arm.attach(gripper, prefix=f"{GRIP}_", frame=arm.body("right_hand").add_frame())
    for body in arm.bodies:
        body.gravcomp = 1
    for joint, stiffness, strength in zip(own_joints, kind.stiffness, kind.strength, strict=True):
        _add_servo(arm, joint, stiffness, strength)
    frame = stage.worldbody.add_frame(pos=list(position), quat=list(quaternion))
    stage.attach(arm, prefix=f"{name}_", frame=frame)


def weld(stage: Any, arm: str, thing: str, firmness: Firmness = USUAL) -> None:
    """Prepare a grasp for physics: inactive until the arm takes the thing."""
    add_weld(stage, hand_of(arm), thing, firmness)


def hand_of(arm: str) -> str:
    """The body that an arm's fingers are mounted on."""
    return f"{arm}_{GRIP}_right_gripper"


def _strip(part: Any) -> None:
    """Without cameras and sensors that are not ours, and with nothing drawn but the body."""
    for extra in [*part.cameras, *part.sensors]:
        part.delete(extra)
    for site in part.sites:
        site.rgba = [0, 0, 0, 0]


def _couple(gripper: Any, kind: ArmKind) -> None:
    """Let all fingers follow the first one, which a servo drives.

    The tendons of the model do the same at twice the cost, its limits (0.7 degrees for 0.7 radians)
    keep the fingers open, and the parts of a linkage that really overlap must not push each other.
    """
    m = mujoco()
    for part in [*gripper.equalities, *gripper.tendons, *gripper.actuators]:
        gripper.delete(part)
    leader, *followers = kind.finger_joints
    for name, sign in kind.finger_joints.items():
        joint = gripper.joint(name)
        joint.limited, joint.armature, joint.damping = 0, 0.005, [0.3, 0, 0]
        if name in followers:
            added = gripper.add_equality(name=f"{name}_follows", type=m.mjtEq.mjEQ_JOINT)
            added.name1, added.name2 = name, leader
            added.data[:5] = [0, sign, 0, 0, 0]
    servo = gripper.add_actuator(name=_DRIVE, target=leader, trntype=m.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=30, kv=3)
    servo.forcelimited, servo.forcerange = True, [-6, 6]
    for first, second in itertools.combinations([body.name for body in gripper.bodies[1:]], 2):
        gripper.add_exclude(bodyname1=first, bodyname2=second)


def _add_servo(arm: Any, joint: Any, stiffness: float, strength: float) -> None:
    servo = arm.add_actuator(
        name=f"servo_{joint.name}", target=joint.name, trntype=mujoco().mjtTrn.mjTRN_JOINT
    )
    # Damping of stiffness / 15 comes to rest within millimetres; critical damping did not.
    servo.set_to_position(kp=stiffness, kv=stiffness / 15)
    servo.forcelimited, servo.forcerange = True, [-strength, strength]
    servo.ctrllimited, servo.ctrlrange = True, joint.range
    joint.armature = 0.1
