"""Exploring by plan: the next skill is the first step towards what tells most for its price.

The model is searched for what is within reach by skills that surely work; there every skill
instance is weighed by what trying it would tell (``worth``), divided by the number of skills that
it takes. After every outcome all is thought over anew (docs/semantics.md D16).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from skillwrapper.exploration.beliefs import Beliefs
from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.exploration.lookahead import Lookahead, look_ahead
from skillwrapper.exploration.memory import Memory
from skillwrapper.exploration.roles import SceneRoles
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.exploration.worth import Weights, Worth, weigh
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.grounding.search import StateGraph
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import Inconsistency, distinct_causes
from skillwrapper.symbols.operators import Operator
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode
from skillwrapper.world.skills import SkillInstance

_NOTHING = 1e-3
"""What is worth less is not worth a skill."""

_WHY: Mapping[str, str] = {
    "new": "{skill} was never tried like this",
    "check": "checks that {instance} works as the model says",
    "cover": "{skill} was never tried after what was last done with these objects",
    "witness": "looks again at an attempt at {skill} that the model cannot explain",
}


class PlannedExplorer:
    """Chooses by expected information for every execution.

    Args:
        domain: types and skills.
        settings: how far to look.
        seed: decides between what is worth the same.
        weights: what counts how much.
    """

    def __init__(
        self,
        domain: Domain,
        settings: ExplorationSettings,
        seed: int,
        weights: Weights | None = None,
    ) -> None:
        self._settings = settings
        self._weights = weights or Weights()
        self._chance = np.random.default_rng(seed)
        self._memory = Memory(domain)
        self._beliefs = Beliefs()
        self._graph: tuple[tuple[AtomSpace, tuple[Operator, ...]], StateGraph] | None = None
        self._noted = 0
        self._predicted: bool | None = None

    def next_skill(self, situation: Situation) -> NextSkill:
        """The first step towards the best attempt within reach, or the end if none is worth it."""
        self._catch_up(situation)
        fit, scene = situation.fit, self._memory.scene(situation.scene)
        lookahead = self._look_ahead(situation, scene)
        causes = distinct_causes(fit.inconsistencies)
        doubt = self._memory.surprises.doubt
        expected = self._beliefs.expect(
            fit, situation.space, lookahead.states, scene.instances, doubt
        )
        worth = weigh(
            lookahead,
            expected,
            scene,
            self._memory,
            unproven=frozenset(s for s, of_skill in fit.skills.items() if not of_skill.operators),
            causes=causes,
            weights=self._weights,
        )
        values = worth.total
        for number, instance in enumerate(scene.instances):
            if self._memory.was_tried(situation.observation.key, instance):
                values[0, number] = -_NOTHING
        idle = bool(values.max() < _NOTHING)
        if idle and situation.done and len(values) == 1 and values.max() < 0:
            return NextSkill(None, "all was tried here, and nothing leads away")
        values += 1e-6 * self._chance.random(len(scene.instances))
        price = lookahead.depth[:, np.newaxis] + 1
        node, number = (int(n) for n in np.unravel_index(np.argmax(values / price), values.shape))
        path = [*lookahead.path(node), number]
        self._predicted = bool(lookahead.sure[0, path[0]])
        if len(path) == 1 and worth.main_part(node, number) == "witness":
            self._pursue(causes, scene.instances[number], scene)
        reason = "drawn by chance, as nothing within reach seems worth a try"
        if not idle:
            reason = self._reason(situation, lookahead, worth, node, scene.instances[number])
        return NextSkill(scene.instances[path[0]], reason)

    def record(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        self._note(episode)
        self._noted = 0

    def _catch_up(self, situation: Situation) -> None:
        self._note(Episode(situation.scene, 0, situation.done))
        if not situation.done:
            self._memory.start(situation.scene)

    def _note(self, episode: Episode) -> None:
        for transition in episode.transitions[self._noted :]:
            if self._noted == 0:
                self._memory.start(episode.scene)
            self._memory.note(episode.scene, transition, predicted=self._predicted)
            self._noted, self._predicted = self._noted + 1, None

    def _look_ahead(self, situation: Situation, scene: SceneRoles) -> Lookahead:
        operators = tuple(learned.operator for learned in situation.fit.operators)
        key = (situation.space, operators)
        if self._graph is None or self._graph[0] != key:
            model = GroundModel.from_operators(operators, situation.space)
            self._graph = key, StateGraph(model, self._settings.weighed)
        seen = situation.observation.key
        return look_ahead(
            self._graph[1],
            situation.state,
            self._memory.roles,
            scene,
            depth=min(self._settings.lookahead, situation.left - 1),
            most=max(1, self._settings.weighed // max(1, len(scene.instances))),
            blocked=[n for n, i in enumerate(scene.instances) if self._memory.has_failed(seen, i)],
        )

    def _pursue(
        self, causes: tuple[Inconsistency, ...], instance: SkillInstance, scene: SceneRoles
    ) -> None:
        """Take note that a cause is gone after once more."""
        signature = scene.signature(self._memory.roles, scene.number[instance])
        for cause in causes:
            if (
                cause.skill == instance.skill
                and self._memory.signatures[cause.culprit] == signature
            ):
                self._memory.pursued[cause.skill, signature] += 1

    def _reason(
        self,
        situation: Situation,
        lookahead: Lookahead,
        worth: Worth,
        node: int,
        instance: SkillInstance,
    ) -> str:
        """Why an attempt is made, in words."""
        number = self._memory.scene(situation.scene).number[instance]
        part = worth.main_part(node, number)
        if part == "test":
            state = lookahead.states[lookahead.state[[node]]]
            reason = self._tested(situation.fit, situation.space, state, instance)
        else:
            reason = _WHY[part].format(skill=instance.skill, instance=instance)
        away = int(lookahead.depth[node])
        return f"on the way, {away} more to go: {reason}" if away else reason

    def _tested(self, fit: Fit, space: AtomSpace, state: Labels, instance: SkillInstance) -> str:
        arguments = np.array([space.index.numbers(instance.arguments)], dtype=np.intp)
        attempts = Attempts.everywhere(AbstractStates(state), arguments)
        beliefs = self._beliefs.of_skill(fit, instance.skill, self._memory.surprises.doubt)
        doubts = [s.doubts(space, attempts) for s in beliefs.spaces]
        _, conditions = max(doubts, key=lambda found: found[0])
        return f"tests whether {instance} needs {' and '.join(conditions)}"
