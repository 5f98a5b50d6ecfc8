"""Learning from readings with errors: expert predicates on recorded executions of burger.

The pictures of runs are read again, with a noise profile, and operators are learned from the
readings as they are and as decoded; exact verification with true labels tells what was learned.
Record runs with ``skillwrapper learn burger``, then: ``python -m benchmarks.robustness RUN...``.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from skillwrapper.domains.discovery import find_domain
from skillwrapper.domains.eyesight import Eyesight
from skillwrapper.domains.package import DomainPackage
from skillwrapper.embedded.misreading import Misreading
from skillwrapper.embedded.noise import NoiseProfile, noise_profile
from skillwrapper.embedded.sight import Sight
from skillwrapper.evaluation.exact.exact_reader import ExactReader
from skillwrapper.evaluation.exact.exact_states import scene_states
from skillwrapper.evaluation.exact.labelled_states import LabelledStates
from skillwrapper.evaluation.exact.state_readers import PictureReader
from skillwrapper.evaluation.exact.verification import Verification, verify
from skillwrapper.learning.learner import make_learner
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.perception.decoded_labelling import DecodedLabeller
from skillwrapper.perception.labelling import Labeller
from skillwrapper.perception.overruling import check_overruling
from skillwrapper.runs.archive import RunArchive
from skillwrapper.symbols import Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.world.observation import Observation


class BlurredReader(ExactReader):
    """Reads pictures as a model with a noise profile does, without prompts and replies."""

    def __init__(self, eyes: Eyesight, profile: NoiseProfile, seed: int) -> None:
        super().__init__(eyes)
        self._misreading = Misreading(profile, seed, self._lexicon.words.look_alikes)

    def _look(self, observation: Observation) -> Sight | None:
        sight = super()._look(observation)
        return sight and self._misreading.of(sight, "")


class Study:
    """Learns from the recorded runs of one domain.

    Args:
        package: the domain; has a scene reader, an expert and states that can be listed.
    """

    def __init__(self, package: DomainPackage) -> None:
        self._eyes = Eyesight.for_packages([package])
        self._truth = ExactReader(self._eyes)
        self._predicates: tuple[Predicate, ...] = package.expert.model.predicates
        reader = PictureReader(self._truth)
        self._states = [LabelledStates(states, reader) for states in scene_states(package)]

    def compare(self, run: Path, noise: str) -> None:
        """Print what is learned of one run, from readings and from decoded readings."""
        archive = RunArchive.open(run)
        recorded = RecordedTransitions(archive.domain())
        for episode in archive.episodes():
            recorded.add(episode)
        seed = archive.settings().seed
        reader = BlurredReader(self._eyes, noise_profile(noise), seed)
        decoded = DecodedLabeller(recorded, reader, lambda: self._predicates)
        where = f"{noise:6s} seed {seed:2d} {len(recorded):4d} executions"
        self._print(f"{where}  raw    ", Labeller(recorded, reader), "faithful")
        self._print(f"{where}  decoded", decoded, "robust")
        found = check_overruling(decoded, self._truth)
        print(
            f"{where}  misread {found.misread}, overruled {found.overruled}, rightly {found.right}",
            flush=True,
        )

    def _print(self, what: str, labeller: Labeller, learner: str) -> None:
        fit = make_learner(LearnerSettings(learner=learner)).learn(labeller.label(self._predicates))
        found = verify(self._states, fit.model)
        least = min(tally.recall or 0.0 for tally in found.by_skill.values())
        print(
            f"{what}  {_figures(found)}  least recall {least:.3f}  {len(fit.operators):3d} "
            f"operators  {len(fit.inconsistencies):3d} inconsistencies",
            flush=True,
        )


def _figures(found: Verification) -> str:
    names = ("P", found.precision), ("R", found.recall), ("E", found.effect_accuracy)
    return "  ".join(f"{name} {value or 0.0:.3f}" for name, value in names)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compare all runs that are given, for all noise profiles."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="+", type=Path, help="folders of recorded runs")
    parser.add_argument("--noise", nargs="+", default=["gpt5", "0.05"])
    given = parser.parse_args(arguments)
    study = Study(find_domain(RunArchive.open(given.runs[0]).settings().domain))
    for noise in given.noise:
        for run in given.runs:
            study.compare(run, noise)


if __name__ == "__main__":
    main()
