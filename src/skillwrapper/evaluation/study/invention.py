"""How often models invent the predicate that was meant, on curated contrastive pairs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skillwrapper.domains.discovery import find_domain
from skillwrapper.evaluation.published import PublishedInvention, published_figures
from skillwrapper.evaluation.study.contrastive_pairs import read_pairs
from skillwrapper.evaluation.study.judge import MeaningJudge
from skillwrapper.evaluation.study.meaning import Meaning
from skillwrapper.evaluation.study.models import StudiedModel, open_studied
from skillwrapper.symbols import Predicate


@dataclass(frozen=True)
class Proposal:
    """What a model proposed in one run for one pair.

    Attributes:
        model: the model.
        pair: name of the pair.
        run: number of the run, from 1.
        predicate: what it proposed; None if nothing usable.
        meaning: what that is to the target.
    """

    model: StudiedModel
    pair: str
    run: int
    predicate: Predicate | None
    meaning: Meaning

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        proposed = self.predicate
        return {
            "model": self.model.label,
            "embedded": self.model.is_embedded,
            "pair": self.pair,
            "run": self.run,
            "predicate": proposed.signature if proposed else None,
            "semantics": proposed.semantics if proposed else None,
            "meaning": str(self.meaning),
            "correct": self.meaning.is_correct,
        }


@dataclass(frozen=True)
class InventionStudy:
    """What a study found.

    Attributes:
        domain: name of the domain.
        states: in how many states meanings were compared.
        targets: the target of every pair, as text, by the pair's name.
        proposals: by model, pair and run.
        published: figures of others to stand beside; None if there are none.
    """

    domain: str
    states: int
    targets: dict[str, str]
    proposals: tuple[Proposal, ...]
    published: PublishedInvention | None = None

    @property
    def models(self) -> tuple[StudiedModel, ...]:
        """The models in the order in which they were given."""
        return tuple(dict.fromkeys(p.model for p in self.proposals))

    @property
    def runs(self) -> int:
        """How often each pair was put to each model."""
        return max((p.run for p in self.proposals), default=0)

    def of(self, model: StudiedModel, pair: str) -> tuple[Proposal, ...]:
        """The proposals of one model for one pair."""
        return tuple(p for p in self.proposals if (p.model, p.pair) == (model, pair))

    def count(self, model: StudiedModel) -> Counter[Meaning]:
        """How often a model's proposals were what."""
        return Counter(p.meaning for p in self.proposals if p.model == model)

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "domain": self.domain,
            "states": self.states,
            "targets": self.targets,
            "correct": {
                m.label: sum(n for meaning, n in self.count(m).items() if meaning.is_correct)
                for m in self.models
            },
            "proposals": [p.to_json() for p in self.proposals],
        }


def study_invention(
    domain: str,
    models: Sequence[StudiedModel],
    *,
    runs: int = 3,
    states: int | None = 400,
    seed: int = 0,
    pairs_file: Path | None = None,
    calls: Path | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> InventionStudy:
    """Put every pair to every model, and decide by truth over states what was proposed.

    Args:
        domain: a reference to a domain.
        models: who proposes.
        runs: how often each is asked.
        states: in how many sampled states meanings are compared; None for all.
        seed: of the sample, and of the embedded model.
        pairs_file: pairs of one's own; the domain's by default.
        calls: a store in which calls are kept and found again; None for none.
        progress: told what is done next.

    Raises:
        UserError: if the domain or the pairs cannot be used.
        ProviderError: if a model does not answer.
    """
    package = find_domain(domain)
    judge = MeaningJudge(package, states, seed)
    path = pairs_file or package.pairs
    pairs = read_pairs(path, judge.environment, judge.expert)
    proposals = []
    for model in models:
        for run in range(runs):
            progress(f"{model.label}: run {run + 1}")
            with open_studied(model, domain, seed=seed, run=run, calls=calls) as assistant:
                answers = [assistant.invent_predicates(pair.question) for pair in pairs]
            for pair, answer in zip(pairs, answers, strict=True):
                proposed = next(iter(answer.predicates), None)
                meaning = judge.judge(proposed, pair.target) if proposed else Meaning.OTHER
                proposals.append(Proposal(model, pair.name, run + 1, proposed, meaning))
    targets = {pair.name: str(pair.target) for pair in pairs}
    published = published_figures(package).invention
    return InventionStudy(domain, len(judge.states), targets, tuple(proposals), published)
