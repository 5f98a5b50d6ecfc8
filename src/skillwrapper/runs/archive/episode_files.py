"""Writing the record of an episode line by line; and taking back what a person reports wrongly."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from skillwrapper.files.json_documents import whole_lines
from skillwrapper.files.writing import append_line, json_line, write_atomically
from skillwrapper.redaction import without_secrets
from skillwrapper.runs.archive.layout import RunLayout
from skillwrapper.runs.archive.pictures import PictureStore
from skillwrapper.runs.archive.records import EpisodeRecord, ExecutionRecord, SceneRecord
from skillwrapper.world.episode import Transition
from skillwrapper.world.observation import Observation
from skillwrapper.world.scenes import Scene


@dataclass(frozen=True)
class EpisodeFile:
    """The record of one episode.

    Attributes:
        layout: of the run.
        number: of the episode, from 1.
    """

    layout: RunLayout
    number: int

    def start(self, scene: Scene, seed: int, start: Observation, *, given: bool = False) -> None:
        """Write where the episode starts.

        Args:
            scene: the objects that are present.
            seed: that of the reset.
            start: what is seen.
            given: whether it is none that the run chose itself.
        """
        record = EpisodeRecord(
            scene=SceneRecord(name=scene.name, objects=scene.names),
            seed=seed,
            start=self._pictures.save(start),
            given=given or None,
        )
        self._append(record)

    def add(self, transition: Transition, seen_last: Observation, message: str = "") -> None:
        """Write what was executed.

        Args:
            transition: what came of it.
            seen_last: what the episode showed before; kept again only if the transition starts
                from another picture.
            message: why it failed, for people.
        """
        moved = transition.before.key != seen_last.key
        record = ExecutionRecord(
            skill=transition.instance.skill,
            arguments=transition.instance.arguments,
            success=transition.success,
            message=without_secrets(message),
            before=self._pictures.save(transition.before) if moved else None,
            after=self._pictures.save(transition.after),
            changed=transition.changed,
        )
        self._append(record)

    def take_back(self) -> bool:
        """Remove the last execution; False if there is none."""
        lines = whole_lines(self._path)
        if len(lines) < 2:
            return False
        write_atomically(self._path, b"".join(line + b"\n" for line in lines[:-1]))
        return True

    def close(self) -> None:
        """Note that the episode is over, whatever would have been chosen next."""
        lines = whole_lines(self._path)
        header = EpisodeRecord.model_validate_json(lines[0]).model_copy(update={"given": True})
        rest = b"".join(line + b"\n" for line in lines[1:])
        first = json_line(header.model_dump(mode="json", exclude_none=True))
        write_atomically(self._path, first + rest)

    @property
    def _path(self) -> Path:
        return self.layout.episode(self.number)

    @property
    def _pictures(self) -> PictureStore:
        return PictureStore(self.layout.images)

    def _append(self, record: EpisodeRecord | ExecutionRecord) -> None:
        append_line(self._path, record.model_dump(mode="json", exclude_none=True))
