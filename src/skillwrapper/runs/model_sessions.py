"""The models of a run while they are asked: every call limited, kept, repeated and counted."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from skillwrapper.redaction import Redactor
from skillwrapper.runs.models import (
    EMBEDDED,
    ENDPOINT,
    GREETING,
    close_with,
    model_names,
    open_model,
    open_prompts,
)
from skillwrapper.runs.settings import CallSettings, RunSettings
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.limits import CallBudget, LimitedModel
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import (
    ModelReply,
    ModelRequest,
    ModelWrapper,
    Role,
    VisionLanguageModel,
)
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.retrying import RetryingModel
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_model import StoredModel


@dataclass
class CallCounter:
    """How often models were asked, and in which iteration it is now.

    Attributes:
        budget: counts the calls that were made, not those served from a store.
        answered: how many calls were answered so far, from a store or not.
        iteration: the present iteration of the run, from 1; None before the first.
    """

    budget: CallBudget = field(default_factory=CallBudget)
    answered: int = 0
    iteration: int | None = None
    _lock: threading.Lock = field(default_factory=threading.Lock, repr=False)

    @property
    def made(self) -> int:
        """How many calls a model was asked."""
        return self.budget.calls

    def count(self) -> None:
        """Count a call; may be used from several threads."""
        with self._lock:
            self.answered += 1


@dataclass(frozen=True)
class ModelSession:
    """Models that are ready to be asked.

    Attributes:
        assistant: asks them.
        counter: counts the calls.
        distant: those of them that somebody else serves.
    """

    assistant: Assistant
    counter: CallCounter
    distant: tuple[VisionLanguageModel, ...] = ()

    def greet(self) -> None:
        """Ask every distant model for one word, before a robot moves for nothing.

        Raises:
            ProviderError: if one does not answer, for instance because of a wrong name or key.
        """
        for model in self.distant:
            model.complete(ModelRequest(Role.ACT, "", GREETING))


@dataclass(frozen=True)
class CallKeeping:
    """What stands between a run and its models.

    Attributes:
        settings: how calls are repeated.
        counter: counts them, against the limits, and knows the iteration.
        store: of the run; None to keep nothing.
        shared: store of several runs; None for none.
        redactor: takes secrets out of what the stores keep.
    """

    settings: CallSettings
    counter: CallCounter
    store: CallStore | None = None
    shared: CallStore | None = None
    redactor: Redactor = field(default_factory=Redactor)

    def around(self, model: VisionLanguageModel) -> VisionLanguageModel:
        """The model with its calls limited, kept and repeated.

        A call is looked up before it counts against a limit, and every attempt is looked up anew:
        a retry is served if another thread has got the answer meanwhile.
        """
        kept: VisionLanguageModel = LimitedModel(model, self.counter.budget)
        if self.store is not None:
            kept = StoredModel(kept, self.store, self.shared, self._iteration, self.redactor)
        budget = self.counter.budget
        return RetryingModel(kept, self.settings.retries, lambda: budget.seconds_left)

    def _iteration(self) -> int | None:
        return self.counter.iteration


class _CountedModel(ModelWrapper):
    """A model whose answers are counted."""

    def __init__(self, model: VisionLanguageModel, counter: CallCounter) -> None:
        super().__init__(model)
        self._counter = counter

    def complete(self, request: ModelRequest) -> ModelReply:
        self._counter.count()
        return super().complete(request)


@contextmanager
def open_session(
    settings: RunSettings,
    store: Path | None = None,
    *,
    model: VisionLanguageModel | None = None,
    learning: bool = True,
) -> Iterator[ModelSession]:
    """The models of a run.

    Args:
        settings: of the run.
        store: file of the run's call store, which serves what was asked before; made if it does
            not exist. None to keep nothing.
        model: answers every role in place of the models that the settings name.
        learning: False for using what was learned: then the embedded model, which costs nothing,
            is asked without keeping its replies.

    Raises:
        ConfigurationError: if there is no such model, or a setting makes no sense.
        ProviderError: if a key is missing.
        RunFolderError: if a store is damaged.
    """
    counter = CallCounter(CallBudget(settings.calls.limits))
    prompts = open_prompts(settings.model)
    with ExitStack() as resources:
        opened = _open_all(settings, model, resources)
        kept = {name: m for name, m in opened.items() if _is_kept(name, m, learning)}
        if kept:
            keeping = _open_stores(settings, store, counter, resources)
            opened |= {name: keeping.around(m) for name, m in kept.items()}
        counted = {name: _CountedModel(m, counter) for name, m in opened.items()}
        by_role = {role: counted[_name_of(role, settings, model)] for role in Role}
        asking = settings.model.asking
        distant = tuple(m for name, m in counted.items() if name.startswith(ENDPOINT))
        yield ModelSession(Assistant(ModelSet(by_role), prompts, asking), counter, distant)


def _open_all(
    settings: RunSettings, model: VisionLanguageModel | None, resources: ExitStack
) -> dict[str, VisionLanguageModel]:
    """All models by their names; a given one stands for all of them."""
    if model is not None:
        return {model.name: model}
    opened = {
        name: open_model(name, settings.model, settings.seed, settings.domain)
        for name in model_names(settings.model)
    }
    return {name: close_with(resources, model) for name, model in opened.items()}


def _name_of(role: Role, settings: RunSettings, model: VisionLanguageModel | None) -> str:
    if model is not None:
        return model.name
    return settings.model.roles.get(role, settings.model.name)


def _is_kept(name: str, model: VisionLanguageModel, learning: bool) -> bool:
    if isinstance(model, RecordedModel):
        return False
    return learning or name != EMBEDDED


def _open_stores(
    settings: RunSettings, store: Path | None, counter: CallCounter, resources: ExitStack
) -> CallKeeping:
    if store is None:
        return CallKeeping(settings.calls, counter)
    own = resources.enter_context(CallStore(store))
    path = settings.calls.shared_store
    shared = resources.enter_context(CallStore(path)) if path else None
    redactor = Redactor.knowing((settings.model.base_url or "",), os.environ)
    return CallKeeping(settings.calls, counter, own, shared, redactor)
