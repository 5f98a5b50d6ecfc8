"""Replies that end at the output limit: asked for again once, then a limit must be raised."""

from __future__ import annotations

from collections import Counter

from skillwrapper.errors import ReplyCutOffError
from skillwrapper.vlm.protocol import (
    OUTPUT_LIMIT,
    ModelReply,
    ModelRequest,
    Role,
    VisionLanguageModel,
)

CUT_OFF_PROBLEM = "it was cut off at the output limit; think less and answer in fewer words"
"""What the model is told when it is asked again."""


class CutOffs:
    """Counts the replies to one question that were cut off."""

    def __init__(self) -> None:
        self._times: Counter[Role] = Counter()

    def check(self, model: VisionLanguageModel, request: ModelRequest, reply: ModelReply) -> bool:
        """Whether a reply was cut off, for the first time.

        Raises:
            ReplyCutOffError: if one was cut off before.
        """
        if not reply.cut_off:
            return False
        self._times[request.role] += 1
        if self._times[request.role] > 1:
            raise ReplyCutOffError(_advice(model, request.role, reply))
        return True


def _advice(model: VisionLanguageModel, role: Role, reply: ModelReply) -> str:
    limit, tokens = model.parameters.get(OUTPUT_LIMIT), reply.usage.output_tokens
    after = f" after {tokens} tokens" if tokens is not None else ""
    raise_it = f"raise --max-output-tokens, now {limit}" if limit else "set --max-output-tokens"
    return (
        f"{model.name}: replies of the role '{role}' were cut off at the output limit twice"
        f"{after}; {raise_it} (reasoning counts too), or raise the limit of the server: "
        "--max-model-len of vLLM, num_ctx of Ollama, --ctx-size and --n-predict of llama.cpp"
    )
