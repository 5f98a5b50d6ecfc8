"""Welds: what a hand holds, and what sticks to something until it is taken off.

They are prepared on the stage and do nothing until they are fastened; only forces heed them.
"""

from __future__ import annotations

from typing import Any

from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.poses import Pose


def add_weld(stage: Any, base: str, thing: str, *, gives: bool = False) -> None:
    """Prepare a weld between two bodies of a stage.

    Args:
        stage: where.
        base: what is held to.
        thing: what is held.
        gives: whether it yields some millimetres when pushed, as what only stands in something.
    """
    m = mujoco()
    added = stage.add_equality(
        name=_name(base, thing), type=m.mjtEq.mjEQ_WELD, objtype=m.mjtObj.mjOBJ_BODY
    )
    added.name1, added.name2, added.active = base, thing, False
    if gives:
        added.solref, added.solimp = [0.2, 1.0], [0.3, 0.9, 0.02, 0.5, 2.0]
    else:  # the usual softness lets a knife sink onto what it shall stroke
        added.solref, added.solimp = [0.004, 1.0], [0.99, 0.999, 0.001, 0.5, 2.0]


def fasten(model: Any, data: Any, base: str, thing: str) -> None:
    """Hold a thing where its base sees it now; poses must follow from joints already."""
    seen = _pose(data, base).inverse() @ _pose(data, thing)
    number = model.equality(_name(base, thing)).id
    # The layout of ``eq_data`` for welds: anchor, position, quaternion, torque scale.
    model.eq_data[number, :] = 0
    model.eq_data[number, 3:6] = seen.position
    model.eq_data[number, 6:10] = seen.quaternion
    model.eq_data[number, 10] = 1
    data.eq_active[number] = 1


def loosen(model: Any, data: Any, base: str, thing: str) -> None:
    """Undo ``fasten``."""
    data.eq_active[model.equality(_name(base, thing)).id] = 0


def _name(base: str, thing: str) -> str:
    return f"{thing} on {base}"


def _pose(data: Any, body: str) -> Pose:
    found = data.body(body)
    return Pose.of(found.xpos, found.xmat)
