"""The learner as one of AMLGym's algorithms.

AMLGym (extra ``amlgym``) calls an object with a method ``learn``; this one needs nothing of it::

    from skillwrapper.action_models.amlgym import SkillWrapper

    print(SkillWrapper().learn("domain.pddl", ["0_traj", "1_traj"]))
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from skillwrapper.action_models.learner import ActionModelLearner
from skillwrapper.action_models.printing import print_model
from skillwrapper.action_models.reading import read_steps
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton_files import read_skeleton


@dataclass
class SkillWrapper:
    """Action models from AMLGym's domains and trajectories.

    Attributes:
        settings: what models may say.
        failures: whether an action after which the state is the same has failed.
    """

    settings: ActionModelSettings = field(default_factory=ActionModelSettings)
    failures: bool = False

    def learn(self, domain_path: str, trajectory_paths: Iterable[str]) -> str:
        """The learned domain as PDDL.

        Args:
            domain_path: a domain; preconditions and effects in it are not looked at.
            trajectory_paths: the traces.

        Raises:
            UserError: if a file cannot be read or does not fit the domain.
        """
        learner = ActionModelLearner(read_skeleton(Path(domain_path)), self.settings)
        paths = [Path(path) for path in trajectory_paths]
        learner.add(read_steps(paths, learner.skeleton, failures=self.failures))
        return print_model(learner.learn(), self.settings.effects)
