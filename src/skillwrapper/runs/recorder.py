"""Executing skill sequences so that a crash loses at most the skill in flight."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from skillwrapper.errors import RobotError, RunFolderError
from skillwrapper.files.json_documents import read_lines
from skillwrapper.files.writing import append_line
from skillwrapper.runs.folder import RunFolder
from skillwrapper.world.capabilities import Replayable, supports
from skillwrapper.world.domain import Domain, load_domain
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance

Choose = Callable[[Scene, Observation], tuple[SkillInstance, ...]]
"""From the scene and the first observation to the sequence to execute."""

Listener = Callable[[Transition], None]


class EpisodeRecorder:
    """Runs an episode in the environment, or reads it if it was recorded already.

    An episode that was cut short by a crash is continued: the environment is reset with the
    same seed and what was recorded is executed again and compared. An environment that cannot
    do that (a robot) is not ``Replayable``; its episode then ends where the
    record ends.
    """

    def __init__(self, folder: RunFolder, environment: Environment) -> None:
        self._folder = folder
        self._environment = environment

    def run(
        self, number: int, seed: int, scene: str | None, choose: Choose, listener: Listener
    ) -> Episode:
        """Record an episode.

        Args:
            number: of the episode, from 1.
            seed: for the reset of the environment.
            scene: name of the scene to start in; None for the environment's choice.
            choose: decides what to execute; called in any case, so that choices by chance are
                the same in a resumed run.
            listener: told of every new transition.

        Raises:
            RobotError: if the environment fails, or does not repeat what was recorded.
            RunFolderError: if the record does not fit.
        """
        lines = list(read_lines(self._folder.episode(number)))
        if not lines:
            return self._start(number, seed, scene, choose, listener)
        header, entries = lines[0], lines[1:]
        recorded = read_scene(header, self._environment.domain)
        start = self._folder.load_observation(header["start"])
        sequence = choose(recorded, start)
        if [str(i) for i in sequence] != header["sequence"]:
            raise RunFolderError(
                f"{self._folder.episode(number)}: another sequence was recorded than this version "
                "chooses; resume with the version that made the run (config.yaml)"
            )
        transitions = read_transitions(self._folder, start, entries)
        if len(transitions) < len(sequence) and supports(self._environment, Replayable):
            self._repeat(start, seed, scene, transitions)
            for instance in sequence[len(transitions) :]:
                transitions.append(self._execute(number, transitions, start, instance))
                listener(transitions[-1])
        return Episode(recorded, seed, tuple(transitions))

    def _start(
        self, number: int, seed: int, scene: str | None, choose: Choose, listener: Listener
    ) -> Episode:
        start = self._environment.reset(seed=seed, scene=scene)
        present = self._environment.scene
        sequence = choose(present, start)
        header = {
            "scene": {"name": present.name, "objects": list(present.names)},
            "seed": seed,
            "sequence": [str(i) for i in sequence],
            "start": self._folder.save_observation(start),
        }
        append_line(self._folder.episode(number), header)
        transitions: list[Transition] = []
        for instance in sequence:
            transitions.append(self._execute(number, transitions, start, instance))
            listener(transitions[-1])
        return Episode(present, seed, tuple(transitions))

    def _execute(
        self, number: int, done: list[Transition], start: Observation, instance: SkillInstance
    ) -> Transition:
        before = done[-1].after if done else start
        outcome = self._environment.execute(instance)
        entry = {
            "skill": instance.skill,
            "arguments": list(instance.arguments),
            "success": outcome.success,
            "message": outcome.message,
            "after": self._folder.save_observation(outcome.observation),
        }
        if outcome.changed is not None:
            entry["changed"] = outcome.changed
        append_line(self._folder.episode(number), entry)
        return Transition(before, instance, outcome.success, outcome.observation, outcome.changed)

    def _repeat(
        self, start: Observation, seed: int, scene: str | None, recorded: list[Transition]
    ) -> None:
        """Bring the environment to where the record ends."""
        seen = self._environment.reset(seed=seed, scene=scene)
        if seen.key != start.key:
            raise RobotError(f"reset with seed {seed} shows another picture than was recorded")
        for transition in recorded:
            outcome = self._environment.execute(transition.instance)
            same = outcome.observation.key == transition.after.key
            if outcome.success != transition.success or not same:
                raise RobotError(f"{transition.instance} went another way than was recorded")


def read_episode(folder: RunFolder, number: int) -> Episode:
    """A recorded episode, from 1.

    Raises:
        RunFolderError: if there is none.
    """
    lines = list(read_lines(folder.episode(number)))
    if not lines:
        raise RunFolderError(f"{folder.episode(number)}: expected a recorded episode, got none")
    header = lines[0]
    scene = read_scene(header, load_domain(folder.path / "domain.yaml"))
    start = folder.load_observation(header["start"])
    transitions = read_transitions(folder, start, lines[1:])
    return Episode(scene, header["seed"], tuple(transitions))


def read_scene(header: dict[str, Any], domain: Domain) -> Scene:
    """The scene of the first line of an episode."""
    return Scene.of(header["scene"]["name"], header["scene"]["objects"], domain.objects)


def read_transitions(
    folder: RunFolder, start: Observation, entries: list[dict[str, Any]]
) -> list[Transition]:
    """The transitions of the lines of an episode."""
    transitions: list[Transition] = []
    before = start
    for entry in entries:
        instance = SkillInstance(entry["skill"], tuple(entry["arguments"]))
        after = folder.load_observation(entry["after"])
        success, changed = bool(entry["success"]), entry.get("changed")
        transitions.append(Transition(before, instance, success, after, changed))
        before = after
    return transitions
