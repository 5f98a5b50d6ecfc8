"""Runs that are stopped or killed and go on: they meet the same replies, and end the same."""

from __future__ import annotations

import hashlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections import Counter
from pathlib import Path

import pytest

from skillwrapper.embedded.server import ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import NONSENSE, PASSING, FaultPlan
from skillwrapper.errors import LimitReachedError, ModelNotFoundError, RunFolderError
from skillwrapper.exploration.settings import ExplorationSettings
from skillwrapper.runs.archive import reserved
from skillwrapper.runs.launch import learn
from skillwrapper.runs.models import open_model
from skillwrapper.runs.settings import CallSettings, ModelSettings, RunSettings
from skillwrapper.vlm.protocol import (
    ModelReply,
    ModelRequest,
    ModelWrapper,
    VisionLanguageModel,
)
from skillwrapper.vlm.settings import AskingSettings
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_call import CallStatus

FAST = {"first_wait": 0.002, "longest_wait": 0.01}
FAULTS = FaultPlan(
    rate=0.3, kinds=(*PASSING, *[NONSENSE] * 4), seed=2, retry_after=0.01, slowness=0.01
)


def embedded(seed: int) -> VisionLanguageModel:
    return open_model("embedded", ModelSettings(), seed)


class MoodyModel(ModelWrapper):
    """Answers otherwise each time it is asked, and sometimes says nothing of use."""

    def __init__(self) -> None:
        super().__init__(embedded(0))
        self.asked = 0
        self._lock = threading.Lock()

    def complete(self, request: ModelRequest) -> ModelReply:
        with self._lock:
            self.asked += 1
            number = self.asked
        if hashlib.sha256(str(number).encode()).digest()[0] < 50:
            return ModelReply(f"I had rather not say, for the time being ({number}).")
        return embedded(number).complete(request)


@pytest.fixture(autouse=True)
def _environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("OPENAI_BASE_URL", "OPENAI_API_KEY", "HTTP_PROXY", "HTTPS_PROXY", "ALL_PROXY"):
        monkeypatch.delenv(name, raising=False)
        monkeypatch.delenv(name.lower(), raising=False)


def config(url: str | None = None, **calls: object) -> RunSettings:
    how = AskingSettings(parallel=4)
    model = ModelSettings(name="openai:embedded", base_url=url, asking=how)
    return RunSettings(
        domain="burger",
        seed=1,
        iterations=2,
        exploration=ExplorationSettings(budget=8),
        model=model if url else ModelSettings(),
        calls=CallSettings.model_validate({**FAST, **calls}),
    )


def short() -> RunSettings:
    return config().model_copy(update={"exploration": ExplorationSettings(budget=3)})


def model_of(run: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted((run / "model").iterdir())}


def replies_by_key(run: Path) -> Counter[str]:
    """How many replies each question has, refused and empty ones left out."""
    with CallStore(run / "calls.sqlite", read_only=True) as store:
        kept = {CallStatus.ANSWERED, CallStatus.UNUSABLE}
        return Counter(call.key for call in store.calls() if call.status in kept)


def test_a_resumed_run_goes_the_way_it_went_whatever_the_model_would_say_now(
    tmp_path: Path,
) -> None:
    model = MoodyModel()
    shared = tmp_path / "shared.sqlite"
    run = tmp_path / "run"
    with VlmServer(model) as server:
        sessions = 0
        for calls in (4, 6, 6, None):
            try:
                learn(config(server.url, max_calls=calls, shared_store=shared), run)
            except LimitReachedError:
                sessions += 1
        assert sessions == 3
        found, asked = model_of(run), model.asked
        with CallStore(run / "calls.sqlite", read_only=True) as store:
            assert any(store.calls(status=CallStatus.UNUSABLE))
        assert set(replies_by_key(run).values()) == {1}
        assert sum(replies_by_key(run).values()) == asked

        learn(config(server.url), run)
        learn(config(server.url, shared_store=shared), tmp_path / "again")
        assert model.asked == asked
    recording = ModelSettings(name=f"recorded:{run}")
    learn(config().model_copy(update={"model": recording}), tmp_path / "replay")
    for other in (run, tmp_path / "again", tmp_path / "replay"):
        assert model_of(other) == found


def test_a_finished_run_is_not_replaced_by_a_shorter_one(tmp_path: Path) -> None:
    run = tmp_path / "run"
    learn(short(), run)
    before = {path: path.read_bytes() for path in run.rglob("*") if path.is_file()}
    with pytest.raises(RunFolderError, match=r"2 iterations are finished.*--iterations 2 or more"):
        learn(short().model_copy(update={"iterations": 1}), run)
    after = {path: path.read_bytes() for path in run.rglob("*") if path.is_file()}
    assert after == before


def test_two_processes_do_not_learn_in_one_folder(tmp_path: Path) -> None:
    run = tmp_path / "run"
    with reserved(run), pytest.raises(RunFolderError, match="another process is learning"):
        learn(short(), run)
    assert not run.exists()
    learn(short(), run)


def test_a_mistake_that_only_the_server_notices_leaves_nothing_behind(tmp_path: Path) -> None:
    run = tmp_path / "run"
    with VlmServer(embedded(1)) as server:
        settings = ModelSettings(name="openai:embeddde", base_url=server.url)
        wrong = config().model_copy(update={"model": settings})
        with pytest.raises(ModelNotFoundError):
            learn(wrong, run)
        assert not run.exists()
        run.mkdir()
        with pytest.raises(ModelNotFoundError):
            learn(wrong, run)
        assert not list(run.iterdir())
        learn(config(server.url), run)
        kept = sorted(run.iterdir())
        with pytest.raises(RunFolderError, match="other settings"):
            learn(wrong, run)
    assert sorted(run.iterdir()) == kept


_LEARNER = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from test_resuming import config
from skillwrapper.runs.launch import learn
learn(config(sys.argv[2]), Path(sys.argv[3]))
"""


def test_a_run_that_is_killed_among_faults_ends_as_if_nothing_had_been(tmp_path: Path) -> None:
    learn(config(), tmp_path / "direct")
    run = tmp_path / "run"
    with VlmServer(embedded(1), ServerSettings(faults=FAULTS)) as server:
        command = [sys.executable, "-c", _LEARNER, str(Path(__file__).parent), server.url, str(run)]
        process = subprocess.Popen(command)
        try:
            while server.calls < 15 and process.poll() is None:
                time.sleep(0.001)
        finally:
            os.kill(process.pid, signal.SIGKILL)
            assert process.wait() == -signal.SIGKILL
        assert not (run / "model").exists()
        learn(config(server.url), run)
    assert model_of(run) == model_of(tmp_path / "direct")
    assert set(replies_by_key(run).values()) == {1}
