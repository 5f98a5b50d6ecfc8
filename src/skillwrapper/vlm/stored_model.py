"""A model whose calls are kept, and which is not asked what it has answered before."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

from skillwrapper.errors import UnusableReplyError
from skillwrapper.redaction import Redactor
from skillwrapper.usage import Usage
from skillwrapper.vlm.answers import clean_text
from skillwrapper.vlm.protocol import ModelReply, ModelRequest, ModelWrapper, VisionLanguageModel
from skillwrapper.vlm.store import CallStore
from skillwrapper.vlm.stored_call import CallStatus, StoredCall, call_key, question_key


class StoredModel(ModelWrapper):
    """Keeps every call of a model in a run's store, and serves from it.

    Args:
        model: the model that is asked what no store knows.
        store: of the run; every call is recorded here.
        shared: a store that several runs share, if any; asked second, and told what is new.
        iteration: tells the present iteration of the run.
        redactor: takes secrets out of all that is kept.
    """

    def __init__(
        self,
        model: VisionLanguageModel,
        store: CallStore,
        shared: CallStore | None = None,
        iteration: Callable[[], int | None] = lambda: None,
        redactor: Redactor | None = None,
    ) -> None:
        super().__init__(model)
        self._store, self._shared = store, shared
        self._iteration = iteration
        self._redact = (redactor or Redactor()).redact
        self._asking = _KeyedLocks()

    def complete(self, request: ModelRequest) -> ModelReply:
        """Serve what is known, or ask and record.

        A reply that was taken back is met again, marked as such: whoever asked again then does
        so now, and comes to the same answer without asking the model.

        Raises:
            ProviderError: as the model behind does; refused and empty replies are recorded.
            RunFolderError: if a store cannot be used.
        """
        key = self._key(request)
        with self._asking.hold(key):
            return self._served(key, request) or self._asked(key, request)

    def take_back(self, request: ModelRequest) -> None:
        """Record that the reply to a request was of no use."""
        key = self._key(request)
        known = self._store.find(key) or self._store.find_cut_off(key)
        if known is None or known.status.is_taken_back:
            return
        self._store.mark_unusable(known)
        if self._shared is not None:
            self._shared.mark_unusable(known)

    def _served(self, key: str, request: ModelRequest) -> ModelReply | None:
        known = self._store.find(key)
        if known is None and self._shared is not None:
            known = self._shared.find(key)
            if known is not None:
                self._store.add(replace(known, iteration=self._iteration(), shared=True))
        if known is None:
            return None
        self._store.count_served(request.role, self._iteration())
        usage = replace(known.usage, cost=0.0, seconds=0.0)
        return ModelReply(
            known.reply,
            usage,
            taken_back=known.status.is_taken_back,
            cut_off=known.status is CallStatus.PASSED_OVER,
        )

    def _asked(self, key: str, request: ModelRequest) -> ModelReply:
        try:
            reply = self._model.complete(request)
        except UnusableReplyError as error:
            status = CallStatus.REFUSED if error.kind == "refused" else CallStatus.EMPTY
            said = self._redact(clean_text(error.text))
            self._record(key, request, status, said, error.usage or Usage())
            raise
        # Used as it is kept: whoever goes on later meets the same.
        reply = replace(reply, text=self._redact(reply.text))
        status = CallStatus.CUT_OFF if reply.cut_off else CallStatus.ANSWERED
        self._record(key, request, status, reply.text, reply.usage)
        return reply

    def _record(
        self, key: str, request: ModelRequest, status: CallStatus, text: str, usage: Usage
    ) -> None:
        call = StoredCall(
            key=key,
            question=question_key(request),
            status=status,
            role=request.role,
            iteration=self._iteration(),
            model=self.name,
            parameters=json.dumps(dict(self.parameters), sort_keys=True),
            repetition=request.repetition,
            system=self._redact(request.system),
            prompt=self._redact(request.prompt),
            pictures=tuple(picture.sha256 for picture in request.pictures),
            reply=text,
            usage=usage,
        )
        self._store.add(call)
        if self._shared is not None and status in {CallStatus.ANSWERED, CallStatus.CUT_OFF}:
            self._shared.add(replace(call, iteration=None))

    def _key(self, request: ModelRequest) -> str:
        return call_key(self.name, self.parameters, request)


class _KeyedLocks:
    """One lock for every key in use: the same question in flight twice is asked once."""

    def __init__(self) -> None:
        self._guard = threading.Lock()
        self._locks: dict[str, tuple[threading.Lock, int]] = {}

    @contextmanager
    def hold(self, key: str) -> Iterator[None]:
        with self._guard:
            lock, users = self._locks.get(key, (threading.Lock(), 0))
            self._locks[key] = lock, users + 1
        try:
            with lock:
                yield
        finally:
            with self._guard:
                lock, users = self._locks.pop(key)
                if users > 1:
                    self._locks[key] = lock, users - 1
