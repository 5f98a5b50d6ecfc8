"""Learning action models from traces."""

from __future__ import annotations

from collections.abc import Iterable

from skillwrapper.action_models.background import Background, background_of
from skillwrapper.action_models.effects import count_unexplained, find_effects
from skillwrapper.action_models.models import ActionModel, DomainModel
from skillwrapper.action_models.partial_traces import Evidence, PartialTrace
from skillwrapper.action_models.preconditions import find_preconditions
from skillwrapper.action_models.settings import ActionModelSettings
from skillwrapper.action_models.skeleton import DomainSkeleton
from skillwrapper.action_models.timelines import Filled, fill
from skillwrapper.action_models.views import ActionViews, ViewTable, some
from skillwrapper.action_models.witnesses import SeenStates


class ActionModelLearner:
    """Learns while steps are added; what it keeps does not grow with their number.

    Traces of which some states are unknown are kept, and so is all that is said of them.

    Args:
        skeleton: the domain.
        settings: what preconditions may say.
    """

    def __init__(
        self, skeleton: DomainSkeleton, settings: ActionModelSettings | None = None
    ) -> None:
        self.skeleton = skeleton
        self.settings = settings or ActionModelSettings()
        self._partial: list[PartialTrace] = []
        self._seen = SeenStates(skeleton, self.settings.witness_states)
        self._views = {
            name: ActionViews(skeleton, action) for name, action in skeleton.actions.items()
        }

    def add(self, evidence: Iterable[Evidence]) -> None:
        """Take steps in; each must fit the domain (``steps.check_attempt``)."""
        for item in evidence:
            if isinstance(item, PartialTrace):
                self._partial.append(item)
                continue
            self._seen.add(item)
            self._views[item.action].add(item)

    def learn(self) -> DomainModel:
        """The model of all steps so far."""
        tables = {name: views.table() for name, views in self._views.items()}
        filled = fill(self._partial, self._views, tables)
        for name, more in filled.views.items():
            tables[name] = self._views[name].table(more)
        background = background_of(self._views, tables, self._seen.look())
        models = {n: self._learn(n, tables[n], background, filled) for n in self._views}
        known = {name: model for name, model in models.items() if model is not None}
        return DomainModel(self.skeleton, known)

    def _learn(
        self, name: str, table: ViewTable, background: Background, filled: Filled
    ) -> ActionModel | None:
        """The model of an action; None if it was never seen to work."""
        views = self._views[name]
        if not table.success.any():
            return None
        found = find_preconditions(views, table, background, self.settings)
        effects = find_effects(table, views.atoms)
        unexplained = count_unexplained(table, views.atoms, effects)
        done = table.success
        lost = some((table.alone & ~table.after & ~table.false_after)[done])
        known = some((table.before | table.false_before)[done]).tolist()
        return ActionModel(
            views.action,
            found.needed,
            effects,
            found.refuted,
            views.steps + len(filled.views.get(name, ())),
            views.unexplained + found.unexplained + unexplained,
            tuple(sorted(views.atoms[n] for n in filled.undecided.get(name, ()) if lost[n])),
            tuple(sorted(a for a, own in zip(views.atoms, known, strict=True) if not own)),
        )


def learn_action_models(
    skeleton: DomainSkeleton,
    steps: Iterable[Evidence],
    settings: ActionModelSettings | None = None,
) -> DomainModel:
    """Action models from steps in any order.

    Args:
        skeleton: the domain.
        steps: the steps of all traces; and traces of which not every state is known.
        settings: what preconditions may say.
    """
    learner = ActionModelLearner(skeleton, settings)
    learner.add(steps)
    return learner.learn()
