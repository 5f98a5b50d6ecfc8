"""The paper's hypothesis class and sample size (its appendix on sample complexity), as logarithms.

The class holds all models with at most P predicates of at most arity mu over the domain's objects,
and at most A operators a skill. Its size is so large that the bound says nothing of any run that
could be made; it is computed to be seen.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal, getcontext

_LN3 = Decimal(math.log(3))
_LN10 = Decimal(math.log(10))
_MOST_DIGITS = Decimal(10) ** 15
"""Beyond it even the logarithm of the operators' number cannot be written down."""


@dataclass(frozen=True)
class HypothesisClass:
    """The models among which one is chosen.

    Attributes:
        predicates: at most so many (the paper's P_max).
        arity: of a predicate, at most (mu_max).
        objects: in the scene.
        skills: of the robot.
        operators: of a skill, at most; None for the paper's own bound 3^(P |O|^mu).
    """

    predicates: int
    arity: int
    objects: int
    skills: int
    operators: int | None = None

    @property
    def ground_atoms(self) -> int:
        """The paper's bound on them, P |O|^mu."""
        return int(self.predicates * self.objects**self.arity)

    @property
    def log_size(self) -> Decimal:
        """ln |H| = P A |Omega| |O|^mu ln 3.

        Raises:
            OverflowError: if even that is too large to be written down.
        """
        getcontext().prec = 30
        atoms = Decimal(self.ground_atoms)
        if self.operators is None and atoms > _MOST_DIGITS:
            raise OverflowError("the number of operators cannot be written down")
        operators = Decimal(3) ** atoms if self.operators is None else Decimal(self.operators)
        return atoms * operators * self.skills * _LN3


@dataclass(frozen=True)
class SampleSize:
    """So many transitions suffice for an error of at most epsilon but with probability delta.

    Attributes:
        log10_size: log10 |H|.
        log10_blocks: log10 of m, how many independent blocks are needed.
        log10_lag: log10 of k, after how many transitions one forgets; 0 if they are independent.
    """

    log10_size: Decimal
    log10_blocks: Decimal
    log10_lag: Decimal

    @property
    def log10_transitions(self) -> Decimal:
        """log10 of n = m k."""
        return self.log10_blocks + self.log10_lag


def sample_size(
    hypotheses: HypothesisClass, epsilon: float, delta: float, mixing: float | None = None
) -> SampleSize:
    """The paper's n(epsilon, delta), its failure probability split in half.

    m >= (ln C + ln 2 + ln 1/delta) / epsilon, and k >= (ln C + ln(m - 1) + ln 1/delta + ln 2) / b
    where the mixing coefficients decay as e^(-b k).

    Args:
        hypotheses: the class.
        epsilon: the error, above 0 and below 1.
        delta: the probability of failing, above 0 and below 1.
        mixing: the rate b above 0; None for independent transitions.
    """
    log_size, log_failing = hypotheses.log_size, Decimal(-math.log(delta))
    two = Decimal(math.log(2))
    blocks = (log_size + two + log_failing) / Decimal(epsilon)
    lag = Decimal(1)
    if mixing is not None:
        lag = max(lag, (log_size + blocks.ln() + log_failing + two) / Decimal(mixing))
    return SampleSize(log_size / _LN10, blocks.log10(), lag.log10())
