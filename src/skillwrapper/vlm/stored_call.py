"""What the call store keeps of every call: its identity, what became of it, what it took."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

from skillwrapper.usage import Usage
from skillwrapper.vlm.protocol import OUTPUT_LIMIT, ModelRequest, Role

COLUMNS = (
    "key, question, status, shared, role, iteration, model, parameters, repetition, system,"
    " prompt, pictures, reply, input_tokens, output_tokens, cost, seconds"
)
"""The columns of a call, in the order of its row."""


class CallStatus(StrEnum):
    """What became of a call; only what is answered is ever served as an answer.

    Cut-off replies are asked for again, unless one was passed over: then who asked has gone on with
    the next repetition, and does so again.
    """

    ANSWERED = "answered"
    REFUSED = "refused"
    EMPTY = "empty"
    UNUSABLE = "unusable"
    CUT_OFF = "cut-off"
    PASSED_OVER = "cut-off-passed-over"

    @property
    def is_taken_back(self) -> bool:
        """Whether the reply is met again, though never as an answer."""
        return self in {CallStatus.UNUSABLE, CallStatus.PASSED_OVER}

    @property
    def after_taking_back(self) -> CallStatus:
        """What becomes of a call whose reply is of no use."""
        return CallStatus.PASSED_OVER if self is CallStatus.CUT_OFF else CallStatus.UNUSABLE


@dataclass(frozen=True)
class StoredCall:
    """One call as it is kept.

    Attributes:
        key: identity of the call, model and settings included.
        question: identity of what was asked, whichever model was asked.
        status: what became of it.
        role: what it was for.
        iteration: of the run; None outside of the iterations.
        model: provider and model.
        parameters: settings of the model, as JSON.
        repetition: number of the repetition.
        system: system prompt.
        prompt: user prompt.
        pictures: SHA-256 of the pictures, in their order.
        reply: the text of the reply, may be empty.
        usage: what the call took.
        shared: whether the reply came from the store that several runs share.
    """

    key: str
    question: str
    status: CallStatus
    role: Role
    iteration: int | None
    model: str
    parameters: str
    repetition: int
    system: str
    prompt: str
    pictures: tuple[str, ...]
    reply: str
    usage: Usage
    shared: bool = False


@dataclass(frozen=True)
class CallTotals:
    """What the calls of one role took in one iteration.

    Attributes:
        role: what the calls were for.
        iteration: of the run; None outside of the iterations.
        made: calls that a model was asked.
        served: how often questions were answered from a store instead; those that a run which goes
            on meets again count too.
        taken_over: calls whose replies other runs had got; part of what was served.
        failed: calls that were made and brought nothing usable.
        input_tokens: of all calls made; None if any is unknown.
        output_tokens: of all calls made; None if any is unknown.
        cost: in US dollars, of all calls made; None if any is unknown.
        seconds: added up over all calls made.
    """

    role: Role
    iteration: int | None
    made: int = 0
    served: int = 0
    failed: int = 0
    input_tokens: int | None = 0
    output_tokens: int | None = 0
    cost: float | None = 0.0
    seconds: float = 0.0
    taken_over: int = 0

    @property
    def asked(self) -> int:
        """Calls that were needed, whoever made them; the same if the run was interrupted."""
        return self.made + self.taken_over


def question_key(request: ModelRequest) -> str:
    """SHA-256 of what is asked, whichever model is asked: role, prompts, pictures, repetition."""
    parts = {
        "role": str(request.role),
        "system": request.system,
        "prompt": request.prompt,
        "pictures": [[picture.camera, picture.sha256] for picture in request.pictures],
        "repetition": request.repetition,
    }
    return _digest(parts)


def call_key(
    model: str, parameters: Mapping[str, str | int | float | bool], request: ModelRequest
) -> str:
    """SHA-256 of what is asked, of whom, and with which settings that change what an answer says.

    A limit on the output does not: an answer that it does not reach is the same under a higher one.
    """
    parts = {
        "model": model,
        "parameters": {n: value for n, value in parameters.items() if n != OUTPUT_LIMIT},
        "question": question_key(request),
    }
    return _digest(parts)


def row_of(call: StoredCall) -> tuple[Any, ...]:
    """A call as the store writes it."""
    return (
        call.key,
        call.question,
        call.status,
        call.shared,
        call.role,
        call.iteration,
        call.model,
        call.parameters,
        call.repetition,
        call.system,
        call.prompt,
        json.dumps(call.pictures),
        call.reply,
        call.usage.input_tokens,
        call.usage.output_tokens,
        call.usage.cost,
        call.usage.seconds,
    )


def call_of(row: Sequence[Any]) -> StoredCall:
    """A call from its row.

    Raises:
        ValueError: if the row holds something else.
    """
    key, question, status, shared, role, iteration, model, parameters, repetition = row[:9]
    system, prompt, pictures, reply, tokens_in, tokens_out, cost, seconds = row[9:]
    texts = (key, question, status, role, model, parameters, system, prompt, pictures, reply)
    numbers = (iteration, repetition, tokens_in, tokens_out, cost, seconds)
    if not all(isinstance(text, str) for text in texts):
        raise ValueError("expected text")
    if not all(number is None or isinstance(number, int | float) for number in numbers):
        raise ValueError("expected numbers")
    return StoredCall(
        key=key,
        question=question,
        status=CallStatus(status),
        role=Role(role),
        iteration=iteration,
        model=model,
        parameters=parameters,
        repetition=repetition,
        system=system,
        prompt=prompt,
        pictures=tuple(json.loads(pictures)),
        reply=reply,
        usage=Usage(tokens_in, tokens_out, cost, seconds),
        shared=bool(shared),
    )


def join_totals(
    made: Iterable[Sequence[Any]],
    served: Iterable[Sequence[Any]],
    taken_over: Iterable[Sequence[Any]],
) -> tuple[CallTotals, ...]:
    """Totals by iteration and role, from what was added up of each kind of call."""
    totals: dict[tuple[str, int | None], CallTotals] = {}
    for role, iteration, calls, failed, tokens_in, tokens_out, cost, seconds in made:
        totals[role, iteration] = CallTotals(
            Role(role), iteration, calls, 0, failed, tokens_in, tokens_out, cost, seconds
        )
    for name, counts in (("served", served), ("taken_over", taken_over)):
        for role, iteration, times in counts:
            known = totals.get((role, iteration), CallTotals(Role(role), iteration))
            totals[role, iteration] = replace(known, **{name: times})
    roles = list(Role)
    return tuple(sorted(totals.values(), key=lambda t: (t.iteration or 0, roles.index(t.role))))


def _digest(parts: Mapping[str, object]) -> str:
    text = json.dumps(parts, sort_keys=True, ensure_ascii=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()
