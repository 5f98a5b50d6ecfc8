"""The faithful learner: takes every label for right, as the paper does."""

from __future__ import annotations

from skillwrapper.learning.determinism import fit_skill
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.transitions.labelled import Content, LabelledTransitions
from skillwrapper.world.domain import Domain
from skillwrapper.world.skills import Skill


class FaithfulLearner:
    """Learns each skill from its own transitions; remembers it by what it was learned from.

    So new transitions relearn only their skills, and a corrected label only the skills that were
    run where it stands, unless it makes a predicate a tautology or no longer one.

    Args:
        settings: what conditions may say, and which labels count.
    """

    def __init__(self, settings: LearnerSettings | None = None) -> None:
        self._settings = settings or LearnerSettings()
        self._domain: Domain | None = None
        self._executions: dict[str, tuple[bytes, ...]] = {}
        self._fits: dict[str, dict[Content, SkillFit]] = {}

    def learn(self, transitions: LabelledTransitions) -> Fit:
        """Operators of all skills; skills without transitions have none."""
        decided = transitions.decided(self._settings.least_confidence)
        useful = decided.with_predicates(decided.varying)
        self._forget_other_than(useful)
        return Fit(
            transitions.domain, transitions.predicates, lambda skill: self._fit(skill, useful)
        )

    def _forget_other_than(self, transitions: LabelledTransitions) -> None:
        """Drop what was learned of other executions: they were superseded by more."""
        if self._domain != transitions.domain:
            self._domain = transitions.domain
            self._executions.clear()
            self._fits.clear()
        for skill in transitions.domain.skill_by_name:
            executions = transitions.executions_of(skill)
            if self._executions.get(skill) != executions:
                self._executions[skill] = executions
                self._fits[skill] = {}

    def _fit(self, skill: Skill, transitions: LabelledTransitions) -> SkillFit:
        content = transitions.content(skill.name)
        known = self._fits.get(skill.name, {})
        if content not in known:
            language = OperatorLanguage(
                transitions.domain, skill, transitions.predicates, self._settings
            )
            known[content] = fit_skill(language, transitions.of_skill(skill.name))
        return known[content]
