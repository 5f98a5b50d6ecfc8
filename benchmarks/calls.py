"""What a learned model costs in calls and tokens, by role, and what reading the replies takes.

Run: ``python -m benchmarks.calls [SEEDS]``. One burger model is learned with each seed (0 and 1 by
default) as the demo does it, by the embedded model, without a store: every call counts. Tokens are
those that the embedded model reports. A model counts as learned if nothing is left inconsistent.
"""

from __future__ import annotations

import sys
import threading
import time
from collections import Counter

from benchmarks import reading
from skillwrapper.runs.launch import learn
from skillwrapper.runs.models import open_model
from skillwrapper.runs.settings import ModelSettings
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, ModelWrapper, Role

DOMAIN = "burger"
SIZE = {"domain": DOMAIN, "iterations": 10, "exploration.budget": 30}


class CountingModel(ModelWrapper):
    """Adds up what each role asks."""

    def __init__(self, seed: int) -> None:
        super().__init__(open_model("embedded", ModelSettings(), seed, DOMAIN))
        self.calls: Counter[Role] = Counter()
        self.tokens_in: Counter[Role] = Counter()
        self.tokens_out: Counter[Role] = Counter()
        self._lock = threading.Lock()

    def complete(self, request: ModelRequest) -> ModelReply:
        reply = super().complete(request)
        with self._lock:
            self.calls[request.role] += 1
            self.tokens_in[request.role] += reply.usage.input_tokens or 0
            self.tokens_out[request.role] += reply.usage.output_tokens or 0
        return reply


def measure(seed: int) -> None:
    """Learn once and print a line for each role."""
    model, began = CountingModel(seed), time.process_time()
    figures = learn({**SIZE, "seed": seed}, model=model).figures
    print(
        f"seed {seed}: {figures.predicates} predicates, {figures.operators} operators, "
        f"{figures.inconsistencies} inconsistencies left, {time.process_time() - began:.0f} s"
    )
    for role in (*Role, None):
        totals = (model.calls, model.tokens_in, model.tokens_out)
        calls, tokens_in, tokens_out = (t[role] if role else t.total() for t in totals)
        if calls:
            print(f"  {role or 'all':10} {calls:6} calls {tokens_in:10,} in {tokens_out:9,} out")


def main(seeds: tuple[int, ...] = (0, 1)) -> None:
    """Print what learning takes, then what reading replies takes."""
    for seed in seeds:
        measure(seed)
    reading.main()


if __name__ == "__main__":
    main(tuple(map(int, sys.argv[1:])) or (0, 1))
