"""What exploration remembers of its own attempts, beyond their labels."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from skillwrapper.exploration.histories import Deeds, Histories
from skillwrapper.exploration.roles import Kind, RoleNumbers, Roles, SceneRoles
from skillwrapper.grounding import Labels
from skillwrapper.grounding.abstract_states import different_rows
from skillwrapper.world.domain import Domain
from skillwrapper.world.episode import Transition
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance

_FADING = 0.8
"""What is left of a surprise after the next attempt of its kind, or once it is explained."""
_WEARING = 0.9
"""What is left of what speaks for a single instance after its next attempt."""
_PATIENCE = 3
"""After three times so many disappointments hope and patience are half of what they were."""

Signature = tuple[int, ...]
"""The roles of a skill instance's arguments."""


class Surprises:
    """How often predictions were wrong of late; starts with one surprise in two."""

    def __init__(self) -> None:
        self._wrong = {True: 1.0, False: 1.0}
        self._all = {True: 2.0, False: 2.0}

    def note(self, *, predicted: bool, success: bool) -> None:
        """Take note of an attempt that was, or was not, predicted to succeed."""
        self._wrong[predicted] = self._wrong[predicted] * _FADING + (predicted != success)
        self._all[predicted] = self._all[predicted] * _FADING + 1

    def rate(self, *, predicted: bool) -> float:
        """The share of wrong predictions, 0 to 0.5."""
        return min(0.5, (self._wrong[predicted] + 0.1) / (self._all[predicted] + 0.2))

    @property
    def doubt(self) -> float:
        """How likely a failure has a cause that no predicate speaks of yet, in a few steps."""
        rate = 0.6 * self._wrong[True] / (self._all[True] + 1)
        return min((0.01, 0.03, 0.1, 0.3), key=lambda step: abs(np.log(step / max(rate, 1e-3))))


class Memory:
    """Remembers every attempt by the roles that its arguments had.

    Args:
        domain: types and skills.

    Attributes:
        roles: the present roles of the scene's objects (objects,).
        deeds: what was done with them so far (objects,), and ``histories`` of all attempts.
        signatures: of every attempt so far, in order of time.
        seen: the signatures that were tried, by skill.
        surprises: how often predictions were wrong.
        pursued: how often a cause was gone after, by skill and signature.
        played: how often instances were tried, and with what roles of their arguments.
        failures: how often instances failed, and skills, also with the types of their arguments.
        successes: how often skills succeeded.
        proven: the skills, with the types of their arguments, that ever succeeded.
        missed: how often the way to an attempt led elsewhere, since it was last made.
    """

    def __init__(self, domain: Domain) -> None:
        self._domain = domain
        self._numbers = RoleNumbers()
        self._scenes: dict[Scene, SceneRoles] = {}
        self._failed: dict[str, set[tuple[int, int]]] = defaultdict(set)
        self._tried: dict[tuple[str, SkillInstance], bool] = {}
        self.played: dict[SkillInstance, Counter[Signature]] = defaultdict(Counter)
        self.failures: Counter[str | Kind | SkillInstance] = Counter()
        self.successes: Counter[str] = Counter()
        self.proven: set[Kind] = set()
        self._vain: set[tuple[bytes, SkillInstance]] = set()
        self._done: set[tuple[bytes, SkillInstance]] = set()
        self._kept: dict[SkillInstance, float] = defaultdict(float)
        self._broken: dict[SkillInstance, list[int]] = defaultdict(list)
        self.roles: Roles = np.zeros(0, dtype=np.intp)
        self.deeds: Deeds = np.zeros(0, dtype=np.int64)
        self.histories = Histories()
        self.signatures: list[Signature] = []
        self.seen: dict[str, set[Signature]] = defaultdict(set)
        self.surprises = Surprises()
        self.pursued: Counter[tuple[str, Signature]] = Counter()
        self.missed: Counter[SkillInstance] = Counter()

    def scene(self, scene: Scene) -> SceneRoles:
        """The roles that objects of a scene can play."""
        if scene not in self._scenes:
            self._scenes[scene] = SceneRoles(self._domain, scene, self._numbers)
        return self._scenes[scene]

    def start(self, scene: Scene) -> None:
        """Begin an episode: nothing was done yet with any object."""
        self.roles = self.scene(scene).at_start
        self.deeds = np.zeros(len(self.roles), dtype=np.int64)
        self._vain.clear()
        self._done.clear()

    def note(
        self,
        scene: Scene,
        transition: Transition,
        *,
        state: bytes = b"",
        predicted: bool | None = None,
    ) -> None:
        """Take note of an attempt.

        Args:
            scene: where it was made.
            transition: what came of it.
            state: the labels of the state in which it was made.
            predicted: whether it was predicted to succeed, where that is known.
        """
        own, instance = self.scene(scene), transition.instance
        number = own.number[instance]
        signature = own.signature(self.roles, number)
        self.signatures.append(signature)
        self.seen[instance.skill].add(signature)
        self.played[instance][signature] += 1
        self._tried[transition.before.key, instance] = transition.success
        if predicted is not None:
            self.surprises.note(predicted=predicted, success=transition.success)
        self._done.add((state, instance))
        if transition.success:
            self.roles = own.after(self.roles, number)
            self.successes[instance.skill] += 1
            self.proven.add(own.kinds[number])
            self._vain.clear()
        else:
            self._vain.add((state, instance))
            self.failures.update([instance, instance.skill, own.kinds[number]])
            self._failed[instance.skill] |= set(enumerate(signature))

    def rely(self, instance: SkillInstance, *, kept: bool) -> None:
        """Take note of whether the latest attempt, which surely works, led where the model says."""
        if kept:
            self._kept[instance] = self._kept[instance] * _WEARING + 1
        else:
            self._broken[instance].append(len(self.signatures) - 1)

    def reliability(self, scene: SceneRoles, unexplained: Collection[int]) -> NDArray[np.float64]:
        """How likely each instance (instances,) leads where the model is sure that it does.

        One that never failed there is relied on; else the share by the rule of succession. What
        led elsewhere speaks against the model as long as that does not explain it. Once it does,
        other operators stand in the place of those that were wrong, or a label was; they are
        relied on again bit by bit, as nothing was done with them yet.

        Args:
            scene: the instances.
            unexplained: numbers of the attempts that the model predicts wrongly.
        """
        now = len(self.signatures)
        shares = []
        for instance in scene.instances:
            broken = self._broken.get(instance, ())
            wrong = sum(1.0 if n in unexplained else _FADING ** (now - n) for n in broken)
            right = self._kept.get(instance, 0.0)
            shares.append((right + 1) / (right + 1 + 2 * wrong))
        return np.array(shares, dtype=np.float64)

    def hope(self, what: str | Kind | SkillInstance) -> float:
        """What hope there is, 0 to 1, for what never succeeded: less with every failure.

        Args:
            what: a skill, a skill with certain types of arguments, or an instance.
        """
        return _worn(self.failures[what])

    def hope_of_history(self, skill: str) -> float:
        """What hope there is, 0 to 1, that a skill needs a history: less with every one."""
        return _worn(self.histories.different(skill))

    def patience(self, skill: str) -> float:
        """What patience is left, 0 to 1, with a skill that changes nothing whenever it succeeds."""
        return _worn(self.successes[skill])

    def pursue(
        self, attempts: Iterable[tuple[str, int]], scene: SceneRoles, instance: SkillInstance
    ) -> None:
        """Take note that earlier attempts, by skill and number, are repeated by one now."""
        signature = scene.signature(self.roles, scene.number[instance])
        same = {self.signatures[number] for skill, number in attempts if skill == instance.skill}
        # Who has other roles than all of them stands for each of them.
        for pursued in same & {signature} or same:
            self.pursued[instance.skill, pursued] += 1

    def pursued_in_all(self, skill: str) -> int:
        """How often any cause of a skill was gone after."""
        return sum(times for (name, _), times in self.pursued.items() if name == skill)

    def was_tried(self, observation: str, state: bytes, instance: SkillInstance) -> bool:
        """Whether to run an instance would only repeat what is known.

        It was run where the same was seen, or in this episode where the labels were the same.

        Args:
            observation: key of what is seen.
            state: the labels.
            instance: the skill instance.
        """
        return (observation, instance) in self._tried or (state, instance) in self._done

    def done(self, states: Labels, instances: Sequence[SkillInstance]) -> NDArray[np.bool_]:
        """What was run in this episode where the labels were like this (states, instances).

        Args:
            states: labels (states, atoms).
            instances: the skill instances.
        """
        found = np.zeros((len(states), len(instances)), dtype=bool)
        numbers = {instance: number for number, instance in enumerate(instances)}
        rows = {state.tobytes(): row for row, state in enumerate(states)}
        for state, instance in self._done:
            if state in rows:
                found[rows[state], numbers[instance]] = True
        return found

    def has_failed(self, observation: str, state: bytes, instance: SkillInstance) -> bool:
        """Whether it moreover failed."""
        failed = not self._tried.get((observation, instance), True)
        return failed or (state, instance) in self._vain

    def new_signatures(
        self, tried: Collection[Signature], roles: Roles, places: NDArray[np.intp]
    ) -> NDArray[np.bool_]:
        """Whether roles of the arguments are none of those that were tried (nodes,).

        Args:
            tried: those of a skill (``seen``), or of an instance (``played``).
            roles: of all objects (nodes, objects).
            places: of the arguments among them.
        """
        first, place = different_rows(roles[:, places])
        different = roles[np.ix_(first, places)].tolist()
        new = np.array([tuple(row) not in tried for row in different], dtype=bool)
        return new[place]

    def new_roles(self, skill: str, roles: Roles, places: NDArray[np.intp]) -> NDArray[np.float64]:
        """How new the roles of some argument are beside the skill's failures (nodes,), 0 to 1.

        A role that differs from a known one in the types of the others alone is less new.
        """
        kinds, newest = self._numbers.kinds, np.zeros(len(roles))
        for position, place in enumerate(places.tolist()):
            failed = [role for at, role in self._failed[skill] if at == position]
            known = np.isin(roles[:, place], failed)
            similar = np.isin(kinds[roles[:, place]], kinds[failed] if failed else [])
            newest = np.maximum(newest, np.where(known, 0.0, np.where(similar, 0.6, 1.0)))
        return newest


def _worn(times: int) -> float:
    """What is left, 0 to 1, of hope or patience after so many disappointments."""
    return float(np.sqrt(_PATIENCE / (_PATIENCE + times)))
