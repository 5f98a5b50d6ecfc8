"""A world of two lamps, and an assistant that knows it, for whole runs without models.

A lamp can be lit while there is power, and put out while it is lit. The pictures are bytes that
list what is the case, so the assistant can read them.
"""

from __future__ import annotations

import random
import zlib
from collections.abc import Sequence
from pathlib import Path

from skillwrapper.errors import RobotError
from skillwrapper.exploration.questions import ProposalAnswer, ProposalQuestion
from skillwrapper.invention.questions import InventionAnswer, InventionQuestion
from skillwrapper.perception.questions import EvaluationAnswer, EvaluationQuestion
from skillwrapper.symbols import Predicate, all_groundings
from skillwrapper.world import (
    Domain,
    Observation,
    Outcome,
    Picture,
    Scene,
    SkillInstance,
    ground_skills,
    load_domain,
)

DOMAIN_YAML = """\
name: lamps
agent: A hand.
description: Two lamps.
types: {hand: {}, lamp: {}}
objects:
  hand: {types: [hand]}
  left: {types: [lamp]}
  right: {types: [lamp]}
skills:
  Light: {parameters: [{name: hand, type: hand}, {name: lamp, type: lamp}]}
  PutOut: {parameters: [{name: hand, type: hand}, {name: lamp, type: lamp}]}
"""


def seen(*lit: str, seed: int = 0) -> Observation:
    text = " ".join([f"seed {seed}:", *(f"lit({name})" for name in sorted(lit))])
    return Observation((Picture(text.encode()),))


class LampEnvironment:
    """Lights one lamp at a time: there is power for no more.

    Args:
        domain: of ``DOMAIN_YAML``.
        stops_after: how many skills are run before the robot breaks down.
    """

    replayable = True

    def __init__(self, domain: Domain, stops_after: int = 10**9) -> None:
        self._domain = domain
        self._left = stops_after
        self._seed = 0
        self._lit: frozenset[str] = frozenset()
        self.executed: list[SkillInstance] = []
        self.resets: list[int] = []
        self.closed = False

    @property
    def domain(self) -> Domain:
        return self._domain

    @property
    def scene(self) -> Scene:
        return self.domain.scene()

    def reset(self, *, seed: int, scene: str | None = None) -> Observation:
        self.domain.scene(scene)
        self._seed, self._lit = seed, frozenset()
        self.resets.append(seed)
        return self.observe()

    def observe(self) -> Observation:
        return seen(*self._lit, seed=self._seed)

    def execute(self, instance: SkillInstance) -> Outcome:
        if self._left == 0:
            raise RobotError("the hand broke down")
        self._left -= 1
        self.executed.append(instance)
        lamp = instance.arguments[1]
        success = not self._lit if instance.skill == "Light" else lamp in self._lit
        if success:
            self._lit = self._lit ^ {lamp}
        return Outcome(success, self.observe(), "" if success else "no power")

    def close(self) -> None:
        self.closed = True


class LampAssistant:
    """Answers by what is asked alone, so that a resumed run hears the same."""

    def propose_sequences(self, question: ProposalQuestion) -> ProposalAnswer:
        named = repr((question.observation.key, question.least_explored))
        chance = random.Random(zlib.crc32(named.encode()))
        instances = ground_skills(question.domain.skills, question.objects)
        return ProposalAnswer(
            tuple(tuple(chance.choices(instances, k=question.length)) for _ in range(3))
        )

    def invent_predicates(self, question: InventionQuestion) -> InventionAnswer:
        known = {p.name for p in (*question.current, *question.rejected)}
        pool = (
            Predicate("round", ("lamp",), "The lamp is round."),
            Predicate("lit", ("lamp",), "The lamp shines."),
            Predicate("power", (), "No lamp is lit."),
        )
        return InventionAnswer(tuple(p for p in pool if p.name not in known)[: question.count])

    def evaluate(self, questions: Sequence[EvaluationQuestion]) -> list[EvaluationAnswer]:
        answers = []
        for question in questions:
            text = question.observation.pictures[0].png.decode()
            atoms = all_groundings(question.predicates, question.objects)
            answers.append(
                EvaluationAnswer(
                    {
                        a: "lit" not in text if a.predicate == "power" else str(a) in text
                        for a in atoms
                    }
                )
            )
        return answers


def lamp_domain(folder: Path) -> Domain:
    return load_domain(domain_file(folder))


def domain_file(folder: Path) -> Path:
    path = folder / "lamps.yaml"
    path.write_text(DOMAIN_YAML, encoding="utf-8")
    return path
