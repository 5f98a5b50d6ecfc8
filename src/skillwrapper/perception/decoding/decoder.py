"""Decoding: from readings of pictures along chains to what is likely true in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from skillwrapper.grounding import Labels
from skillwrapper.perception.decoding.cells import Cells, ChainCells
from skillwrapper.perception.decoding.chains import Chain
from skillwrapper.perception.decoding.conditions import Conditions
from skillwrapper.perception.decoding.estimation import Estimation, Problem
from skillwrapper.perception.decoding.odds import Floats, to_probability
from skillwrapper.perception.decoding.priors import Priors
from skillwrapper.perception.decoding.readings import ErrorRates
from skillwrapper.perception.decoding.rules import Readiness
from skillwrapper.symbols import Predicate


@dataclass(frozen=True, eq=False)
class Decoding:
    """What is believed after decoding, chain by chain.

    Attributes:
        predicates: the vocabulary.
        posterior: for every chain and predicate the probability (nodes, groundings) that an atom
            is true.
        dirt: for every chain the log-odds (nodes,) that something in a picture is misread.
        rates: how often each predicate is misread.
        nats: what it takes to describe the readings of each predicate, with its rules.
        exception: how often a rule is broken.
    """

    predicates: tuple[Predicate, ...]
    posterior: tuple[Mapping[Predicate, Floats], ...]
    dirt: tuple[Floats, ...]
    rates: Mapping[Predicate, ErrorRates]
    nats: Mapping[Predicate, float]
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
    problem = _problem(chains, predicates, labels, priors or Priors(), given)
    if not problem.cells.variables:
        return _result(problem, Estimation(problem))
    bold, shy = (Estimation(problem) for _ in range(2))
    bold.climb(Readiness.BOLD)
    shy.climb(Readiness.SHY)
    return _result(problem, _better(problem, bold, shy))


def _problem(
    chains: Sequence[Chain],
    predicates: Sequence[Predicate],
    labels: Sequence[Labels],
    priors: Priors,
    given: Decoding | None,
) -> Problem:
    cells = Cells(chains, predicates)
    known = [given.beliefs(number) for number in range(len(chains))] if given is not None else []
    return Problem(
        cells=cells,
        read=np.concatenate([np.zeros(0, dtype=np.int8), *(x.ravel() for x in labels)]),
        dirt=np.concatenate(given.dirt) if given is not None and given.dirt else None,
        conditions=Conditions(cells, given.predicates if given is not None else ()),
        context=np.concatenate([np.zeros(0), *(k.ravel() for k in known)]),
        changed=_changes(cells, known),
        priors=priors,
    )


def _changes(cells: Cells, known: Sequence[Floats]) -> Floats | None:
    """For every edge the number of changes in what is decoded already; None if nothing is."""
    if not known:
        return None
    found = [np.zeros(0)]
    for part, posterior in zip(cells.parts, known, strict=True):
        chain = part.chain
        one, other = posterior[chain.before[chain.moves]], posterior[chain.after[chain.moves]]
        found.append((np.abs(one - other) > 0.5).sum(axis=1).astype(float))
    return np.concatenate(found)


def _better(problem: Problem, bold: Estimation, shy: Estimation) -> Estimation:
    """What describes the readings in fewer nats, predicate by predicate.

    Estimation climbs to the next hill. Two starts differ in how readily a skill is taken to change
    its arguments: from the one, a predicate that is often misread seems to flicker; from the other,
    one that seldom changes seems constant.
    """
    predicate, number = problem.cells.predicate, len(problem.cells.predicates)
    differs = np.bincount(predicate[(shy.belief > 0.5) != (bold.belief > 0.5)], minlength=number)
    prefers_shy = (differs > 0) & (shy.description() < bold.description())
    if not prefers_shy.any():
        return bold
    merged = Estimation(problem)
    taken = prefers_shy[predicate]
    merged.climb_from(np.where(taken, shy.belief, bold.belief))
    return merged


def _result(problem: Problem, found: Estimation) -> Decoding:
    cells, predicates = problem.cells, problem.cells.predicates
    nodes = np.cumsum([part.chain.nodes for part in cells.parts])[:-1]
    nats = found.description().tolist()
    return Decoding(
        predicates,
        tuple(dict(_by_predicate(part, found.belief)) for part in cells.parts),
        tuple(np.split(found.readings.dirt, nodes)),
        dict(zip(predicates, found.readings.rates(), strict=True)),
        dict(zip(predicates, nats, strict=True)),
        found.rules.exception,
    )


def _by_predicate(part: ChainCells, belief: Floats) -> Iterator[tuple[Predicate, Floats]]:
    """The beliefs (nodes, groundings) of every predicate of one chain."""
    table = belief[part.variables].reshape(part.chain.nodes, len(part.space.atoms))
    first = 0
    for predicate in part.space.predicates:
        last = first + len(part.space.atoms_of[predicate.name])
        yield predicate, table[:, first:last]
        first = last
