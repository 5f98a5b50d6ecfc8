"""Welds: what a hand holds, and what sticks to something until it is taken off.

They are prepared on the stage and do nothing until they are fastened; only forces heed them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

from skillwrapper.domains.tabletop.extra import mujoco
from skillwrapper.domains.tabletop.poses import Pose


@dataclass(frozen=True)
class Firmness:
    """How much a weld yields, as MuJoCo has it.

    Attributes:
        solref: in how many seconds it pulls back, and how damped.
        solimp: how much of what pulls at it is withstood.
    """

    solref: tuple[float, float]
    solimp: tuple[float, float, float, float, float]


USUAL: Final = Firmness((0.02, 1.0), (0.9, 0.95, 0.001, 0.5, 2.0))
"""For what strong fingers press a part of themselves into; held firmly, it would spring away."""
FIRM: Final = Firmness((0.004, 1.0), (0.99, 0.999, 0.001, 0.5, 2.0))
"""For what is long: held as usual, a knife dips into what it shall stroke."""
LOOSE: Final = Firmness((0.2, 1.0), (0.3, 0.9, 0.02, 0.5, 2.0))
"""For what only stands in something: it yields some millimetres when it is pushed."""


def add_weld(stage: Any, base: str, thing: str, firmness: Firmness = USUAL) -> None:
    """Prepare a weld between two bodies of a stage."""
    m = mujoco()
    added = stage.add_equality(
        name=_name(base, thing), type=m.mjtEq.mjEQ_WELD, objtype=m.mjtObj.mjOBJ_BODY
    )
    added.name1, added.name2, added.active = base, thing, False
    added.solref, added.solimp = list(firmness.solref), list(firmness.solimp)


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
