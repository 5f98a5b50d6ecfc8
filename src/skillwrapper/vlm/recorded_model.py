"""A model that only knows what was answered in a recorded run; it never uses the network."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from skillwrapper.errors import RecordingError
from skillwrapper.vlm.protocol import ModelReply, ModelRequest
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_call import CallStatus, question_key

_FILE = "calls.sqlite"


class RecordedModel:
    """Replays the calls of a run, for all roles.

    Args:
        folder: the folder of the run.

    Raises:
        RunFolderError: if the run has no call store, or a damaged one.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._store = CallStore(folder / _FILE, read_only=True)

    @property
    def name(self) -> str:
        """``recorded:`` and the folder."""
        return f"recorded:{self._folder}"

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        """None: the recording holds whatever the recorded models were set to."""
        return {}

    def complete(self, request: ModelRequest) -> ModelReply:
        """The recorded reply.

        One that was of no use then is marked, and makes who asks ask again, as then.

        Raises:
            RecordingError: if the question was not answered in the recorded run.
        """
        call = self._store.find_question(question_key(request))
        if call is None:
            raise RecordingError(
                f"{self._folder}: this question of the role '{request.role}' has no usable answer "
                f"in the recorded run: '{_first_line(request.prompt)}'; run with the "
                "configuration and the prompts of the recording, or with another model"
            )
        return ModelReply(
            call.reply,
            call.usage,
            taken_back=call.status.is_taken_back,
            cut_off=call.status is CallStatus.PASSED_OVER,
        )

    def close(self) -> None:
        """Close the recording."""
        self._store.close()


def _first_line(prompt: str) -> str:
    return next((line.lstrip("# ") for line in prompt.splitlines() if line.strip()), "")
