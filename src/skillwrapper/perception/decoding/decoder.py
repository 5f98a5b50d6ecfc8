"""Decoding readings: expectation and maximisation over rules, error rates and hidden states."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skillwrapper.grounding import Labels
from skillwrapper.perception.decoding.cells import Cells, ChainCells
from skillwrapper.perception.decoding.chains import Chain
from skillwrapper.perception.decoding.conditions import Conditions
from skillwrapper.perception.decoding.messages import Joint, Messages, Transitions
from skillwrapper.perception.decoding.odds import Floats, to_log_odds, to_probability
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.decoding.readings import ErrorRates, Readings
from skillwrapper.perception.decoding.rules import Rules
from skillwrapper.perception.decoding.successes import idle_roles, needed
from skillwrapper.symbols import Predicate

_STILL = 0.01
"""Rounds that change no belief by more have settled."""


@dataclass(frozen=True, eq=False)
class Decoding:
    """What is believed after decoding, chain by chain.

    Attributes:
        predicates: the vocabulary.
        posterior: for every chain and predicate the probability (nodes, groundings) that an atom
            is true.
        dirt: for every chain the log-odds (nodes,) that something in a picture is misread.
        rates: how often each predicate is misread.
        misfit: how little the readings of each predicate fit what is believed, in nats.
        exception: how often a rule is broken.
    """

    predicates: tuple[Predicate, ...]
    posterior: tuple[Mapping[Predicate, Floats], ...]
    dirt: tuple[Floats, ...]
    rates: Mapping[Predicate, ErrorRates]
    misfit: Mapping[Predicate, float]
    exception: float

    @property
    def misread(self) -> float | None:
        """The expected share of readings that are wrong; None if there are no readings."""
        rates = self.rates.values()
        wrong = sum(r.false_positive * r.negatives + r.false_negative * r.positives for r in rates)
        seen = sum(r.negatives + r.positives for r in rates)
        return wrong / seen if seen else None

    @property
    def dirty(self) -> float:
        """The expected share of pictures in which something is misread; 0 if there are none."""
        odds = np.concatenate([np.zeros(0), *self.dirt])
        return float(to_probability(odds).mean()) if len(odds) else 0.0

    def without(self, names: Collection[str]) -> Decoding:
        """The same without the predicates of some names."""
        kept = tuple(p for p in self.predicates if p.name not in names)
        return self if kept == self.predicates else replace(self, predicates=kept)

    def beliefs(self, chain: int) -> Floats:
        """The probability (nodes, atoms) that each atom of a chain is true."""
        columns = [self.posterior[chain][p] for p in self.predicates]
        return np.hstack(columns) if columns else np.zeros((len(self.dirt[chain]), 0))


@dataclass
class _State:
    """What is believed between two rounds."""

    belief: Floats
    joint: Joint
    needed: Floats


def decode(
    chains: Sequence[Chain],
    predicates: Sequence[Predicate],
    labels: Sequence[Labels],
    priors: Priors | None = None,
    given: Decoding | None = None,
) -> Decoding:
    """The likeliest states behind readings.

    Args:
        chains: which pictures follow each other.
        predicates: the vocabulary; no two of one name.
        labels: for every chain what was read (nodes, atoms).
        priors: what is taken for likely beforehand.
        given: what is decoded already, of other predicates over the same chains; it is taken as
            it is.
    """
    return _Decoder(chains, predicates, labels, priors or Priors(), given).run()


class _Decoder:
    def __init__(
        self,
        chains: Sequence[Chain],
        predicates: Sequence[Predicate],
        labels: Sequence[Labels],
        priors: Priors,
        given: Decoding | None,
    ) -> None:
        self._cells, self._priors = Cells(chains, predicates), priors
        read = np.concatenate([np.zeros(0, dtype=np.int8), *(x.ravel() for x in labels)])
        dirt = np.concatenate(given.dirt) if given is not None and given.dirt else None
        self._readings = Readings(self._cells, read, priors, dirt)
        context = given.predicates if given is not None else ()
        self._conditions = Conditions(self._cells, context)
        self._rules = Rules(self._cells, self._conditions, priors)
        self._known = [given.beliefs(n) for n in range(len(chains))] if given is not None else []
        self._context: Floats = np.concatenate([np.zeros(0), *(k.ravel() for k in self._known)])
        self._messages = Messages(self._cells, to_log_odds(self._context))
        self._changed = self._context_changes()

    def run(self) -> Decoding:
        state = self._first_state()
        if not self._cells.variables:
            return self._result(state)
        self._rules.learn_rates(state.joint)
        for phase in (self._learn_rates, self._learn_sure_rules, self._learn_rules):
            for _ in range(self._priors.rounds):
                last = state.belief
                self._believe(state)
                phase(state)
                if np.abs(state.belief - last).max(initial=0.0) < _STILL:
                    break
        self._believe(state)
        return self._result(state)

    def _first_state(self) -> _State:
        belief, cells = self._readings.first_belief, self._cells
        before, after = belief[cells.before], belief[cells.after]
        x, y = np.stack([1 - before, before], axis=1), np.stack([1 - after, after], axis=1)
        return _State(belief, Joint(x[:, :, None] * y[:, None, :]), np.zeros(len(belief)))

    def _believe(self, state: _State) -> None:
        evidence = self._readings.evidence(state.belief)
        evidence += self._readings.starting() + state.needed
        transitions: Transitions = self._rules.transitions()
        state.belief, state.joint = self._messages.settle(
            evidence, transitions, self._priors.sweeps
        )

    def _learn_rates(self, state: _State) -> None:
        self._rules.learn_rates(state.joint)

    def _learn_sure_rules(self, state: _State) -> None:
        self._choose_rules(state, free=False)

    def _learn_rules(self, state: _State) -> None:
        self._choose_rules(state, free=True)

    def _choose_rules(self, state: _State, *, free: bool) -> None:
        self._readings.learn(state.belief)
        idle = idle_roles(self._cells, state.joint, self._changed)
        belief = np.concatenate([state.belief, self._context])
        self._rules.learn(state.joint, belief, idle, self._readings.misread, free=free)
        state.needed = needed(self._cells, state.belief, self._readings.base, self._priors)

    def _context_changes(self) -> tuple[Floats, ...]:
        """For every edge the expected number of changes in what is decoded already."""
        if not self._known:
            return ()
        found = [np.zeros(0)]
        for part, posterior in zip(self._cells.parts, self._known, strict=True):
            chain = part.chain
            one = posterior[chain.before[chain.moves]]
            other = posterior[chain.after[chain.moves]]
            found.append((np.abs(one - other) > 0.5).sum(axis=1).astype(float))
        return (np.concatenate(found),)

    def _result(self, state: _State) -> Decoding:
        cells, predicates = self._cells, self._cells.predicates
        nodes = np.cumsum([part.chain.nodes for part in cells.parts])[:-1]
        misfit = self._readings.misfit(state.belief).tolist()
        return Decoding(
            predicates,
            tuple(dict(_by_predicate(part, state.belief)) for part in cells.parts),
            tuple(np.split(self._readings.dirt, nodes)),
            dict(zip(predicates, self._readings.rates(), strict=True)),
            dict(zip(predicates, misfit, strict=True)),
            self._rules.exception,
        )


def _by_predicate(part: ChainCells, belief: Floats) -> Iterator[tuple[Predicate, Floats]]:
    """The beliefs (nodes, groundings) of every predicate of one chain."""
    table = belief[part.variables].reshape(part.chain.nodes, len(part.space.atoms))
    first = 0
    for predicate in part.space.predicates:
        last = first + len(part.space.atoms_of[predicate.name])
        yield predicate, table[:, first:last]
        first = last
