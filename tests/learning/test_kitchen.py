"""The whole loop on the burger kitchen, from no predicate to an exact model."""

from __future__ import annotations

from kitchen import DOMAIN, POOL, STATES, Eye, Thinker, compare, explore

from skillwrapper.domains.burger.system_predicates import SYSTEM_PREDICATES
from skillwrapper.invention.inventor import Inventor
from skillwrapper.invention.pruning import prune
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.certification import certify
from skillwrapper.learning.fitting import Fit, Fitter
from skillwrapper.learning.settings import LearningSettings
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.dataset import Dataset


def learn(seed: int, iterations: int = 10, budget: int = 30) -> Fit:
    """Algorithm 1 with random exploration."""
    dataset = Dataset(DOMAIN)
    fitter = Fitter(DOMAIN, dataset, Eye())
    vocabulary = Vocabulary(DOMAIN.types)
    inventor = Inventor(fitter, vocabulary, Thinker(dataset, seed), LearningSettings())
    for iteration in range(iterations):
        dataset.add(explore(budget, seed * 100 + iteration))
        inventor.invent()
        prune(fitter, vocabulary)
        fitter.forget()
    return fitter.fit(vocabulary.active)


def test_from_an_empty_vocabulary_to_an_exact_model() -> None:
    """With this seed every skill succeeds and fails in all the ways that matter."""
    fit = learn(seed=2)
    assert fit.inconsistencies == ()
    assert certify(fit).violations == ()
    score = compare(fit.model)
    assert (score.precision, score.recall, score.effects) == (1, 1, 1)
    assert score.recall_by_skill == {s.name: 1 for s in DOMAIN.skills}
    assert {p.name for p in fit.predicates} <= {c.predicate.name for c in POOL if c.weight > 1}


def test_expert_vocabulary_needs_no_invention() -> None:
    """The relation that the simulator's own predicates lack is added: nothing lies on it."""
    words = {c.predicate.name: c.predicate for c in POOL}
    vocabulary = [words[p.name] for p in (*SYSTEM_PREDICATES, Predicate("nothing_on", ()))]
    dataset = Dataset(DOMAIN)
    for number in range(10):
        dataset.add(explore(30, number))
    fit = Fitter(DOMAIN, dataset, Eye()).fit(vocabulary)
    assert fit.inconsistencies == ()
    assert certify(fit).violations == ()
    score = compare(fit.model)
    assert (score.precision, score.effects) == (1, 1)


def test_all_states_are_compared() -> None:
    assert len(STATES) == 2417
    assert len(DOMAIN.skill_instances) == 26
