"""The embedded model behind HTTP answers as it does directly, whatever goes wrong on the way."""

from __future__ import annotations

import time

import pytest
from seen_kitchen import EXPERT, embedded_model, kitchen

from skillwrapper.embedded.server import SEEING, ServerSettings, VlmServer
from skillwrapper.embedded.server_faults import FaultPlan
from skillwrapper.exploration.questions import ProposalQuestion
from skillwrapper.invention.questions import InventionQuestion
from skillwrapper.learning.kinds import InconsistencyKind
from skillwrapper.perception.questions import EvaluationQuestion
from skillwrapper.vlm.assistant import Assistant
from skillwrapper.vlm.models import ModelSet
from skillwrapper.vlm.openai_model import OpenAIModel, OpenAISettings
from skillwrapper.vlm.protocol import VisionLanguageModel
from skillwrapper.vlm.retrying import RetryingModel, RetryPolicy
from skillwrapper.vlm.settings import AskingSettings


def ask_everything(model: VisionLanguageModel, parallel: int = 1) -> list[object]:
    world = kitchen()
    helper = Assistant(ModelSet.of(model), settings=AskingSettings(parallel=parallel))
    answers: list[object] = []
    answers += helper.evaluate(
        [
            EvaluationQuestion(world.domain, world.domain.objects, world.look(state), EXPERT)
            for state in world.sample(20)
        ]
    )
    for seed in range(6):
        first = world.find("Stack", success=True, seed=seed)
        second = world.find("Stack", success=False, seed=seed)
        skill = world.domain.skill_by_name["Stack"]
        kind = InconsistencyKind.PRECONDITION
        types = ("robot", "pickupable")
        answers.append(
            helper.invent_predicates(
                InventionQuestion(
                    world.domain, skill, kind, first, second, types, (), EXPERT[:2], (), 2
                )
            ).predicates
        )
    start = world.look(world.states[0])
    question = ProposalQuestion(
        world.domain, world.domain.objects, start, EXPERT, (), (), ("Cut",), 5, 15
    )
    answers.append(helper.propose_sequences(question).sequences)
    return answers


@pytest.mark.parametrize("faults", [0.0, 0.3])
def test_answers_are_the_same_through_the_server(faults: float) -> None:
    plan = FaultPlan(faults, retry_after=0.01, slowness=0.01)
    with VlmServer(embedded_model(5), ServerSettings(faults=plan)) as server:
        client = OpenAIModel(OpenAISettings(SEEING, base_url=server.url))
        model = RetryingModel(client, RetryPolicy(first_wait=0.001))
        assert ask_everything(model, parallel=4) == ask_everything(embedded_model(5))


def test_a_wave_takes_as_long_as_its_slowest_chain_of_calls() -> None:
    world = kitchen()
    questions = [
        EvaluationQuestion(world.domain, world.domain.objects, world.look(state), EXPERT)
        for state in world.sample(16)
    ]
    with VlmServer(embedded_model(), ServerSettings(latency=0.2)) as server:
        client = OpenAIModel(OpenAISettings(SEEING, base_url=server.url))
        helper = Assistant(ModelSet.of(client), settings=AskingSettings(parallel=8))
        helper.evaluate(questions[:1])
        began = time.perf_counter()
        helper.evaluate(questions)
        seconds = time.perf_counter() - began
    assert 0.4 <= seconds < 1.6  # 16 pictures, 8 at a time, a call each; one by one: 3.2 s
