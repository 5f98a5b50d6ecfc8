"""Replies that end at the output limit are no answers; the second one ends the matter."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from scripted import ScriptedModel, section

from skillwrapper.errors import ReplyCutOffError
from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.symbols import Predicate
from skillwrapper.usage import Usage
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, Role
from skillwrapper.vlm.recorded_model import RecordedModel
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_call import CallStatus
from skillwrapper.vlm.stored_model import StoredModel
from skillwrapper.world import Domain, Observation, Picture

IS_CUT = Predicate("is_cut", ("cuttable",), "the item is in pieces")


class RamblingModel(ScriptedModel):
    """Is cut off in the calls of some numbers, from 0."""

    cut_off_in: Callable[[int], bool] = staticmethod(lambda _: True)
    limit: int | None = None

    @property
    def parameters(self) -> dict[str, str | int | float | bool]:
        return {} if self.limit is None else {"max_output_tokens": self.limit}

    def complete(self, request: ModelRequest) -> ModelReply:
        number = len(self.requests)
        reply = super().complete(request)
        return ModelReply(reply.text, Usage(10, 512), cut_off=self.cut_off_in(number))


def rambling(cut_off_in: Callable[[int], bool], limit: int | None = None) -> RamblingModel:
    model = RamblingModel(answer)
    model.cut_off_in, model.limit = cut_off_in, limit  # type: ignore[method-assign]
    return model


def answer(request: ModelRequest) -> str:
    if request.role is Role.PROPOSE:
        return "Pick(robot, patty)\nCook(robot, patty)"
    if request.role is Role.EVALUATE:
        return "The lettuce is a whole head."
    return "\n".join(f"{atom}: true" for atom in section(request.prompt, "Statements"))


def picture() -> Observation:
    return Observation((Picture(b"a"),))


def propose(model: StoredModel | RecordedModel | RamblingModel, domain: Domain) -> int:
    question = ProposalQuestion(domain, domain.objects, picture(), (), (), (), (), 1, 2)
    return len(Assistant(ModelSet.of(model)).propose_sequences(question).sequences)


def evaluate(model: StoredModel | RecordedModel | RamblingModel, domain: Domain) -> list[bool]:
    question = EvaluationQuestion(domain, domain.objects, picture(), (IS_CUT,))
    (found,) = Assistant(ModelSet.of(model)).evaluate([question])
    return [label for label in found.labels.values() if label is not None]


def test_a_cut_off_reply_is_not_used_though_it_can_be_read(burger: Domain) -> None:
    model = rambling(lambda number: number == 0)
    assert propose(model, burger) == 1
    first, second = model.requests
    assert "cut off at the output limit" not in first.prompt
    assert "cut off at the output limit" in second.prompt


@pytest.mark.parametrize("stage", [0, 1])
def test_both_stages_of_evaluation_are_asked_again(stage: int, burger: Domain) -> None:
    model = rambling(lambda number: number == stage)
    assert evaluate(model, burger) == [True]
    assert "cut off at the output limit" in model.requests[-1].prompt


@pytest.mark.parametrize(("limit", "advice"), [(None, "set --max"), (512, "raise --max")])
def test_the_second_time_the_message_says_which_limit_to_raise(
    limit: int | None, advice: str, burger: Domain
) -> None:
    for ask in (propose, evaluate):
        model = rambling(lambda _: True, limit)
        with pytest.raises(ReplyCutOffError, match=f"{advice}-output-tokens") as caught:
            ask(model, burger)
        assert len(model.requests) == 2
        assert "512 tokens" in str(caught.value)


def test_a_run_that_goes_on_meets_the_same_replies(burger: Domain, tmp_path: Path) -> None:
    model = rambling(lambda number: number == 0)
    with CallStore(tmp_path / "calls.sqlite") as store:
        for _ in range(2):
            assert propose(StoredModel(model, store), burger) == 1
        statuses = [call.status for call in store.calls()]
    assert statuses == [CallStatus.PASSED_OVER, CallStatus.ANSWERED]
    assert len(model.requests) == 2
    recorded = RecordedModel(tmp_path)
    assert propose(recorded, burger) == 1
    recorded.close()


def test_once_the_limit_is_raised_only_the_last_question_is_asked_anew(
    burger: Domain, tmp_path: Path
) -> None:
    model = rambling(lambda number: number < 2)
    with CallStore(tmp_path / "calls.sqlite") as store:
        with pytest.raises(ReplyCutOffError):
            propose(StoredModel(model, store), burger)
        model.limit = 4096
        assert propose(StoredModel(model, store), burger) == 1
        model.limit = None
        assert propose(StoredModel(model, store), burger) == 1
    assert len(model.requests) == 3


def test_a_shared_store_passes_over_the_same_replies(burger: Domain, tmp_path: Path) -> None:
    model = rambling(lambda number: number == 0)
    with CallStore(tmp_path / "shared.sqlite") as shared:
        for name in ("a", "b"):
            with CallStore(tmp_path / name) as store:
                assert propose(StoredModel(model, store, shared), burger) == 1
    assert len(model.requests) == 2
