"""The call store: every model call with its reply, in ``calls.sqlite``."""

from __future__ import annotations

import os
import sqlite3
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Self

from skillwrapper.errors import RunFolderError
from skillwrapper.vlm.protocol import Role
from skillwrapper.vlm.stored_call import (
    COLUMNS,
    CallStatus,
    CallTotals,
    StoredCall,
    call_of,
    join_totals,
    row_of,
)

_APPLICATION_ID = 0x736B6C77  # "sklw": tells our files from other SQLite databases
_FORMAT = 1
_COUNT_EVERY = 0.2
"""Seconds; how often questions were served since then is lost in a crash."""
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
_INSERT = f"INSERT INTO calls ({COLUMNS}) VALUES ({', '.join('?' * 17)})"
_INSERT_SERVED = "INSERT INTO served (role, iteration, times) VALUES (?, ?, ?)"
_SERVED = (CallStatus.ANSWERED, CallStatus.UNUSABLE, CallStatus.PASSED_OVER)


class CallStore:
    """Keeps model calls in an SQLite file. Safe to use from several threads and processes.

    A call is in the file before its reply is used, so that a run that is killed and resumed meets
    the same replies; how often questions were served is only written now and then. Use it as a
    context manager, or close it.

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
        self._served: Counter[tuple[Role, int | None]] = Counter()
        self._last_count = time.monotonic()
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
        """What became of a call: its first answer, or else its first reply that was taken back.

        None if neither is there; refused, empty and cut-off replies are asked for again.
        """
        return self._find("key", key)

    def find_question(self, question: str) -> StoredCall | None:
        """The same for a question, whichever model was asked."""
        return self._find("question", question)

    def find_cut_off(self, key: str) -> StoredCall | None:
        """The first reply to a call that was cut off and not taken back."""
        return self._find("key", key, (CallStatus.CUT_OFF,))

    def add(self, call: StoredCall) -> None:
        """Keep a call."""
        with self._guarded() as connection, connection:
            connection.execute(_INSERT, row_of(call))

    def count_served(self, role: Role, iteration: int | None) -> None:
        """Note that a question was answered from a store."""
        with self._lock:
            self._served[role, iteration] += 1
            if time.monotonic() - self._last_count >= _COUNT_EVERY:
                self.flush()

    def mark_unusable(self, call: StoredCall) -> None:
        """Never serve the reply to a call as an answer; it is kept."""
        with self._guarded() as connection, connection:
            connection.execute(
                "UPDATE calls SET status = ? WHERE key = ? AND status = ? AND reply = ?",
                (call.status.after_taking_back, call.key, call.status, call.reply),
            )

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
            rows = connection.execute(
                f"SELECT {COLUMNS} FROM calls WHERE {condition} ORDER BY number",
                tuple(chosen.values()),
            ).fetchall()
            with _as_damage():
                return iter([call_of(row) for row in rows])

    def totals(self) -> tuple[CallTotals, ...]:
        """What the calls took, by iteration and role."""
        with self._guarded() as connection:
            self.flush()
            made = connection.execute(_TOTALS, (CallStatus.ANSWERED,)).fetchall()
            served = connection.execute(
                "SELECT role, iteration, SUM(times) FROM served GROUP BY role, iteration"
            ).fetchall()
            taken_over = connection.execute(
                "SELECT role, iteration, COUNT(*) FROM calls WHERE shared GROUP BY role, iteration"
            ).fetchall()
            with _as_damage():
                return join_totals(made, served, taken_over)

    def flush(self) -> None:
        """Write what was gathered."""
        with self._guarded() as connection:
            if not self._served:
                return
            rows = [(role, iteration, times) for (role, iteration), times in self._served.items()]
            with connection:
                connection.executemany(_INSERT_SERVED, rows)
            self._served.clear()
            self._last_count = time.monotonic()

    def close(self) -> None:
        """Write what was gathered and close the file; may be called twice."""
        with self._lock:
            if self._served:
                self.flush()
            self._connection.close()

    def _find(
        self, column: str, value: str, statuses: Sequence[CallStatus] = _SERVED
    ) -> StoredCall | None:
        places = ", ".join("?" * len(statuses))
        with self._guarded() as connection:
            row = connection.execute(
                f"SELECT {COLUMNS} FROM calls WHERE {column} = ? AND status IN ({places})"
                " ORDER BY status <> ?, number LIMIT 1",
                (value, *statuses, CallStatus.ANSWERED),
            ).fetchone()
            with _as_damage():
                return call_of(row) if row else None

    def _open(self) -> sqlite3.Connection:
        if self._read_only and not self.path.is_file():
            raise RunFolderError(f"{self.path}: expected a call store, got no such file")
        with self._translated():
            if not self._read_only:
                return self._connect("")
            try:
                return self._connect("?mode=ro")
            except sqlite3.OperationalError:
                # SQLite wants to write beside the file even for reading; on read-only media it
                # has to be told that nobody else will, which is true if no journal is left open.
                journal = self.path.with_name(f"{self.path.name}-wal")
                if os.access(self.path.parent, os.W_OK) or _size(journal) > 0:
                    raise
                return self._connect("?immutable=1")

    def _connect(self, parameters: str) -> sqlite3.Connection:
        uri = f"{self.path.absolute().as_uri()}{parameters}"
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


@contextmanager
def _as_damage() -> Iterator[None]:
    """Rows that hold something else than calls are damage of the file."""
    try:
        yield
    except (ValueError, TypeError) as error:
        raise sqlite3.DatabaseError(f"a call cannot be read: {error}") from error


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


def _size(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0
