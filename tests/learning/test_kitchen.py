"""The whole loop on the burger kitchen, from no predicate to an exact model."""

from __future__ import annotations

from kitchen import DOMAIN, POOL, STATES, Eye, Thinker, compare, explore

from skillwrapper.domains.burger.system_predicates import SYSTEM_PREDICATES
from skillwrapper.invention.fitter import Fitter
from skillwrapper.invention.inventor import Inventor
from skillwrapper.invention.pruning import prune
from skillwrapper.invention.settings import LearningSettings
from skillwrapper.invention.vocabulary import Vocabulary
from skillwrapper.learning.certification import certify
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions


def learn(seed: int, iterations: int = 10, budget: int = 30) -> Fit:
    """Algorithm 1 with random exploration."""
    recorded = RecordedTransitions(DOMAIN)
    fitter = Fitter(Labeller(recorded, Eye()), FaithfulLearner())
    vocabulary = Vocabulary(DOMAIN.types)
    inventor = Inventor(fitter, vocabulary, Thinker(recorded, seed), LearningSettings())
    for iteration in range(iterations):
        recorded.add(explore(budget, seed * 100 + iteration))
        inventor.invent()
        prune(fitter, vocabulary)
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
    recorded = RecordedTransitions(DOMAIN)
    for number in range(10):
        recorded.add(explore(30, number))
    fit = Fitter(Labeller(recorded, Eye()), FaithfulLearner()).fit(vocabulary)
    assert fit.inconsistencies == ()
    assert certify(fit).violations == ()
    score = compare(fit.model)
    assert (score.precision, score.effects) == (1, 1)


def test_all_states_are_compared() -> None:
    assert len(STATES) == 2417
    assert len(DOMAIN.skill_instances) == 26
