"""Learning with a person who runs the skills, and who may take back what was reported."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from skillwrapper.robots.by_hand import HandRobot, SkipRequestedError, UndoRequestedError
from skillwrapper.runs.archive import EpisodeFile
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.runs.events import Observer
from skillwrapper.runs.launch import learn
from skillwrapper.runs.results import LearningResult
from skillwrapper.runs.settings import RunSettings
from skillwrapper.vlm.protocol import VisionLanguageModel


def learn_by_hand(
    settings: RunSettings,
    out: Path,
    person: HandRobot,
    tell: Callable[[str], object],
    *,
    model: VisionLanguageModel | None = None,
    observers: Sequence[Observer] = (),
) -> LearningResult:
    """Run Algorithm 1 with a person; what is taken back is as if it never had been.

    After an undo the run starts again from what is recorded, which asks no model anything new.
    A skill that is skipped ends its episode.

    Args:
        settings: what to do.
        out: the folder of the run.
        person: runs the skills.
        tell: says something to the person.
        model: as in ``learn``.
        observers: as in ``learn``.

    Raises:
        LimitReachedError: if the person leaves; the same call goes on later.
        SkillWrapperError: as in ``learn``.
    """
    layout = RunLayout(out)
    while True:
        try:
            return learn(settings, out, environment=person, model=model, observers=observers)
        except UndoRequestedError:
            done = EpisodeFile(layout, layout.recorded_episodes()).take_back()
            tell(
                "Taken back. Put the world back as it was before that skill."
                if done
                else "There is nothing to take back in this episode."
            )
        except SkipRequestedError as skipped:
            EpisodeFile(layout, layout.recorded_episodes()).close()
            tell(f"{skipped}; this episode ends here, and the next one begins.")
