"""What successes tell: what a skill needs, and what it must change."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillwrapper.perception.decoding.cells import Cells
from skillwrapper.perception.decoding.chains import StepKind
from skillwrapper.perception.decoding.messages import Joint
from skillwrapper.perception.decoding.odds import Floats
from skillwrapper.perception.decoding.priors import Priors


def needed(cells: Cells, belief: Floats, base: Floats, priors: Priors) -> Floats:
    """Log-odds (variables,) from what nearly always holds before the successes of a skill.

    Only atoms over a skill's arguments count. Several of them may say the same, so none counts for
    more than one reading, and of several skills that succeeded in a picture only the one that
    says most.

    Args:
        cells: the cells.
        belief: the probability (variables,) that an atom is true.
        base: for every predicate the share of its atoms that is true.
        priors: what is taken for likely beforehand.
    """
    variables, roles = cells.ran
    number = len(cells.roles)
    held = np.bincount(roles, belief[variables], number)
    seen = np.bincount(roles, minlength=number)
    share = (held + 0.5) / (seen + 1)
    usual = np.array([base[role.predicate] for role in cells.roles])
    usual = np.clip(usual, priors.misread, 1 - priors.misread)
    odds = np.log(share / (1 - share)) - np.log(usual / (1 - usual))
    odds = np.clip(odds, -priors.reading_odds, priors.reading_odds)
    odds[(share < priors.sure) & (share > 1 - priors.sure)] = 0.0
    found = np.zeros(cells.variables)
    order = np.argsort(np.abs(odds[roles]), kind="stable")
    found[variables[order]] = odds[roles[order]]  # the strongest comes last
    return found


def idle_roles(cells: Cells, joint: Joint, changed: Floats | None) -> NDArray[np.bool_]:
    """Whether a role (roles,) is of a skill that, by all other predicates, rarely does anything.

    A skill that succeeds is there to change something; if nothing else changes, this does.

    Args:
        cells: the cells.
        joint: what is believed of them.
        changed: for every edge (edges,) the number of changes in what is decoded already; None if
            nothing is.
    """
    predicates = len(cells.predicates)
    names = sorted({role.skill for role in cells.roles})
    skill = np.array([names.index(role.skill) for role in cells.roles], dtype=np.intp)
    own = np.array([role.predicate for role in cells.roles], dtype=np.intp)
    which = cells.edge * predicates + own[cells.role]
    size = cells.edges * predicates
    change = np.minimum(np.bincount(which, joint.change, size), 1.0).reshape(
        cells.edges, predicates
    )
    of_edge = np.zeros(cells.edges, dtype=np.intp)
    of_edge[cells.edge] = skill[cells.role]
    runs = np.bincount(of_edge, minlength=len(names))
    by_skill = np.stack(
        [np.bincount(of_edge, change[:, p], len(names)) for p in range(predicates)], axis=1
    )
    total = by_skill.sum(axis=1)
    if changed is not None:
        total += np.bincount(of_edge, np.minimum(changed, 1.0), len(names))
    rest = total[skill] - by_skill[skill, own]
    speaks = np.array(
        [role.kind is StepKind.SUCCESS and role.others == 0 for role in cells.roles], dtype=bool
    )
    idle: NDArray[np.bool_] = speaks & (rest < 0.5 * runs[skill])
    return idle
