from __future__ import annotations

from pathlib import Path

import pytest
from scripted import ScriptedModel

from skillwrapper.errors import (
    AuthenticationError,
    ConfigurationError,
    LimitReachedError,
    RunFolderError,
    TemporaryProviderError,
    UnknownNameError,
)
from skillwrapper.runs.opening import CallKeeping, ModelOptions, keep_calls, open_model
from skillwrapper.vlm.limits import CallBudget, CallLimits
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.vlm.retrying import RetryPolicy
from skillwrapper.vlm.store import CallStore


def test_models_by_their_names(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)
    embedded = open_model("embedded", ModelOptions(seed=4, noise="gpt5"))
    assert embedded.parameters["seed"] == 4
    assert embedded.parameters["noise"] == "gpt5"

    local = open_model("openai:qwen", ModelOptions(base_url="http://127.0.0.1:9/v1"))
    assert local.name == "openai:qwen"
    with pytest.raises(AuthenticationError, match="OPENAI_API_KEY"):
        open_model("openai:gpt-5")

    CallStore(tmp_path / "calls.sqlite").close()
    assert open_model(f"recorded:{tmp_path}").name == f"recorded:{tmp_path}"
    with pytest.raises(RunFolderError):
        open_model(f"recorded:{tmp_path / 'nowhere'}")


@pytest.mark.parametrize("name", ["gpt-5", "openai", "openai:", "recorded:", "embedded:x", ""])
def test_other_names(name: str) -> None:
    with pytest.raises(ConfigurationError, match="expected"):
        open_model(name)


def test_an_unknown_noise_profile() -> None:
    with pytest.raises(UnknownNameError, match="noise profile"):
        open_model("embedded", ModelOptions(noise="gpt9"))


def test_calls_are_repeated_kept_and_limited(tmp_path: Path) -> None:
    replies = iter([TemporaryProviderError("busy"), "yes", "too much"])

    def answer(_: ModelRequest) -> str:
        reply = next(replies)
        if isinstance(reply, Exception):
            raise reply
        return reply

    with CallStore(tmp_path / "calls.sqlite") as store:
        keeping = CallKeeping(
            store, budget=CallBudget(CallLimits(calls=2)), policy=RetryPolicy(first_wait=0)
        )
        model = keep_calls(ScriptedModel(answer), keeping)
        for _ in range(3):
            assert model.complete(ModelRequest(Role.ACT, "", "a")).text == "yes"
        with pytest.raises(LimitReachedError):
            model.complete(ModelRequest(Role.ACT, "", "b"))
        assert [call.reply for call in store.calls()] == ["yes"]
