"""Which model answers which role."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skillwrapper.errors import ConfigurationError
from skillwrapper.vlm.protocol import (
    ModelReply,
    ModelRequest,
    Role,
    TakesBack,
    VisionLanguageModel,
)


@dataclass(frozen=True)
class ModelSet:
    """One model for every role.

    Attributes:
        by_role: the models; every role has one.

    Raises:
        ConfigurationError: if a role has no model.
    """

    by_role: Mapping[Role, VisionLanguageModel]

    def __post_init__(self) -> None:
        missing = [str(role) for role in Role if role not in self.by_role]
        if missing:
            raise ConfigurationError(f"expected a model for every role, got none for: {missing}")

    @classmethod
    def of(cls, model: VisionLanguageModel, **others: VisionLanguageModel) -> ModelSet:
        """One model for all roles, except those named, e.g. ``evaluate=other_model``."""
        unknown = sorted(set(others) - {str(role) for role in Role})
        if unknown:
            raise ConfigurationError(
                f"unknown role '{unknown[0]}'; known: {', '.join(map(str, Role))}"
            )
        return cls({role: others.get(str(role), model) for role in Role})

    def complete(self, request: ModelRequest) -> ModelReply:
        """Let the model of the request's role answer."""
        return self.by_role[request.role].complete(request)

    def take_back(self, request: ModelRequest) -> None:
        """Tell the model of the request's role that its reply was of no use."""
        model = self.by_role[request.role]
        if isinstance(model, TakesBack):
            model.take_back(request)
