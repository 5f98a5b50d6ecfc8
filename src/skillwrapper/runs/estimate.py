"""What a run will take, estimated before anything is spent."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from skillwrapper.runs.settings import ModelSettings, RunSettings
from skillwrapper.vlm.endpoints import endpoint_address
from skillwrapper.vlm.prices import CallCost, nothing, price_of
from skillwrapper.vlm.protocol import Role

# Measured on a kitchen of 26 skill instances with the embedded model: five runs of 5 x 15 and
# 10 x 30 executions.
_TOKENS: Mapping[Role, tuple[int, int]] = MappingProxyType(
    {
        Role.PROPOSE: (2100, 520),
        Role.INVENT: (2600, 80),
        Role.EVALUATE: (1400, 150),
        Role.SUMMARISE: (470, 100),
    }
)
"""Tokens of prompt with pictures, and of the reply without reasoning, of one call."""
_PICTURES = (1 / 3, 2 / 3)
"""Different pictures for each execution, at the least and at the most."""
_INVENTIONS = (4, 35)
"""Questions for a predicate in a whole run; some runs need few, some many."""
_FIRST_READINGS, _READINGS = 2.0, 0.6
"""Calls that read a picture: so many in any case, and so many for each question."""


@dataclass(frozen=True)
class RoleEstimate:
    """What one role will take; pairs are the least and the most to expect.

    Attributes:
        role: what the calls are for.
        model: which model is asked.
        calls: how often.
        input_tokens: of prompts and pictures.
        output_tokens: of replies, without reasoning.
        cost: in US dollars; None if the price is unknown.
    """

    role: Role
    model: str
    calls: tuple[int, int]
    input_tokens: tuple[int, int]
    output_tokens: tuple[int, int]
    cost: tuple[float, float] | None


@dataclass(frozen=True)
class Estimate:
    """What a run will take.

    Attributes:
        executions: skills that are executed, at most.
        roles: what every role takes.
    """

    executions: int
    roles: tuple[RoleEstimate, ...]

    @property
    def calls(self) -> tuple[int, int]:
        """Of all roles."""
        return _sums(role.calls for role in self.roles)

    @property
    def tokens(self) -> tuple[int, int]:
        """Of all roles, prompts and replies."""
        return _sums(t for r in self.roles for t in (r.input_tokens, r.output_tokens))

    @property
    def cost(self) -> tuple[float, float] | None:
        """Of all roles; None if the price of any is unknown."""
        costs = [role.cost for role in self.roles if role.cost is not None]
        if len(costs) < len(self.roles):
            return None
        return sum(low for low, _ in costs), sum(high for _, high in costs)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        fields = ("calls", "input_tokens", "output_tokens", "cost")
        return {
            "executions": self.executions,
            "calls": self.calls,
            "tokens": self.tokens,
            "cost": self.cost,
            "roles": {
                str(role.role): {"model": role.model, **{f: getattr(role, f) for f in fields}}
                for role in self.roles
            },
        }


def estimate_run(config: RunSettings) -> Estimate:
    """Estimate calls, tokens, cost and executions of a run; asks and executes nothing."""
    executions = config.iterations * config.exploration.budget
    low, high = (
        round(executions * share * (_FIRST_READINGS + _READINGS * questions))
        for share, questions in zip(_PICTURES, _INVENTIONS, strict=True)
    )
    votes = config.model.asking.votes
    readings = (low * votes, high * votes)
    always = config.model.asking.summarise == "always"
    calls = {
        Role.PROPOSE: (config.iterations, config.iterations),
        Role.INVENT: (1, 1) if config.learning.invention == "batch" else _INVENTIONS,
        Role.EVALUATE: readings,
        Role.SUMMARISE: (low * votes if always else 0, high * votes),
    }
    return Estimate(
        executions, tuple(_of_role(config.model, role, pair) for role, pair in calls.items())
    )


def _of_role(settings: ModelSettings, role: Role, calls: tuple[int, int]) -> RoleEstimate:
    model = settings.roles.get(role, settings.name)
    (low, high), (tokens_in, tokens_out) = calls, _TOKENS[role]
    price = _price(model, settings.base_url)
    each = price(tokens_in, tokens_out) if price else None
    return RoleEstimate(
        role,
        model,
        calls,
        (low * tokens_in, high * tokens_in),
        (low * tokens_out, high * tokens_out),
        None if each is None else (low * each, high * each),
    )


def _price(model: str, base_url: str | None) -> CallCost | None:
    """What a model costs; ours and recordings cost nothing, others may be unknown."""
    kind, _, name = model.partition(":")
    return price_of(name, endpoint_address(base_url)) if kind == "openai" else nothing


def _sums(pairs: Iterable[tuple[int, int]]) -> tuple[int, int]:
    known = tuple(pairs)
    return sum(low for low, _ in known), sum(high for _, high in known)
