"""Transitions written down as text, for minimal examples.

A state is text such as ``"holding(robot, apple) ?wet(apple)"``: what is listed is true, after a
question mark unknown, and everything else false. ``#2`` at the end makes another picture of the
same state.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from skillwrapper.grounding import FALSE, TRUE, UNKNOWN, AtomSpace, Labels
from skillwrapper.invention.fitter import Fitter
from skillwrapper.learning.determinism import fit_skill
from skillwrapper.learning.faithful import FaithfulLearner
from skillwrapper.learning.fitting import Fit, SkillFit
from skillwrapper.learning.language import OperatorLanguage
from skillwrapper.learning.settings import LearnerSettings
from skillwrapper.perception.labelling import Labeller
from skillwrapper.symbols import Atom, Predicate
from skillwrapper.transitions.recorded import RecordedTransitions
from skillwrapper.transitions.tables import SkillData
from skillwrapper.world import (
    Domain,
    Episode,
    Object,
    Observation,
    Parameter,
    Picture,
    Scene,
    Skill,
    SkillInstance,
    Transition,
    TypeHierarchy,
)

_ATOM = re.compile(r"(\??)([\w-]+)\(([^)]*)\)")


def make_domain(
    types: Mapping[str, tuple[str, ...]],
    objects: Mapping[str, str],
    skills: Mapping[str, str],
    *,
    failures_change_nothing: bool = False,
    resets_restore_state: bool = False,
) -> Domain:
    """A domain from ``{"apple": "food hot"}`` and ``{"Pick": "robot item"}``."""
    hierarchy = TypeHierarchy(types)
    return Domain(
        name="notebook",
        agent="A robot.",
        description="A scene.",
        types=hierarchy,
        objects=tuple(
            Object(name, tuple(sorted(hierarchy.closure(own.split()))))
            for name, own in objects.items()
        ),
        skills=tuple(
            Skill(name, tuple(Parameter(f"{t}_{n}", t) for n, t in enumerate(own.split())))
            for name, own in skills.items()
        ),
        failures_change_nothing=failures_change_nothing,
        resets_restore_state=resets_restore_state,
    )


def atom(text: str) -> Atom:
    match = _ATOM.fullmatch(text)
    assert match, text
    return Atom(match[2], tuple(t.strip() for t in match[3].split(",") if t.strip()))


def instance(text: str) -> SkillInstance:
    found = atom(text)
    return SkillInstance(found.predicate, found.terms)


def picture(state: str) -> Observation:
    return Observation((Picture(state.encode()),))


class Notebook:
    """Recorded transitions and the truth about its pictures (``TruthSource``).

    Attributes:
        asked: for every call of ``labels`` the names of the predicates and how many pictures.
        fetched: the same for what was announced to be needed.
        waves: for every such announcement the names of all predicates in it.
    """

    def __init__(self, domain: Domain, *predicates: Predicate) -> None:
        self.domain = domain
        self.predicates = predicates
        self.recorded = RecordedTransitions(domain)
        self.asked: list[tuple[str, int]] = []
        self.fetched: list[tuple[str, int]] = []
        self.waves: list[str] = []

    def success(self, before: str, skill: str, after: str, *, changed: bool | None = None) -> None:
        self.episode((before, skill, True, after), changed=changed)

    def failure(self, before: str, skill: str, after: str | None = None) -> None:
        self.episode((before, skill, False, before if after is None else after))

    def episode(
        self,
        *steps: tuple[str, str, bool, str],
        scene: Iterable[str] = (),
        changed: bool | None = None,
    ) -> None:
        """Add an episode of (before, skill instance, success, after)."""
        names = tuple(scene)
        present = Scene.of(" ".join(names), names, self.domain.objects)
        transitions = tuple(
            Transition(picture(before), instance(skill), success, picture(after), changed)
            for before, skill, success, after in steps
        )
        self.recorded.add(Episode(present if names else self.domain.scene(), 0, transitions))

    def prefetch(self, wanted: Iterable[tuple[AtomSpace, Sequence[Observation]]]) -> None:
        first = len(self.fetched)
        for space, observations in wanted:
            self.fetched.append((" ".join(p.name for p in space.predicates), len(observations)))
        names = " ".join(name for name, _ in self.fetched[first:]).split()
        self.waves.append(" ".join(dict.fromkeys(names)))

    def labels(self, space: AtomSpace, observations: Sequence[Observation]) -> Labels:
        self.asked.append((" ".join(p.name for p in space.predicates), len(observations)))
        rows = [self._row(space, o.pictures[0].png.decode()) for o in observations]
        return np.array(rows, dtype=np.int8).reshape(len(observations), len(space.atoms))

    def fitter(self) -> Fitter:
        return Fitter(Labeller(self.recorded, self), FaithfulLearner())

    def fit(self, *predicates: Predicate) -> Fit:
        """All skills, with the given predicates or those of the notebook."""
        return self.fitter().fit(predicates or self.predicates)

    def data(self, skill: str) -> SkillData:
        return Labeller(self.recorded, self).label(self.predicates).of_skill(skill)

    def fit_skill(self, skill: str) -> SkillFit:
        """One skill, tautologies included."""
        own = self.domain.skill_by_name[skill]
        language = OperatorLanguage(self.domain, own, self.predicates, LearnerSettings())
        return fit_skill(language, self.data(skill))

    def _row(self, space: AtomSpace, state: str) -> list[int]:
        known = {
            Atom(name, tuple(t.strip() for t in terms.split(",") if t.strip())): mark
            for mark, name, terms in _ATOM.findall(state)
        }
        code = {None: FALSE, "": TRUE, "?": UNKNOWN}
        return [code[known.get(a)] for a in space.atoms]
