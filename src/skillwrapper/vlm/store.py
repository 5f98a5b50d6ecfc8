"""The call store: every model call with its reply, in ``calls.sqlite``."""

from __future__ import annotations

import json
import sqlite3
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from skillwrapper.errors import RunFolderError
from skillwrapper.vlm.protocol import Role, Usage

_APPLICATION_ID = 0x736B6C77  # "sklw": tells our files from other SQLite databases
_FORMAT = 1
_COMMIT_EVERY = 0.2
"""Seconds; what was answered since the last commit is lost in a crash, and asked again."""
_LARGEST_CHECKED = 256 * 1024 * 1024

_SCHEMA = """
CREATE TABLE IF NOT EXISTS calls (
    number INTEGER PRIMARY KEY,
    key TEXT NOT NULL,
    question TEXT NOT NULL,
    status TEXT NOT NULL,
    shared INTEGER NOT NULL,
    role TEXT NOT NULL,
    iteration INTEGER,
    model TEXT NOT NULL,
    parameters TEXT NOT NULL,
    repetition INTEGER NOT NULL,
    system TEXT NOT NULL,
    prompt TEXT NOT NULL,
    pictures TEXT NOT NULL,
    reply TEXT NOT NULL,
    input_tokens INTEGER,
    output_tokens INTEGER,
    cost REAL,
    seconds REAL NOT NULL
);
CREATE INDEX IF NOT EXISTS calls_by_key ON calls (key);
CREATE INDEX IF NOT EXISTS calls_by_question ON calls (question);
CREATE TABLE IF NOT EXISTS served (
    role TEXT NOT NULL,
    iteration INTEGER,
    times INTEGER NOT NULL
);
"""
_COLUMNS = (
    "key, question, status, shared, role, iteration, model, parameters, repetition, system,"
    " prompt, pictures, reply, input_tokens, output_tokens, cost, seconds"
)
_INSERT = f"INSERT INTO calls ({_COLUMNS}) VALUES ({', '.join('?' * 17)})"


class CallStatus(StrEnum):
    """What became of a call; only what is answered is ever served again."""

    ANSWERED = "answered"
    REFUSED = "refused"
    EMPTY = "empty"
    UNUSABLE = "unusable"


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
        served: questions that were answered from a store instead.
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


class CallStore:
    """Keeps model calls in an SQLite file. Safe to use from several threads and processes.

    New calls are gathered for a moment and written together; between writes the file is not
    locked. Use it as a context manager, or close it.

    Args:
        path: the file; made if it does not exist.
        read_only: refuse to write, and do not make the file.

    Raises:
        RunFolderError: if the file is damaged, of another format, or no call store.
    """

    def __init__(self, path: Path, *, read_only: bool = False) -> None:
        self.path = path
        self._read_only = read_only
        self._lock = threading.RLock()
        self._pending: list[StoredCall] = []
        self._pending_served: list[tuple[Role, int | None]] = []
        self._last_commit = time.monotonic()
        self._connection = self._open()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def find(self, key: str) -> StoredCall | None:
        """The first answered call with a key; None if there is none."""
        return self._find("key", key)

    def find_question(self, question: str) -> StoredCall | None:
        """The first answered call with a question, whichever model was asked."""
        return self._find("question", question)

    def find_unusable(self, question: str) -> StoredCall | None:
        """The first reply to a question that could not be read; for replays, never an answer."""
        return self._find("question", question, CallStatus.UNUSABLE)

    def add(self, call: StoredCall) -> None:
        """Keep a call."""
        with self._lock:
            self._pending.append(call)
            self._commit_if_due()

    def count_served(self, role: Role, iteration: int | None) -> None:
        """Note that a question was answered from a store."""
        with self._lock:
            self._pending_served.append((role, iteration))
            self._commit_if_due()

    def mark_unusable(self, key: str) -> None:
        """Never serve the replies to a call again; they are kept."""
        with self._guarded() as connection:
            self.flush()
            connection.execute(
                "UPDATE calls SET status = ? WHERE key = ? AND status = ?",
                (CallStatus.UNUSABLE, key, CallStatus.ANSWERED),
            )
            connection.commit()

    def calls(
        self,
        *,
        role: Role | None = None,
        iteration: int | None = None,
        status: CallStatus | None = None,
    ) -> Iterator[StoredCall]:
        """The calls in the order in which they were made, all or of one kind."""
        wanted = {"role": role, "iteration": iteration, "status": status}
        chosen = {name: value for name, value in wanted.items() if value is not None}
        condition = " AND ".join(f"{name} = ?" for name in chosen) or "1"
        with self._guarded() as connection:
            self.flush()
            rows = connection.execute(
                f"SELECT {_COLUMNS} FROM calls WHERE {condition} ORDER BY number",
                tuple(chosen.values()),
            ).fetchall()
        return map(_call_of, rows)

    def totals(self) -> tuple[CallTotals, ...]:
        """What the calls took, by iteration and role."""
        with self._guarded() as connection:
            self.flush()
            made = connection.execute(_TOTALS, (CallStatus.ANSWERED,)).fetchall()
            served = connection.execute(
                "SELECT role, iteration, SUM(times) FROM served GROUP BY role, iteration"
            ).fetchall()
        return _join_totals(made, served)

    def flush(self) -> None:
        """Write what was gathered."""
        with self._guarded() as connection:
            if not (self._pending or self._pending_served):
                return
            connection.executemany(_INSERT, map(_row_of, self._pending))
            connection.executemany(
                "INSERT INTO served (role, iteration, times) VALUES (?, ?, 1)",
                self._pending_served,
            )
            connection.commit()
            self._pending.clear()
            self._pending_served.clear()
            self._last_commit = time.monotonic()

    def close(self) -> None:
        """Write what was gathered and close the file; may be called twice."""
        with self._lock:
            if not self._read_only and (self._pending or self._pending_served):
                self.flush()
            self._connection.close()

    def _find(
        self, column: str, value: str, status: CallStatus = CallStatus.ANSWERED
    ) -> StoredCall | None:
        with self._guarded() as connection:
            for call in self._pending:
                if getattr(call, column) == value and call.status is status:
                    return call
            row = connection.execute(
                f"SELECT {_COLUMNS} FROM calls WHERE {column} = ? AND status = ?"
                " ORDER BY number LIMIT 1",
                (value, status),
            ).fetchone()
        return _call_of(row) if row else None

    def _commit_if_due(self) -> None:
        if time.monotonic() - self._last_commit >= _COMMIT_EVERY:
            self.flush()

    def _open(self) -> sqlite3.Connection:
        if self._read_only and not self.path.is_file():
            raise RunFolderError(f"{self.path}: expected a call store, got no such file")
        with self._translated():
            uri = f"{self.path.absolute().as_uri()}{'?mode=ro' if self._read_only else ''}"
            connection = sqlite3.connect(uri, uri=True, timeout=30, check_same_thread=False)
            try:
                self._prepare(connection)
            except BaseException:
                connection.close()
                raise
        return connection

    def _prepare(self, connection: sqlite3.Connection) -> None:
        """Make the tables of a new file, or check those of an old one."""
        if self.path.stat().st_size <= _LARGEST_CHECKED:
            verdict = connection.execute("PRAGMA quick_check(1)").fetchone()[0]
            if verdict != "ok":
                raise sqlite3.DatabaseError(str(verdict))
        tables = connection.execute("SELECT COUNT(*) FROM sqlite_master").fetchone()[0]
        if not tables and not self._read_only:
            connection.execute("PRAGMA journal_mode = WAL")
            connection.executescript(
                f"BEGIN IMMEDIATE; PRAGMA application_id = {_APPLICATION_ID};"
                f" PRAGMA user_version = {_FORMAT}; {_SCHEMA} COMMIT;"
            )
        connection.execute("PRAGMA synchronous = NORMAL")
        application = connection.execute("PRAGMA application_id").fetchone()[0]
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        if application != _APPLICATION_ID:
            raise RunFolderError(f"{self.path}: expected a call store, got another database")
        if version != _FORMAT:
            raise RunFolderError(
                f"{self.path}: expected a call store of format {_FORMAT}, got {version}; "
                "use the version of skillwrapper that made it"
            )

    @contextmanager
    def _guarded(self) -> Iterator[sqlite3.Connection]:
        with self._lock, self._translated():
            yield self._connection

    @contextmanager
    def _translated(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.OperationalError as error:
            raise RunFolderError(
                f"{self.path}: the call store cannot be used ({_one_line(error)})"
            ) from error
        except sqlite3.DatabaseError as error:
            raise RunFolderError(
                f"{self.path}: the call store is damaged ({_one_line(error)}); mend it with "
                f"'sqlite3 {self.path.name} .recover | sqlite3 mended.sqlite' and put the mended "
                "file in its place, or move it away: then everything is asked again"
            ) from error


_TOTALS = """
SELECT role, iteration, COUNT(*), SUM(status <> ?),
    CASE WHEN COUNT(input_tokens) = COUNT(*) THEN SUM(input_tokens) END,
    CASE WHEN COUNT(output_tokens) = COUNT(*) THEN SUM(output_tokens) END,
    CASE WHEN COUNT(cost) = COUNT(*) THEN SUM(cost) END,
    SUM(seconds)
FROM calls WHERE NOT shared GROUP BY role, iteration
"""


def _join_totals(made: list[Any], served: list[Any]) -> tuple[CallTotals, ...]:
    totals: dict[tuple[str, int | None], CallTotals] = {}
    for role, iteration, calls, failed, tokens_in, tokens_out, cost, seconds in made:
        totals[role, iteration] = CallTotals(
            Role(role), iteration, calls, 0, failed, tokens_in, tokens_out, cost, seconds
        )
    for role, iteration, times in served:
        known = totals.get((role, iteration), CallTotals(Role(role), iteration))
        totals[role, iteration] = replace(known, served=times)
    roles = list(Role)
    return tuple(sorted(totals.values(), key=lambda t: (t.iteration or 0, roles.index(t.role))))


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


def _row_of(call: StoredCall) -> tuple[Any, ...]:
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


def _call_of(row: tuple[Any, ...]) -> StoredCall:
    key, question, status, shared, role, iteration, model, parameters, repetition = row[:9]
    system, prompt, pictures, reply, tokens_in, tokens_out, cost, seconds = row[9:]
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
