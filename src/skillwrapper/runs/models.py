"""From a model's name, as users write it, to a model that can be asked."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

from skillwrapper.domains.eyesight import Eyesight
from skillwrapper.embedded import EmbeddedModel, noise_profile
from skillwrapper.errors import ConfigurationError, UnknownNameError
from skillwrapper.runs.settings import ModelSettings, RunSettings
from skillwrapper.vlm.human_model import HumanModel
from skillwrapper.vlm.prompt_library import PromptLibrary, shipped_prompts
from skillwrapper.vlm.protocol import VisionLanguageModel
from skillwrapper.vlm.recorded_model import RecordedModel

EMBEDDED = "embedded"
HUMAN = "human"
ENDPOINT = "openai:"
"""How the names of models begin that are asked over an endpoint."""
GREETING = "Reply with the word: ready"
"""What is asked of a model to see whether it answers at all."""
_KINDS = ("embedded", "human", "openai:NAME", "recorded:DIR")


def open_model(
    name: str, settings: ModelSettings, seed: int, domain: str | None = None
) -> VisionLanguageModel:
    """The model of a name: ``embedded``, ``human``, ``openai:NAME`` or ``recorded:DIR``.

    Args:
        name: which model.
        settings: each for the models that it concerns.
        seed: of the embedded model.
        domain: whose pictures the embedded model is to make out; None for all that are bundled.

    Raises:
        ConfigurationError: if something is missing in the name, a setting makes no sense, or the
            embedded model has nothing to read pictures of the domain with.
        UnknownNameError: if there is no such kind of model or noise profile.
        AuthenticationError: if a key is needed and there is none.
        RunFolderError: if a recording is missing or damaged.
    """
    kind, _, rest = name.partition(":")
    if kind not in {known.partition(":")[0] for known in _KINDS}:
        raise UnknownNameError("model", name, _KINDS)
    if name == EMBEDDED:
        eyes = Eyesight.for_domain(domain)
        return EmbeddedModel(seed, noise_profile(settings.noise), eyes.readers, eyes.words)
    if name == HUMAN:
        return HumanModel()
    if kind == "recorded" and rest:
        return RecordedModel(Path(rest))
    if kind == "openai" and rest:
        return _open_endpoint(rest, settings)
    raise ConfigurationError(f"expected a model of the form {', '.join(_KINDS)}, got '{name}'")


def open_prompts(settings: ModelSettings) -> PromptLibrary:
    """The prompt templates of a run.

    Raises:
        UserError: if the folder or a template in it cannot be used.
    """
    return PromptLibrary(settings.prompts) if settings.prompts else shipped_prompts()


def model_names(settings: ModelSettings) -> tuple[str, ...]:
    """The models that a run asks, each once."""
    return tuple(dict.fromkeys((settings.name, *settings.roles.values())))


def asks_person(settings: ModelSettings) -> bool:
    """Whether somebody at the terminal answers in a run."""
    return HUMAN in model_names(settings)


def check_models(settings: RunSettings) -> None:
    """Make sure that the models of a run can be opened and its templates read.

    Raises:
        UserError: if a name, an option, a recording or a template is not what it should be.
        AuthenticationError: if a key is missing.
    """
    open_prompts(settings.model)
    with ExitStack() as resources:
        for name in model_names(settings.model):
            opened = open_model(name, settings.model, settings.seed, settings.domain)
            close_with(resources, opened)


def close_with(resources: ExitStack, model: VisionLanguageModel) -> VisionLanguageModel:
    """The same model, closed when the resources are, if it has anything to close."""
    close = getattr(model, "close", None)
    if callable(close):
        resources.callback(close)
    return model


def _open_endpoint(name: str, settings: ModelSettings) -> VisionLanguageModel:
    # Imported late: the client takes a second to load, and most commands do not need it.
    from skillwrapper.vlm.openai_model import OpenAIModel, OpenAISettings  # noqa: PLC0415

    endpoint = settings.endpoint.model_dump()
    return OpenAIModel(OpenAISettings(name, base_url=settings.base_url, **endpoint))
