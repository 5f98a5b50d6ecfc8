"""Opening the models that a run asks, with the store that keeps every call."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from skillwrapper.errors import UnknownNameError
from skillwrapper.run.config import ModelSettings, RunConfig
from skillwrapper.run.events import RunEvent
from skillwrapper.run.folder import RunFolder
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.embedded.model import EmbeddedModel
from skillwrapper.vlm.embedded.noise import noise_profile
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.prompt_library import PromptLibrary
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role, VisionLanguageModel
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_model import StoredModel

EMBEDDED = "embedded"


@dataclass
class Session:
    """Models that are ready to be asked.

    Attributes:
        assistant: asks them.
        iteration: the present iteration of the run, from 1; None before the first.
        calls: how many calls were answered so far, from a store or not.
    """

    assistant: Assistant = field(init=False)
    iteration: int | None = None
    calls: int = 0

    def note(self, event: RunEvent) -> None:
        """Take note of an event of the run."""
        self.iteration = event.iteration


class _Counted:
    """A model whose answers are counted in a session."""

    def __init__(self, model: VisionLanguageModel, session: Session) -> None:
        self._model, self._session = model, session
        self.name, self.parameters = model.name, model.parameters

    def complete(self, request: ModelRequest) -> ModelReply:
        self._session.calls += 1
        return self._model.complete(request)


@contextmanager
def open_assistant(
    config: RunConfig, folder: RunFolder, *, learning: bool = True
) -> Iterator[Session]:
    """The assistant of a run.

    Args:
        config: of the run.
        folder: of the run; its store serves what was asked before.
        learning: False for using what was learned: then the embedded model, which costs
            nothing, is asked without keeping its replies.

    Raises:
        UnknownNameError: if there is no such model.
        RunFolderError: if the store is damaged.
    """
    settings, session = config.model, Session()
    with ExitStack() as resources:
        store: CallStore | None = None
        made: dict[str, VisionLanguageModel] = {}
        for name in (settings.name, *settings.roles.values()):
            if name in made:
                continue
            model = make_model(settings, name, config.seed)
            if isinstance(model, RecordedModel):
                resources.callback(model.close)
            elif learning or name != EMBEDDED:
                store = store or resources.enter_context(CallStore(folder.calls))
                model = StoredModel(model, store, iteration=lambda: session.iteration)
            made[name] = _Counted(model, session)
        roles = {role: made[settings.roles.get(role, settings.name)] for role in Role}
        prompts = PromptLibrary(Path(settings.prompts) if settings.prompts else None)
        session.assistant = Assistant(ModelSet(roles), prompts, settings.assistant)
        yield session


def make_model(settings: ModelSettings, name: str, seed: int) -> VisionLanguageModel:
    """A model by its name: ``embedded`` or ``recorded:DIR``.

    Raises:
        UnknownNameError: if there is no such model or noise profile.
        RunFolderError: if a recording is missing or damaged.
    """
    kind, _, rest = name.partition(":")
    makers: dict[str, Callable[[], VisionLanguageModel]] = {
        EMBEDDED: lambda: EmbeddedModel(seed=seed, noise=noise_profile(settings.noise)),
        "recorded": lambda: RecordedModel(Path(rest)),
    }
    if kind not in makers:
        raise UnknownNameError("model", name, makers)
    return makers[kind]()
