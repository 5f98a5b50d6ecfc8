"""Exploring by plan: the next skill is the first step towards what tells most for its price.

The model is searched for what is within reach by skills that surely work; there every skill
instance is weighed by what trying it would tell (``worth``), divided by the number of skills that
it takes. After every outcome all is thought over anew (docs/semantics.md D16).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.beliefs import Beliefs
from skillwrapper.exploration.explorer import NextSkill, Situation
from skillwrapper.exploration.histories import Touched, nearest_unheard
from skillwrapper.exploration.lookahead import Lookahead, look_ahead, roll_out
from skillwrapper.exploration.memory import Memory
from skillwrapper.exploration.prospects import price
from skillwrapper.exploration.roles import SceneRoles
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.exploration.worth import Lead, Values, Weights, Worth, weigh
from skillwrapper.grounding import AtomSpace, GroundModel, Labels
from skillwrapper.grounding.abstract_states import AbstractStates
from skillwrapper.grounding.bindings import Attempts
from skillwrapper.grounding.search import StateGraph
from skillwrapper.learning.fitting import Fit
from skillwrapper.learning.inconsistencies import distinct_causes
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.symbols.operators import Operator
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance

_NOTHING = 1e-3
"""What is worth less is not worth a skill."""
_UNHEARD = 5
"""Of skills that failed so often it is looked at what was done with their arguments before."""
_MISSED = 0.5
"""What an attempt from afar is still worth, every time that the way to it has led elsewhere."""

_WHY: Mapping[str, str] = {
    "new": "{skill} was never tried like this",
    "check": "checks that {instance} works as the model says",
    "cover": "{skill} was never tried after what was last done with these objects",
    "witness": "looks again at an attempt at {skill} that the model cannot explain",
    "repeat": "sees {skill} again, of which only doubtful labels tell",
}


@dataclass(frozen=True, eq=False)
class Thought:
    """What can be done in a situation, and what it is worth.

    Attributes:
        scene: the skill instances.
        lookahead: what is within reach, the present first.
        worth: what every instance is worth in every node, by what for.
        values: the same all together; less than nothing for what was tried before just here.
        causes: what the model cannot explain, one transition for each cause.
        frail: successes that rest on doubtful labels.
        graph: the states of the model.
        space: their ground atoms.
        left: how many skills may still be run in this episode.
        touched: with what the skill instances have to do.
    """

    scene: SceneRoles
    lookahead: Lookahead
    worth: Worth
    values: Values
    causes: tuple[Lead, ...]
    frail: tuple[Lead, ...]
    graph: StateGraph
    space: AtomSpace
    left: int
    touched: Touched

    @property
    def state(self) -> bytes:
        """The same as bytes."""
        return self.labels.tobytes()

    @property
    def labels(self) -> Labels:
        """The labels (atoms,) of the present state."""
        labels: Labels = self.lookahead.states[self.lookahead.state[0]]
        return labels

    @cached_property
    def scores(self) -> Values:
        """What every attempt is worth for its price (nodes, instances)."""
        likely = self.values * self.lookahead.chance[:, np.newaxis]
        return likely / price(self.lookahead, self.values, self.left)

    @property
    def is_idle(self) -> bool:
        """Whether nothing within reach is worth a try."""
        return bool(self.values.max(initial=0.0) < _NOTHING)

    @property
    def is_stuck(self) -> bool:
        """Whether moreover all was tried here, and nothing leads away."""
        return len(self.values) == 1 and bool(self.values.max(initial=-1.0) < 0)

    def is_predicted(self, instance: SkillInstance) -> bool:
        """Whether an instance surely works now, by the model."""
        state = self.lookahead.state[0]
        return bool(self.lookahead.sure[state, self.scene.number[instance]])

    def leads(self, instance: SkillInstance, state: Labels) -> bool:
        """Whether an instance that surely works leads from here to a state (atoms,).

        As ways go by the first operator that applies, so does this.
        """
        here = self.graph.add(self.lookahead.states[self.lookahead.state[0]])
        edges = self.graph.edges([here])
        after = next(edge.after for _, edge in edges if edge.instance == instance)
        return bool((self.graph.states([after]) == state).all())

    def repeated(self, instance: SkillInstance) -> tuple[Lead, ...]:
        """The earlier attempts for the sake of which running an instance now is worth it."""
        part = self.worth.main_part(0, self.scene.number[instance])
        return {"witness": self.causes, "repeat": self.frail}.get(part, ())


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
        self._settings, self._weights = settings, weights or Weights()
        self._chance = np.random.default_rng(seed)
        self._memory, self._beliefs = Memory(domain), Beliefs()
        self._graph: tuple[tuple[AtomSpace, tuple[Operator, ...]], StateGraph] | None = None
        self._noted = 0
        self._thought: Thought | None = None
        self._target: SkillInstance | None = None

    def next_skill(self, situation: Situation) -> NextSkill:
        """The first step towards the best attempt within reach, or the end if one is stuck."""
        return self.choose(situation, self.think(situation))

    def record(self, episode: Episode) -> None:
        """Take note of an episode that has ended."""
        self._note(episode.scene, episode.transitions)
        self._noted = 0

    def think(self, situation: Situation) -> Thought:
        """Weigh everything within reach; to be called once in every situation."""
        last = self._thought
        self._note(situation.scene, situation.done)
        if not situation.done:
            self._memory.start(situation.scene)
        elif last is not None and last.space == situation.space:
            self._compare(last, situation)
            self._touch(last, situation)
        scene, here = self._memory.scene(situation.scene), situation.state.tobytes()
        seen = situation.observation.key
        failed = [self._memory.has_failed(seen, here, instance) for instance in scene.instances]
        lookahead = look_ahead(
            self._graph_of(situation),
            situation.state,
            self._memory.roles,
            scene,
            depth=min(self._settings.lookahead, situation.left - 1),
            most=max(1, self._settings.weighed // max(1, len(scene.instances))),
            blocked=np.flatnonzero(failed).tolist(),
            reliability=self._memory.reliability(scene, _unexplained(situation.fit)),
        )
        frail = _frail(situation)
        causes = _causes(situation, frail)
        worth = self._weigh(situation, lookahead, causes, frail)
        values = worth.total
        tried = [self._memory.was_tried(seen, here, instance) for instance in scene.instances]
        values[1:] *= _MISSED ** np.array([self._memory.missed[i] for i in scene.instances])
        values[self._memory.done(lookahead.states, scene.instances)[lookahead.state]] = -_NOTHING
        values[0, tried] = -_NOTHING
        graph, space = self._graph_of(situation), situation.space
        left, touched = situation.left, self._touched(situation)
        self._thought = Thought(
            scene, lookahead, worth, values, causes, frail, graph, space, left, touched
        )
        return self._thought

    def _unheard(self, situation: Situation) -> frozenset[str]:
        """The skills that never succeeded, often enough for what no predicate tells to matter."""
        tries = self._memory.histories.tries
        return frozenset(
            skill for skill, of_skill in situation.fit.skills.items()
            if not of_skill.operators and tries[skill] >= _UNHEARD
        )  # fmt: skip

    def _touched(self, situation: Situation) -> Touched:
        skills = [skill.name for skill in situation.fit.domain.skills]
        scene = self._memory.scene(situation.scene)
        return Touched(scene, situation.space, skills, _silent(situation.fit))

    def _touch(self, last: Thought, situation: Situation) -> None:
        """Take note of what the last skill had to do with."""
        done = situation.done[-1]
        if done.success:
            number = last.scene.number[done.instance]
            touched = last.touched.by(number, last.labels, situation.state)
            self._memory.deeds = self._memory.deeds | touched

    def _compare(self, last: Thought, situation: Situation) -> None:
        """Take note of whether the last skill led where it was said to."""
        instance = situation.done[-1].instance
        if last.is_predicted(instance):
            kept = last.leads(instance, situation.state)
            self._memory.rely(instance, kept=kept)
            if self._target is not None and not kept:
                self._memory.missed[self._target] += 1
        if self._target is None:
            self._memory.missed.pop(instance, None)

    def choose(self, situation: Situation, thought: Thought) -> NextSkill:
        """What comes of a thought."""
        if thought.is_idle and thought.is_stuck and situation.done:
            return NextSkill(None, "all was tried here, and nothing leads away", resumes=True)
        self._target = None
        unheard = self._try_unheard(situation, thought)
        if unheard is not None:
            return unheard
        if thought.is_idle:
            return self._wander(thought)
        scores = thought.scores + 1e-6 * self._chance.random(len(thought.scene.instances))
        node, number = (int(n) for n in np.unravel_index(np.argmax(scores), scores.shape))
        first = [*thought.lookahead.path(node), number][0]
        self._target = thought.scene.instances[number] if node else None
        reason = self._reason(situation, thought, node, number)
        return NextSkill(thought.scene.instances[first], reason)

    def _try_unheard(self, situation: Situation, thought: Thought) -> NextSkill | None:
        """The first step to a skill that never succeeded, after what was never done before it.

        None if there is no such way, or something else is worth more for its price.
        """
        skills = self._unheard(situation)
        if not skills:
            return None
        instances, histories = thought.scene.instances, self._memory.histories
        way = nearest_unheard(
            self._graph_of(situation),
            situation.state,
            self._memory.deeds,
            thought.scene,
            thought.touched,
            histories,
            skills=skills,
            depth=situation.left - 1,
            most=self._settings.weighed // 10,
            blocked=np.flatnonzero(thought.values[0] < 0).tolist(),
        )
        if not way:
            return None
        wanted, away = instances[way[-1]], len(way) - 1
        worth = self._weights.unheard * self._memory.hope_of_history(wanted.skill)
        if worth < float(thought.scores.max(initial=0.0)):
            return None
        reason = f"{wanted.skill} was never tried after what was done with these objects by then"
        reason = f"on the way, {away} more to go: {reason}" if away else reason
        self._target = wanted if away else None
        return NextSkill(instances[way[0]], reason)

    def _wander(self, thought: Thought) -> NextSkill:
        """Every other time a skill that surely works, else one that was tried most rarely.

        Where all seems known, states that look alike to the vocabulary may still differ.
        """
        instances = thought.scene.instances
        sure = [instance for instance in instances if thought.is_predicted(instance)]
        if sure and self._chance.random() < 0.5:
            chosen = sure[int(self._chance.integers(len(sure)))]
            return NextSkill(chosen, "drawn by chance to get elsewhere, as nothing seems new")
        times = np.array([self._memory.played[instance].total() for instance in instances])
        number = int(np.argmin(times + self._chance.random(len(times))))
        return NextSkill(instances[number], "was tried most rarely; nothing seems worth more")

    def follow(self, situation: Situation, sequence: Sequence[SkillInstance]) -> Values:
        """What each skill of a sequence is worth (steps,), if the model is right on the way."""
        scene = self._memory.scene(situation.scene)
        numbers = [scene.number[instance] for instance in sequence]
        graph, roles = self._graph_of(situation), self._memory.roles
        way = roll_out(graph, situation.state, roles, scene, numbers)
        frail = _frail(situation)
        worth = self._weigh(situation, way, _causes(situation, frail), frail)
        values: Values = worth.total[np.arange(len(numbers)), numbers]
        return values

    def _graph_of(self, situation: Situation) -> StateGraph:
        operators = tuple(learned.operator for learned in situation.fit.operators)
        key = (situation.space, operators)
        if self._graph is None or self._graph[0] != key:
            model = GroundModel.from_operators(operators, situation.space)
            self._graph = key, StateGraph(model, self._settings.weighed)
        return self._graph[1]

    def _weigh(
        self,
        situation: Situation,
        lookahead: Lookahead,
        causes: tuple[Lead, ...],
        frail: tuple[Lead, ...],
    ) -> Worth:
        fit, scene = situation.fit, self._memory.scene(situation.scene)
        doubt = self._memory.surprises.doubt
        expected = self._beliefs.expect(
            fit, situation.space, lookahead.states, scene.instances, doubt
        )
        unproven = frozenset(s for s, of_skill in fit.skills.items() if not of_skill.operators)
        return weigh(
            lookahead,
            expected,
            scene,
            self._memory,
            unproven=unproven,
            silent=_silent(fit),
            causes=causes,
            frail=frail,
            weights=self._weights,
        )

    def _note(self, scene: Scene, done: Sequence[Transition]) -> None:
        """Take note of what was done since the last time."""
        for transition in done[self._noted :]:
            if self._noted == 0:
                self._memory.start(scene)
            thought, instance = self._thought, transition.instance
            repeated = thought.repeated(instance) if thought is not None else ()
            if thought is not None and repeated:
                attempts = ((lead.skill, lead.number) for lead in repeated)
                self._memory.pursue(attempts, thought.scene, instance)
            predicted = None if thought is None else thought.is_predicted(instance)
            state = b"" if thought is None else thought.state
            if thought is not None:
                history = thought.touched.history(
                    thought.scene.number[instance], self._memory.deeds, thought.labels
                )
                self._memory.histories.note(instance.skill, history)
            self._memory.note(scene, transition, state=state, predicted=predicted)
            self._noted, self._thought = self._noted + 1, None

    def _reason(self, situation: Situation, thought: Thought, node: int, number: int) -> str:
        """Why an attempt is made, in words."""
        instance, part = thought.scene.instances[number], thought.worth.main_part(node, number)
        if part == "test":
            lookahead = thought.lookahead
            reason = self._tested(situation, lookahead.states[lookahead.state[[node]]], instance)
        else:
            reason = _WHY[part].format(skill=instance.skill, instance=instance)
        away = int(thought.lookahead.depth[node])
        return f"on the way, {away} more to go: {reason}" if away else reason

    def _tested(
        self, situation: Situation, state: NDArray[np.int8], instance: SkillInstance
    ) -> str:
        space = situation.space
        arguments = np.array([space.index.numbers(instance.arguments)], dtype=np.intp)
        attempts = Attempts.everywhere(AbstractStates(state), arguments)
        doubt = self._memory.surprises.doubt
        beliefs = self._beliefs.of_skill(situation.fit, instance.skill, doubt)
        doubts = [version_space.doubts(space, attempts) for version_space in beliefs.spaces]
        _, conditions = max(doubts, key=lambda found: found[0])
        return f"tests whether {instance} needs {' and '.join(conditions)}"


def _silent(fit: Fit) -> frozenset[str]:
    """The skills of which no success seems to change anything."""
    return frozenset(skill for skill, of in fit.skills.items() if of.unnoticed is not None)


def _unexplained(fit: Fit) -> frozenset[int]:
    """The numbers of the transitions that the model predicts wrongly."""
    return frozenset(number for _, _, number in fit.witnesses)


def _causes(situation: Situation, frail: Sequence[Lead]) -> tuple[Lead, ...]:
    """What the model cannot explain, one transition for each cause.

    Of successes that seem to change no more than failures do, where labels may be wrong, these are
    the successes: further failures would tell nothing of what a success changes.
    """
    skills = situation.fit.skills
    found: dict[Lead, None] = {}
    for one in distinct_causes(situation.fit.inconsistencies):
        if one.kind is not InconsistencyKind.EFFECT or not skills[one.skill].frail:
            found[Lead(one.skill, one.culprit)] = None
        elif (lead := Lead(one.skill, one.first)) in frail:
            found[lead] = None
    return tuple(found)


def _frail(situation: Situation) -> tuple[Lead, ...]:
    """The successes that rest on doubtful labels, and were not seen again in this episode.

    What they made may keep them from succeeding again.
    """
    seen = {transition.instance.skill for transition in situation.done if transition.success}
    skills = situation.fit.skills.items()
    return tuple(Lead(s, number) for s, of in skills if s not in seen for number in of.frail)
