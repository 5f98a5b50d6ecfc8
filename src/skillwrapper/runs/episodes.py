"""Running episodes skill by skill, and following those that were recorded before."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from skillwrapper.errors import RobotError, RunFolderError
from skillwrapper.exploration.explorer import NextSkill
from skillwrapper.runs.events import EpisodeStarted, Observer, SkillExecuted, SkillRecalled
from skillwrapper.world.capabilities import Lasting, Replayable, require, supports
from skillwrapper.world.environment import Environment
from skillwrapper.world.episode import Episode, Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene
from skillwrapper.world.skills import SkillInstance


@dataclass(frozen=True)
class EpisodeSoFar:
    """An episode up to now.

    Attributes:
        scene: the objects that are present.
        seed: that of the reset.
        start: what was seen after the reset.
        transitions: what was executed since; grows.
        given: whether it is taken as it is: no choice of the run, and never continued.
    """

    scene: Scene
    seed: int
    start: Observation
    transitions: list[Transition] = field(default_factory=list)
    given: bool = False

    @property
    def observation(self) -> Observation:
        """What is seen now."""
        return self.transitions[-1].after if self.transitions else self.start

    def to_episode(self) -> Episode:
        """The same as an episode that has ended."""
        return Episode(self.scene, self.seed, tuple(self.transitions))


Choose = Callable[[EpisodeSoFar], NextSkill]
"""From an episode so far to the next skill to run, or the end of the episode."""


class EpisodeRunner:
    """Runs the episodes of a run.

    An episode that was cut short is continued: the environment is reset with the same seed, and
    what was recorded is executed again and compared (``Replayable``), or it stands there still
    (``Lasting``). The episode of any other environment ends where the record ends.

    Args:
        environment: the robot or simulator.
        tell: told of what is executed and recalled.
    """

    def __init__(self, environment: Environment, tell: Observer) -> None:
        self._environment, self._tell = environment, tell

    def run(self, iteration: int, number: int, seed: int, scene: str, choose: Choose) -> Episode:
        """A new episode.

        Args:
            iteration: in which it is run.
            number: of the episode in the run.
            seed: for the reset.
            scene: name of the scene to start in.
            choose: decides what to execute.

        Raises:
            RobotError: if the environment fails.
        """
        start = self._environment.reset(seed=seed, scene=scene)
        done = EpisodeSoFar(self._environment.scene, seed, start)
        first = choose(
            done
        )  # before anything is recorded: a model that is not there leaves nothing
        self._tell(EpisodeStarted(iteration, number, done.scene, seed, start))
        self._go_on(iteration, number, done, choose, first)
        return done.to_episode()

    def follow(
        self, iteration: int, number: int, recorded: EpisodeSoFar, scene: str, choose: Choose
    ) -> Episode:
        """An episode that was recorded, continued if it was cut short.

        Args:
            iteration: in which it was run.
            number: of the episode in the run.
            recorded: what was recorded.
            scene: name of the scene that was asked for.
            choose: decides what to execute; asked in any case, so that choices by chance are the
                same in a resumed run, and so that learning goes the same way from episodes that
                are given.

        Raises:
            RobotError: if the environment fails, or does not repeat what was recorded.
            RunFolderError: if something else was recorded than is chosen.
        """
        done = EpisodeSoFar(recorded.scene, recorded.seed, recorded.start)
        for transition in recorded.transitions:
            chosen = choose(done)
            if not recorded.given:
                _check_choice(number, transition.instance, chosen.instance)
            done.transitions.append(transition)
            self._tell(SkillRecalled(iteration, transition, chosen.reason))
        following = choose(done)
        is_over = following.instance is None or recorded.given
        if not is_over and self._stands_at_end(recorded, scene):
            self._go_on(iteration, number, done, choose, following)
        return done.to_episode()

    def _stands_at_end(self, recorded: EpisodeSoFar, scene: str) -> bool:
        """Whether the environment stands where the record ends, or could be brought there."""
        if supports(self._environment, Replayable):
            self._repeat(recorded, scene)
            return True
        if supports(self._environment, Lasting):
            require(self._environment, Lasting, "going on").take_up(recorded.scene)
            return True
        return False

    def _go_on(
        self, iteration: int, number: int, done: EpisodeSoFar, choose: Choose, following: NextSkill
    ) -> None:
        while following.instance is not None:
            outcome = self._environment.execute(following.instance)
            transition = Transition(
                before=done.observation,
                instance=following.instance,
                success=outcome.success,
                after=outcome.observation,
                changed=outcome.changed,
            )
            done.transitions.append(transition)
            self._tell(
                SkillExecuted(iteration, number, transition, outcome.message, following.reason)
            )
            following = choose(done)

    def _repeat(self, recorded: EpisodeSoFar, scene: str) -> None:
        """Bring the environment to where the record ends."""
        seen = self._environment.reset(seed=recorded.seed, scene=scene)
        if seen.key != recorded.start.key:
            raise RobotError(
                f"reset with seed {recorded.seed} shows another picture than was recorded"
            )
        for transition in recorded.transitions:
            outcome = self._environment.execute(transition.instance)
            same = outcome.observation.key == transition.after.key
            if outcome.success != transition.success or not same:
                raise RobotError(f"{transition.instance} went another way than was recorded")


def _check_choice(number: int, recorded: SkillInstance, chosen: SkillInstance | None) -> None:
    if chosen != recorded:
        raise RunFolderError(
            f"episode {number}: {recorded} was recorded, and this version chooses "
            f"{chosen or 'the end of the episode'} instead; resume with the version that made the "
            "run (config.yaml)"
        )
