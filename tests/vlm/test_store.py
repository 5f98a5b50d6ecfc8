"""The call store, and the models in front of it."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from scripted import ScriptedModel

from skillwrapper.errors import (
    ConfigurationError,
    LimitReachedError,
    ModelUnavailableError,
    RecordingError,
    RunFolderError,
    TemporaryProviderError,
    UnusableReplyError,
)
from skillwrapper.redaction import Redactor
from skillwrapper.usage import Usage
from skillwrapper.vlm.limits import CallBudget, CallLimits, LimitedModel
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.retrying import RetryingModel, RetryPolicy
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_call import CallStatus, call_key, question_key
from skillwrapper.vlm.stored_model import StoredModel
from skillwrapper.world import Picture


@pytest.fixture
def store(tmp_path: Path) -> Iterator[CallStore]:
    with CallStore(tmp_path / "calls.sqlite") as opened:
        yield opened


def request(prompt: str = "hello", role: Role = Role.EVALUATE, repetition: int = 0) -> ModelRequest:
    return ModelRequest(role, "system", prompt, (Picture(b"png"),), repetition)


class CostlyModel(ScriptedModel):
    """Also tells what a call took."""

    def complete(self, request: ModelRequest) -> ModelReply:
        reply = super().complete(request)
        cost = None if "free" in request.prompt else 0.25
        return ModelReply(reply.text, Usage(100, 10, cost, 0.5))


def test_every_part_of_a_call_is_part_of_its_key() -> None:
    base = request()
    keys = {
        call_key("m", {"t": 1}, base),
        call_key("n", {"t": 1}, base),
        call_key("m", {"t": 2}, base),
        call_key("m", {}, base),
        call_key("m", {"t": 1}, request("hello ")),
        call_key("m", {"t": 1}, request(role=Role.ACT)),
        call_key("m", {"t": 1}, request(repetition=1)),
        call_key("m", {"t": 1}, ModelRequest(base.role, "other", base.prompt, base.pictures)),
        call_key("m", {"t": 1}, ModelRequest(base.role, "system", base.prompt)),
        call_key("m", {"t": 1}, ModelRequest(base.role, "system", "hello", (Picture(b"gnp"),))),
    }
    assert len(keys) == 10
    assert call_key("m", {"a": 1, "b": 2}, base) == call_key("m", {"b": 2, "a": 1}, base)
    assert question_key(base) == question_key(request())


def test_a_known_question_is_served_and_not_asked(store: CallStore) -> None:
    behind = ScriptedModel(lambda r: f"reply to {r.prompt}")
    model = StoredModel(behind, store)

    first, second = model.complete(request()), model.complete(request())

    assert first.text == second.text == "reply to hello"
    assert second.usage.cost == 0
    assert len(behind.requests) == 1
    assert model.complete(request(repetition=1)).text
    assert len(behind.requests) == 2


def test_calls_outlive_the_store(tmp_path: Path) -> None:
    path = tmp_path / "calls.sqlite"
    with CallStore(path) as store:
        StoredModel(ScriptedModel(lambda _: "yes"), store).complete(request())
    with CallStore(path) as store:
        behind = ScriptedModel(lambda _: "no")
        assert StoredModel(behind, store).complete(request()).text == "yes"
        assert not behind.requests


def test_all_of_a_call_is_kept(store: CallStore) -> None:
    model = StoredModel(CostlyModel(lambda _: "yes"), store, iteration=lambda: 3)
    model.complete(request("what is it?"))
    (call,) = store.calls()
    assert (call.role, call.iteration, call.status) == (Role.EVALUATE, 3, CallStatus.ANSWERED)
    assert (call.system, call.prompt, call.reply) == ("system", "what is it?", "yes")
    assert call.pictures == (Picture(b"png").sha256,)
    assert call.usage == Usage(100, 10, 0.25, 0.5)
    assert call.model == "scripted"


def test_calls_can_be_chosen(store: CallStore) -> None:
    model = StoredModel(ScriptedModel(lambda _: "yes"), store)
    for role in (Role.ACT, Role.INVENT, Role.ACT):
        model.complete(request(f"{role}{len(list(store.calls()))}", role))
    assert len(list(store.calls(role=Role.ACT))) == 2
    assert list(store.calls(status=CallStatus.REFUSED)) == []
    assert list(store.calls(iteration=1)) == []


@pytest.mark.parametrize(("kind", "status"), [("refused", "refused"), ("empty", "empty")])
def test_refused_and_empty_replies_are_recorded_but_never_served(
    store: CallStore, kind: str, status: str
) -> None:
    answers = iter([UnusableReplyError("no", kind, "I will not", Usage(5, 1, 0.1, 1.0)), "yes"])

    def answer(_: ModelRequest) -> str:
        outcome = next(answers)
        if isinstance(outcome, Exception):
            raise outcome
        return outcome

    model = StoredModel(ScriptedModel(answer), store)
    with pytest.raises(UnusableReplyError):
        model.complete(request())
    assert model.complete(request()).text == "yes"
    assert [str(call.status) for call in store.calls()] == [status, "answered"]
    assert next(store.calls()).usage.cost == 0.1


def test_a_reply_that_was_taken_back_is_met_again_but_never_as_an_answer(
    store: CallStore, tmp_path: Path
) -> None:
    with CallStore(tmp_path / "shared.sqlite") as shared:
        behind = ScriptedModel(lambda _: f"reply {len(behind.requests)}")
        model = StoredModel(behind, store, shared)
        assert not model.complete(request()).taken_back
        model.take_back(request())
        again = model.complete(request())
        with CallStore(tmp_path / "other.sqlite") as fresh:
            elsewhere = StoredModel(behind, fresh, shared).complete(request())
            (copied,) = fresh.calls()
    for reply in (again, elsewhere):
        assert (reply.text, reply.taken_back, reply.usage.cost) == ("reply 1", True, 0)
    assert [(call.reply, call.status) for call in store.calls()] == [
        ("reply 1", CallStatus.UNUSABLE)
    ]
    assert (copied.status, copied.shared) == (CallStatus.UNUSABLE, True)
    assert len(behind.requests) == 1


def test_taking_a_reply_back_leaves_what_others_heard(store: CallStore, tmp_path: Path) -> None:
    with CallStore(tmp_path / "shared.sqlite") as shared, CallStore(tmp_path / "b.sqlite") as other:
        behind = ScriptedModel(lambda _: f"reply {len(behind.requests)}")
        mine, theirs = StoredModel(behind, store, shared), StoredModel(behind, other)
        mine.complete(request())
        theirs.complete(request())
        shared.add(next(other.calls()))
        mine.take_back(request())
        statuses = [(call.reply, call.status) for call in shared.calls()]
        found = shared.find(next(other.calls()).key)
    assert statuses == [("reply 1", CallStatus.UNUSABLE), ("reply 2", CallStatus.ANSWERED)]
    assert found is not None
    assert found.reply == "reply 2"


def test_a_shared_store_spares_other_runs_the_call(tmp_path: Path) -> None:
    with CallStore(tmp_path / "shared.sqlite") as shared:
        for run in ("a", "b"):
            with CallStore(tmp_path / f"{run}.sqlite") as store:
                behind = CostlyModel(lambda _: "yes")
                assert StoredModel(behind, store, shared).complete(request()).text == "yes"
                assert len(behind.requests) == (1 if run == "a" else 0)
                assert len(list(store.calls())) == 1
                (totals,) = store.totals()
                assert (totals.made, totals.served) == ((1, 0) if run == "a" else (0, 1))
                assert totals.cost == (0.25 if run == "a" else 0)


def test_totals_by_iteration_and_role_leave_unknown_costs_unknown(store: CallStore) -> None:
    iteration = 1
    model = StoredModel(CostlyModel(lambda _: "yes"), store, iteration=lambda: iteration)
    model.complete(request("a"))
    model.complete(request("b"))
    model.complete(request("b"))
    model.complete(request("c", Role.INVENT))
    iteration = 2
    model.complete(request("costs nobody knows, maybe free"))

    totals = store.totals()

    assert [(t.iteration, t.role, t.made, t.served) for t in totals] == [
        (1, Role.INVENT, 1, 0),
        (1, Role.EVALUATE, 2, 1),
        (2, Role.EVALUATE, 1, 0),
    ]
    assert [t.cost for t in totals] == [0.25, 0.5, None]
    assert [t.input_tokens for t in totals] == [100, 200, 100]
    assert totals[1].seconds == 1.0


def test_the_same_question_in_flight_twice_is_asked_once(store: CallStore) -> None:
    def slow(_: ModelRequest) -> str:
        time.sleep(0.05)
        return "yes"

    behind = ScriptedModel(slow)
    model = StoredModel(behind, store)
    threads = [threading.Thread(target=model.complete, args=(request(),)) for _ in range(5)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(behind.requests) == 1


def test_secrets_are_taken_out_of_all_that_is_kept_and_served(store: CallStore) -> None:
    """Templates and descriptions come from files in which keys may stand."""
    redactor = Redactor.knowing((), {"ROBOT_TOKEN": "planted-token"})
    model = StoredModel(ScriptedModel(lambda _: "I keep planted-token"), store, redactor=redactor)
    asked = replace(request("log in with planted-token"), system="sk-abcdefghijklmnop")
    first, second = (model.complete(asked).text for _ in range(2))
    (kept,) = store.calls()
    assert first == second == kept.reply == "I keep [key]"
    assert (kept.system, kept.prompt) == ("[key]", "log in with [key]")


def test_two_stores_can_use_one_file(tmp_path: Path) -> None:
    path = tmp_path / "shared.sqlite"
    with CallStore(path) as one, CallStore(path) as two:
        StoredModel(ScriptedModel(lambda _: "yes"), one).complete(request("a"))
        one.flush()
        StoredModel(ScriptedModel(lambda _: "yes"), two).complete(request("b"))
        two.flush()
        assert len(list(one.calls())) == len(list(two.calls())) == 2


_WRITER = """
import sys
from dataclasses import replace
from pathlib import Path
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_model import StoredModel

class Echo:
    name, parameters = "echo", {}
    def complete(self, request):
        return ModelReply(request.prompt)

model = StoredModel(Echo(), CallStore(Path(sys.argv[1])))
for number in range(10**9):
    model.complete(ModelRequest(Role.ACT, "", str(number)))
    print(number, flush=True)
"""


def test_a_killed_process_loses_no_reply(tmp_path: Path) -> None:
    path = tmp_path / "calls.sqlite"
    process = subprocess.Popen(
        [sys.executable, "-c", _WRITER, str(path)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    for line in process.stdout:
        used = int(line)
        if used > 300:
            break
    os.kill(process.pid, signal.SIGKILL)
    process.stdout.close()
    process.wait()
    with CallStore(path) as store:
        kept = [int(call.prompt) for call in store.calls()]
    assert kept == list(range(len(kept)))
    assert len(kept) > used


@pytest.mark.parametrize("damage", ["text", "header", "middle"])
def test_a_damaged_store_is_told_with_how_to_mend_it(tmp_path: Path, damage: str) -> None:
    path = tmp_path / "calls.sqlite"
    with CallStore(path) as store:
        model = StoredModel(ScriptedModel(lambda _: "yes" * 2000), store)
        for number in range(50):
            model.complete(request(str(number)))
    data = bytearray(path.read_bytes())
    if damage == "text":
        data = bytearray(b"these are not the calls you are looking for" * 100)
    elif damage == "header":
        data[:64] = b"\0" * 64
    else:
        data[4096 : 4096 * 20] = b"\xff" * (4096 * 19)
    path.write_bytes(data)

    with pytest.raises(RunFolderError, match=r"calls\.sqlite: .*damaged.*move it away"):
        CallStore(path)
    assert path.read_bytes() == data


def test_other_databases_and_formats_are_refused(tmp_path: Path) -> None:
    other = tmp_path / "other.sqlite"
    connection = sqlite3.connect(other)
    connection.execute("CREATE TABLE birds (name TEXT)")
    connection.close()
    with pytest.raises(RunFolderError, match="got another database"):
        CallStore(other)

    CallStore(tmp_path / "calls.sqlite").close()
    connection = sqlite3.connect(tmp_path / "calls.sqlite")
    connection.execute("PRAGMA user_version = 99")
    connection.close()
    with pytest.raises(RunFolderError, match="format 1, got 99"):
        CallStore(tmp_path / "calls.sqlite")


def test_a_recorded_run_answers_what_it_was_asked_and_nothing_else(tmp_path: Path) -> None:
    with CallStore(tmp_path / "calls.sqlite") as store:
        StoredModel(ScriptedModel(lambda _: "yes"), store).complete(request())
    model = RecordedModel(tmp_path)
    assert model.complete(request()).text == "yes"
    with pytest.raises(RecordingError, match=r"role 'act' has no usable answer.*Never heard"):
        model.complete(request("# Never heard of it\nmore", Role.ACT))
    model.close()


def test_a_run_without_calls_cannot_be_replayed(tmp_path: Path) -> None:
    with pytest.raises(RunFolderError, match="no such file"):
        RecordedModel(tmp_path)
    assert not (tmp_path / "calls.sqlite").exists()


def failing(times: int, error: Exception) -> ScriptedModel:
    left = [times]

    def answer(_: ModelRequest) -> str:
        if left[0]:
            left[0] -= 1
            raise error
        return "yes"

    return ScriptedModel(answer)


def test_attempts_are_repeated_with_growing_waits() -> None:
    waits: list[float] = []
    model = RetryingModel(failing(6, TemporaryProviderError("busy")), sleep=waits.append)
    assert model.complete(request()).text == "yes"
    assert len(waits) == 6
    assert all(0.25 * 2**n <= wait <= 0.5 * 2**n for n, wait in enumerate(waits))


def test_the_providers_wish_to_wait_is_heeded() -> None:
    waits: list[float] = []
    busy = TemporaryProviderError("busy", retry_after=7.0)
    RetryingModel(failing(1, busy), sleep=waits.append).complete(request())
    assert 7.0 <= waits[0] <= 7.7


def test_attempts_are_bounded() -> None:
    model = RetryingModel(failing(99, TemporaryProviderError("busy")), sleep=lambda _: None)
    with pytest.raises(ModelUnavailableError, match=r"no usable answer in 12 attempts; last: busy"):
        model.complete(request())


def test_lasting_errors_are_not_repeated() -> None:
    behind = failing(99, ModelUnavailableError("gone"))
    with pytest.raises(ModelUnavailableError, match=r"^gone$"):
        RetryingModel(behind, sleep=lambda _: None).complete(request())
    assert len(behind.requests) == 1


def test_no_attempts_is_a_mistake() -> None:
    with pytest.raises(ConfigurationError, match="at least 1"):
        RetryPolicy(attempts=0)


def test_limits_on_calls_cost_and_time() -> None:
    now = [0.0]
    behind = CostlyModel(lambda _: "yes")

    def limited(limits: CallLimits) -> LimitedModel:
        return LimitedModel(behind, CallBudget(limits, clock=lambda: now[0]))

    calls = limited(CallLimits(calls=2))
    calls.complete(request())
    calls.complete(request())
    with pytest.raises(LimitReachedError, match=r"2 calls were made \(--max-calls\)"):
        calls.complete(request())

    cost = limited(CallLimits(cost=0.5))
    cost.complete(request())
    cost.complete(request())
    with pytest.raises(LimitReachedError, match=r"0\.50 dollars were spent \(--max-cost\)"):
        cost.complete(request())

    timed = limited(CallLimits(seconds=60))
    timed.complete(request())
    now[0] = 61.0
    with pytest.raises(LimitReachedError, match=r"60 seconds have passed \(--max-seconds\)"):
        timed.complete(request())

    with pytest.raises(ConfigurationError, match="max-cost"):
        CallLimits(cost=-1)


def test_served_calls_do_not_count_against_limits(store: CallStore) -> None:
    budget = CallBudget(CallLimits(calls=1))
    model = StoredModel(LimitedModel(ScriptedModel(lambda _: "yes"), budget), store)
    assert model.complete(request()).text == model.complete(request()).text == "yes"
    assert budget.calls == 1
