"""Learning action models from traces."""

from __future__ import annotations

from collections.abc import Iterable

from skillwrapper.action_models.background import Background, background_of
from skillwrapper.action_models.effects import count_unexplained, find_effects
from skillwrapper.action_models.models import ActionModel, DomainModel
from skillwrapper.action_models.preconditions import find_preconditions
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.steps import Step
from skillwrapper.action_models.views import ActionViews, ViewTable
from skillwrapper.action_models.witnesses import SeenStates


class ActionModelLearner:
    """Learns while steps are added; what it keeps does not grow with their number.

    Args:
        skeleton: the domain.
        settings: what preconditions may say.
    """

    def __init__(
        self, skeleton: DomainSkeleton, settings: ActionModelSettings | None = None
    ) -> None:
        self.skeleton = skeleton
        self.settings = settings or ActionModelSettings()
        self._seen = SeenStates(skeleton, self.settings.witness_states)
        self._views = {
            name: ActionViews(skeleton, action) for name, action in skeleton.actions.items()
        }

    def add(self, steps: Iterable[Step]) -> None:
        """Take steps in; each must fit the domain (``steps.check_step``)."""
        for step in steps:
            self._seen.add(step)
            self._views[step.action].add(step)

    def learn(self) -> DomainModel:
        """The model of all steps so far."""
        tables = {name: views.table() for name, views in self._views.items()}
        background = background_of(self._views, tables, self._seen.look())
        models = {n: self._learn(views, tables[n], background) for n, views in self._views.items()}
        known = {name: model for name, model in models.items() if model is not None}
        return DomainModel(self.skeleton, known)

    def _learn(
        self, views: ActionViews, table: ViewTable, background: Background
    ) -> ActionModel | None:
        """The model of an action; None if it was never seen to work."""
        if not table.success.any():
            return None
        found = find_preconditions(views, table, background, self.settings)
        effects = find_effects(table, views.atoms)
        unexplained = count_unexplained(table, views.atoms, effects)
        return ActionModel(
            views.action,
            found.needed,
            effects,
            found.refuted,
            views.steps,
            views.unexplained + found.unexplained + unexplained,
        )


def learn_action_models(
    skeleton: DomainSkeleton,
    steps: Iterable[Step],
    settings: ActionModelSettings | None = None,
) -> DomainModel:
    """Action models from steps in any order.

    Args:
        skeleton: the domain.
        steps: the steps of all traces.
        settings: what preconditions may say.
    """
    learner = ActionModelLearner(skeleton, settings)
    learner.add(steps)
    return learner.learn()
