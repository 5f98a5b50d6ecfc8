"""Opening the models that a run asks, with the store that keeps every call."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType

from skillwrapper.errors import UnknownNameError
from skillwrapper.runs.config import ModelSettings, RunConfig
from skillwrapper.runs.events import RunEvent
from skillwrapper.runs.folder import RunFolder
from skillwrapper.runs.opening import CallKeeping, ModelOptions, keep_calls, open_model
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.limits import CallBudget, CallLimits
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.prompt_library import PromptLibrary
from skillwrapper.vlm.protocol import (
    ModelReply,
    ModelRequest,
    Role,
    VisionLanguageModel,
)
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.retrying import RetryPolicy
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.wrapping import ModelWrapper

EMBEDDED = "embedded"
_KINDS: Mapping[str, str] = MappingProxyType(
    {"embedded": "embedded", "openai": "openai:NAME", "recorded": "recorded:DIR"}
)


@dataclass(frozen=True)
class Spending:
    """What a run may spend on calls; nothing here changes what is learned.

    Attributes:
        limits: after which the run stops.
        shared: file of a call store that several runs share; made if it does not exist.
        policy: how often calls are repeated that fail in passing.
    """

    limits: CallLimits = field(default_factory=CallLimits)
    shared: Path | None = None
    policy: RetryPolicy = field(default_factory=RetryPolicy)


@dataclass
class Session:
    """Models that are ready to be asked.

    Attributes:
        assistant: asks them.
        budget: counts the calls that were made, not those served from a store.
        iteration: the present iteration of the run, from 1; None before the first.
        calls: how many calls were answered so far, from a store or not.
    """

    assistant: Assistant = field(init=False)
    budget: CallBudget = field(default_factory=CallBudget)
    iteration: int | None = None
    calls: int = 0
    _lock: threading.Lock = field(default_factory=threading.Lock, repr=False)

    def note(self, event: RunEvent) -> None:
        """Take note of an event of the run."""
        self.iteration = event.iteration

    def count_call(self) -> None:
        """Count a call; may be used from several threads."""
        with self._lock:
            self.calls += 1


class _Counted(ModelWrapper):
    """A model whose answers are counted in a session."""

    def __init__(self, model: VisionLanguageModel, session: Session) -> None:
        super().__init__(model)
        self._session = session

    def complete(self, request: ModelRequest) -> ModelReply:
        self._session.count_call()
        return super().complete(request)


@contextmanager
def open_assistant(
    config: RunConfig,
    folder: RunFolder,
    *,
    learning: bool = True,
    spending: Spending | None = None,
) -> Iterator[Session]:
    """The assistant of a run.

    Args:
        config: of the run.
        folder: of the run; its store serves what was asked before.
        learning: False for using what was learned: then the embedded model, which costs
            nothing, is asked without keeping its replies.
        spending: limits, repetitions and a store shared with other runs; None for the defaults.

    Raises:
        ConfigurationError: if there is no such model, or a setting makes no sense.
        ProviderError: if a key is missing.
        RunFolderError: if a store is damaged.
    """
    settings, spending = config.model, spending or Spending()
    session = Session(budget=CallBudget(spending.limits))
    prompts = open_prompts(settings)
    with ExitStack() as resources:
        opened = {name: _open(settings, name, config.seed, resources) for name in _names(settings)}
        kept = {n: m for n, m in opened.items() if _is_kept(n, m, learning)}
        if kept:
            keep = _keeper(folder, spending, session, resources)
            opened |= {name: keep(model) for name, model in kept.items()}
        made = {name: _Counted(model, session) for name, model in opened.items()}
        roles = {role: made[settings.roles.get(role, settings.name)] for role in Role}
        session.assistant = Assistant(ModelSet(roles), prompts, settings.assistant)
        yield session


def check_models(config: RunConfig) -> None:
    """Make sure that the models of a run can be opened and its templates read.

    Raises:
        UserError: if a name, an option, a recording or a template is not what it should be.
        AuthenticationError: if a key is missing.
    """
    open_prompts(config.model)
    with ExitStack() as resources:
        for name in _names(config.model):
            _open(config.model, name, config.seed, resources)


def make_model(settings: ModelSettings, name: str, seed: int) -> VisionLanguageModel:
    """A model by its name: ``embedded``, ``openai:NAME`` or ``recorded:DIR``.

    Raises:
        ConfigurationError: if something is missing in the name.
        UnknownNameError: if there is no such kind of model or noise profile.
        AuthenticationError: if a key is needed and there is none.
        RunFolderError: if a recording is missing or damaged.
    """
    if name.partition(":")[0] not in _KINDS:
        raise UnknownNameError("model", name, _KINDS.values())
    options = ModelOptions(seed=seed, noise=settings.noise, base_url=settings.base_url)
    return open_model(name, options)


def _names(settings: ModelSettings) -> tuple[str, ...]:
    return tuple(dict.fromkeys((settings.name, *settings.roles.values())))


def open_prompts(settings: ModelSettings) -> PromptLibrary:
    """The templates of a run.

    Raises:
        UserError: if the folder or a template in it cannot be used.
    """
    return PromptLibrary(Path(settings.prompts) if settings.prompts else None)


def _open(
    settings: ModelSettings, name: str, seed: int, resources: ExitStack
) -> VisionLanguageModel:
    model = make_model(settings, name, seed)
    close = getattr(model, "close", None)
    if callable(close):
        resources.callback(close)
    return model


def _is_kept(name: str, model: VisionLanguageModel, learning: bool) -> bool:
    if isinstance(model, RecordedModel):
        return False
    return learning or name != EMBEDDED


def _keeper(
    folder: RunFolder, spending: Spending, session: Session, resources: ExitStack
) -> Callable[[VisionLanguageModel], VisionLanguageModel]:
    """What puts the stores, the limits and the repetitions around a model."""
    store = resources.enter_context(CallStore(folder.calls))
    shared = resources.enter_context(CallStore(spending.shared)) if spending.shared else None
    keeping = CallKeeping(store, shared, session.budget, spending.policy, lambda: session.iteration)
    return lambda model: keep_calls(model, keeping)
