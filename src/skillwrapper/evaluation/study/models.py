"""The models of a study, side by side."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from skillwrapper.runs.models import EMBEDDED, open_model
from skillwrapper.runs.settings import ModelSettings
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, ModelWrapper, VisionLanguageModel
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.settings import AskingSettings
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_model import StoredModel

_REPETITIONS_A_RUN = 1000
"""More than a question is ever repeated in one run."""


@dataclass(frozen=True)
class StudiedModel:
    """A model to study.

    Attributes:
        name: as given, e.g. ``openai:gpt-5``, ``embedded`` or ``embedded:gpt5``.
        noise: noise profile of the embedded model.
    """

    name: str
    noise: str = "none"

    @classmethod
    def parse(cls, text: str, noise: str) -> StudiedModel:
        """A model by name; ``embedded:PROFILE`` names its noise profile itself."""
        kind, _, rest = text.partition(":")
        return cls(EMBEDDED, rest or noise) if kind == EMBEDDED else cls(text)

    @property
    def is_embedded(self) -> bool:
        """Whether it is our stand-in, of which tables must say so."""
        return self.name == EMBEDDED

    @property
    def label(self) -> str:
        """What it is called in tables."""
        return f"{self.name}, noise {self.noise}" if self.is_embedded else self.name


class _Repeated(ModelWrapper):
    """A model that is asked everything once more, in a run of its own."""

    def __init__(self, model: VisionLanguageModel, run: int) -> None:
        super().__init__(model)
        self._shift = run * _REPETITIONS_A_RUN

    def complete(self, request: ModelRequest) -> ModelReply:
        return super().complete(self._shifted(request))

    def take_back(self, request: ModelRequest) -> None:
        super().take_back(self._shifted(request))

    def _shifted(self, request: ModelRequest) -> ModelRequest:
        return replace(request, repetition=request.repetition + self._shift)


@contextmanager
def open_studied(
    model: StudiedModel,
    domain: str,
    *,
    seed: int = 0,
    run: int = 0,
    calls: Path | None = None,
    settings: AskingSettings | None = None,
) -> Iterator[Assistant]:
    """An assistant that asks a model.

    Args:
        model: which one.
        domain: whose pictures the embedded model is to make out.
        seed: of the embedded model.
        run: number of the run, from 0; the same questions are asked anew in each.
        calls: a store in which calls are kept and found again; None for none.
        settings: how models are asked.

    Raises:
        UnknownNameError: if there is no such model or noise profile.
        RunFolderError: if the store is damaged.
    """
    made = open_model(model.name, ModelSettings(noise=model.noise), seed + run, domain)
    with ExitStack() as resources:
        if isinstance(made, RecordedModel):
            resources.callback(made.close)
        elif calls is not None:
            made = StoredModel(made, resources.enter_context(CallStore(calls)))
        repeated = _Repeated(made, run) if run else made
        yield Assistant(ModelSet.of(repeated), None, settings)
