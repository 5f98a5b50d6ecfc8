"""Models around other models: what they add is all that they have to write down."""

from __future__ import annotations

from collections.abc import Mapping

from skillwrapper.vlm.protocol import ModelReply, ModelRequest, TakesBack, VisionLanguageModel


class ModelWrapper:
    """Passes everything on to the model behind it; a base for those that do more.

    Args:
        model: the model behind.
    """

    def __init__(self, model: VisionLanguageModel) -> None:
        self._model = model

    @property
    def name(self) -> str:
        """The name of the model behind."""
        return self._model.name

    @property
    def parameters(self) -> Mapping[str, str | int | float | bool]:
        """The parameters of the model behind."""
        return self._model.parameters

    def complete(self, request: ModelRequest) -> ModelReply:
        """What the model behind answers.

        Raises:
            ProviderError: as the model behind does.
        """
        return self._model.complete(request)

    def take_back(self, request: ModelRequest) -> None:
        """Pass on that the reply to a request was of no use."""
        if isinstance(self._model, TakesBack):
            self._model.take_back(request)
