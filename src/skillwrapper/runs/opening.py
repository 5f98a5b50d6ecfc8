"""From a model's name, as users write it, to a model that can be asked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from skillwrapper.embedded import EmbeddedModel, noise_profile
from skillwrapper.errors import ConfigurationError
from skillwrapper.vlm.limits import CallBudget, LimitedModel
from skillwrapper.vlm.protocol import VisionLanguageModel
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.retrying import RetryingModel, RetryPolicy
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_model import StoredModel

_FORMS = "'embedded', 'openai:NAME' or 'recorded:DIR'"


@dataclass(frozen=True)
class ModelOptions:
    """Settings of the models, each for the models it concerns.

    Attributes:
        seed: of the embedded model.
        noise: noise profile of the embedded model.
        base_url: address of an OpenAI-compatible endpoint; None for OpenAI's own.
        temperature: of models behind an endpoint; None for their default.
        reasoning_effort: of models behind an endpoint; None for their default.
        image_size: longer side of pictures sent to an endpoint, in pixels; None for as they are.
        timeout: seconds that one attempt at an endpoint may take.
    """

    seed: int = 0
    noise: str = "none"
    base_url: str | None = None
    temperature: float | None = None
    reasoning_effort: str | None = None
    image_size: int | None = 1024
    timeout: float = 120.0


@dataclass(frozen=True)
class CallKeeping:
    """What stands between a run and its models.

    Attributes:
        store: of the run.
        shared: store of several runs; None for none.
        budget: what may be spent, by all models together.
        policy: how often calls are repeated.
        iteration: tells the present iteration of the run.
    """

    store: CallStore
    shared: CallStore | None = None
    budget: CallBudget = field(default_factory=CallBudget)
    policy: RetryPolicy = field(default_factory=RetryPolicy)
    iteration: Callable[[], int | None] = lambda: None


def open_model(name: str, options: ModelOptions | None = None) -> VisionLanguageModel:
    """The model of a name: ``embedded``, ``openai:NAME`` or ``recorded:DIR``.

    Raises:
        ConfigurationError: if the name has none of these forms, or an option makes no sense.
        UnknownNameError: if there is no such noise profile.
        AuthenticationError: if a key is needed and there is none.
        RunFolderError: if a recording cannot be read.
    """
    options = options or ModelOptions()
    kind, _, rest = name.partition(":")
    if name == "embedded":
        return EmbeddedModel(options.seed, noise_profile(options.noise))
    if kind == "recorded" and rest:
        return RecordedModel(Path(rest))
    if kind == "openai":
        return _open_endpoint(rest, options)
    raise ConfigurationError(f"expected a model of the form {_FORMS}, got '{name}'")


def keep_calls(model: VisionLanguageModel, keeping: CallKeeping) -> VisionLanguageModel:
    """The model with its calls limited, kept and repeated.

    A call is looked up before it counts against a limit, and every attempt is looked up anew:
    a retry is served if another thread has got the answer meanwhile.
    """
    limited = LimitedModel(model, keeping.budget)
    stored = StoredModel(limited, keeping.store, keeping.shared, keeping.iteration)
    return RetryingModel(stored, keeping.policy)


def _open_endpoint(name: str, options: ModelOptions) -> VisionLanguageModel:
    # Imported late: the client takes a second to load, and most commands do not need it.
    from skillwrapper.vlm.openai_model import OpenAIModel, OpenAISettings  # noqa: PLC0415

    return OpenAIModel(
        OpenAISettings(
            name,
            base_url=options.base_url,
            temperature=options.temperature,
            reasoning_effort=options.reasoning_effort,
            image_size=options.image_size,
            timeout=options.timeout,
        )
    )
