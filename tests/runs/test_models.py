from __future__ import annotations

from pathlib import Path

import pytest
from scripted import ScriptedModel

from skillwrapper.errors import (
    AuthenticationError,
    LimitReachedError,
    RunFolderError,
    TemporaryProviderError,
    UnknownNameError,
    UserError,
)
from skillwrapper.runs.model_sessions import open_session
from skillwrapper.runs.models import open_model
from skillwrapper.runs.settings import CallSettings, ModelSettings, RunSettings
from skillwrapper.vlm.protocol import ModelRequest, Role
from skillwrapper.vlm.settings import EndpointSettings
from skillwrapper.vlm.store import CallStore

PLAIN = ModelSettings()


def test_models_by_their_names(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv("OPENAI_API_KEY", raising=False)
    embedded = open_model("embedded", ModelSettings(noise="gpt5"), 4)
    assert embedded.parameters["seed"] == 4
    assert embedded.parameters["noise"] == "gpt5"

    local = open_model("openai:qwen", ModelSettings(base_url="http://127.0.0.1:9/v1"), 0)
    assert local.name == "openai:qwen"
    with pytest.raises(AuthenticationError, match="OPENAI_API_KEY"):
        open_model("openai:gpt-5", PLAIN, 0)

    CallStore(tmp_path / "calls.sqlite").close()
    assert open_model(f"recorded:{tmp_path}", PLAIN, 0).name == f"recorded:{tmp_path}"
    with pytest.raises(RunFolderError):
        open_model(f"recorded:{tmp_path / 'nowhere'}", PLAIN, 0)


@pytest.mark.parametrize("name", ["gpt-5", "openai", "openai:", "recorded:", "embedded:x", ""])
def test_other_names(name: str) -> None:
    with pytest.raises(UserError, match=r"expected|unknown model"):
        open_model(name, PLAIN, 0)


def test_an_unknown_noise_profile() -> None:
    with pytest.raises(UnknownNameError, match="noise profile"):
        open_model("embedded", ModelSettings(noise="gpt9"), 0)


def test_settings_of_endpoints_reach_them() -> None:
    endpoint = EndpointSettings(temperature=0.5, reasoning_effort="low")
    settings = ModelSettings(base_url="http://127.0.0.1:9/v1", endpoint=endpoint)
    parameters = open_model("openai:qwen", settings, 0).parameters
    assert (parameters["temperature"], parameters["reasoning_effort"]) == (0.5, "low")


def answers(*replies: str | Exception) -> ScriptedModel:
    waiting = iter(replies)

    def answer(_: ModelRequest) -> str:
        reply = next(waiting)
        if isinstance(reply, Exception):
            raise reply
        return reply

    return ScriptedModel(answer)


def test_calls_are_repeated_kept_and_limited(tmp_path: Path) -> None:
    model = answers(TemporaryProviderError("busy"), "yes", "too much")
    settings = RunSettings(domain="lamps", calls=CallSettings(max_calls=2, first_wait=0))
    with open_session(settings, tmp_path / "calls.sqlite", model=model) as session:
        asked = session.assistant._models.complete
        for _ in range(3):
            assert asked(ModelRequest(Role.ACT, "", "a")).text == "yes"
        with pytest.raises(LimitReachedError):
            asked(ModelRequest(Role.ACT, "", "b"))
        assert (session.counter.made, session.counter.answered) == (2, 4)
    with CallStore(tmp_path / "calls.sqlite", read_only=True) as store:
        assert [call.reply for call in store.calls()] == ["yes"]


def test_without_a_store_calls_are_repeated_and_limited_all_the_same() -> None:
    model = answers(TemporaryProviderError("busy"), "yes", "again")
    settings = RunSettings(domain="lamps", calls=CallSettings(max_calls=3, first_wait=0))
    with open_session(settings, model=model) as session:
        asked = session.assistant._models.complete
        assert asked(ModelRequest(Role.ACT, "", "a")).text == "yes"
        assert asked(ModelRequest(Role.EVALUATE, "", "a")).text == "again"
        with pytest.raises(LimitReachedError):
            asked(ModelRequest(Role.ACT, "", "a"))
