"""The SQLite file of attempts: what `AttemptFile.add` has returned from is on the disk.

Every operation opens the file and closes it, so several windows and threads may use it, and a file that was set aside
is not written to any more. Writing takes a lock beside the file; the system releases it when its process ends.
"""

import os
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from time import monotonic, sleep
from typing import Any

from pydantic import ValidationError

from lessons.attempts.record import COLUMNS, NOT_CHECKED, VERSION, Attempt, attempt_row, is_name
from lessons.os_errors import os_error_reason

FILE_NAME = "attempts.sqlite"
APPLICATION = 0x52415354
"""The application of the file's header: RAST."""
SECONDS_TO_WAIT = 10.0
"""For another window that is writing."""
PAUSE = 0.005
"""Seconds between two looks whether it has ended."""
TABLE = """CREATE TABLE attempts (
    user TEXT NOT NULL,
    at TEXT NOT NULL,
    template TEXT NOT NULL,
    version INTEGER NOT NULL,
    seed INTEGER NOT NULL,
    stage TEXT NOT NULL,
    asked TEXT NOT NULL,
    answer TEXT NOT NULL,
    verdict TEXT NOT NULL,
    score REAL NOT NULL,
    points REAL NOT NULL,
    most INTEGER NOT NULL,
    mistakes TEXT NOT NULL,
    is_slip INTEGER NOT NULL,
    seconds REAL NOT NULL,
    UNIQUE (user, at, template, version, seed, answer)
)"""
"""``at`` as in 2026-11-23T08:00:00.000000Z, so that texts are in the order of time; names of mistakes are separated by
spaces."""
_JUDGED = ("stage", "asked", "verdict", "score", "points", "most", "mistakes", "is_slip")
"""Columns that a judgement fills."""
_INSERT = (
    f"INSERT INTO attempts ({', '.join(COLUMNS)}) VALUES ({', '.join('?' * len(COLUMNS))}) "
    "ON CONFLICT (user, at, template, version, seed, answer) DO UPDATE SET "
    f"{', '.join(f'{name} = excluded.{name}' for name in _JUDGED)} "
    f"WHERE attempts.verdict LIKE '{NOT_CHECKED}%' AND excluded.verdict NOT LIKE '{NOT_CHECKED}%'"
)
"""What is there stays, but for an attempt that could not be checked when it came and now is."""
_REASONS = {sqlite3.SQLITE_FULL: "the disk is full", sqlite3.SQLITE_BUSY: "another window is writing to it"}
_REFUSED = (sqlite3.SQLITE_READONLY, sqlite3.SQLITE_PERM, sqlite3.SQLITE_CANTOPEN)
"""The system refused the file: it knows why."""


class AttemptFileError(OSError):
    """Attempts cannot be read or saved; the message is one sentence that names the file."""


class DamagedFileError(AttemptFileError):
    """The file of attempts was truncated, altered, or is another file."""


@dataclass(frozen=True)
class AttemptFile:
    """A file of attempts; it may not exist yet."""

    path: Path

    def check(self) -> str:
        """Look at the whole file; begin one where there is none, and set aside one that is damaged as a whole.

        Returns
        -------
        str
            What to tell the user, in sentences; empty if all is well.

        Raises
        ------
        AttemptFileError
            If it cannot be read or begun, or is one of a later version, which is left alone.
        """
        with self._alone():
            return self._checked()

    def add(self, attempt: Attempt) -> str:
        """Save one attempt, so that neither the end of the process nor that of the machine loses it.

        Returns
        -------
        str
            What to tell the user, as `check` does: a damaged file is set aside first.

        Raises
        ------
        AttemptFileError
            If it is not saved; what was saved before is unchanged. It may be tried again.
        """
        with self._alone():
            told = "" if self.path.exists() else self._checked()
            try:
                self._insert([attempt])
            except DamagedFileError:
                told = self._checked()
                self._insert([attempt])
            return told

    def add_all(self, attempts: Iterable[Attempt]) -> int:
        """Save attempts, all or none; errors as `add`. Returns how many were not there, or not checked, before."""
        with self._alone():
            if not self.path.exists():
                self._checked()
            return self._insert(attempts)

    def attempts(self, user: str | None = None) -> tuple[Attempt, ...]:
        """Return the attempts of a user, or of all, in the order of time; AttemptFileError if they cannot be read.

        A row that holds no attempt is left out; `left_out` tells of such.
        """
        return tuple(each for each in self._rows(user) if each is not None)

    def left_out(self) -> str:
        """Return a sentence about rows that hold no attempt; empty: there are none."""
        count = self._rows(None).count(None)
        if not count:
            return ""
        are = "1 answer cannot be read and is" if count == 1 else f"{count} answers cannot be read and are"
        return f"{self.path}: {are} left out. The others are unchanged."

    def users(self) -> tuple[str, ...]:
        """Return the names of all users; errors as `attempts`."""
        if not self.path.exists():
            return ()
        with self._opened() as connection:
            users = [user for (user,) in connection.execute("SELECT DISTINCT user FROM attempts ORDER BY 1")]
        return tuple(user for user in users if is_name(user))

    def _rows(self, user: str | None) -> list[Attempt | None]:
        """Return the attempts of a user, or of all; ``None`` for a row that holds none."""
        if not self.path.exists():
            return []
        query = f"SELECT {', '.join(COLUMNS)} FROM attempts WHERE user = ? OR ? IS NULL ORDER BY at, rowid"
        with self._opened() as connection:
            return [_attempt_of_row(row) for row in connection.execute(query, (user, user))]

    def _insert(self, attempts: Iterable[Attempt]) -> int:
        with self._opened() as connection:
            connection.execute("BEGIN IMMEDIATE")
            added = connection.executemany(_INSERT, map(_row_of_attempt, attempts)).rowcount
            connection.execute("COMMIT")
        return max(added, 0)

    def _checked(self) -> str:
        """Do what `check` does, alone."""
        if not self.path.exists():
            self._replace()
            return ""
        try:
            with self._opened() as connection:
                (found,) = connection.execute("PRAGMA quick_check(1)").fetchone()
            if found == "ok":
                return self.left_out()
        except DamagedFileError:
            pass
        kept = self._replace()
        return f"{self.path} was truncated or altered. It is kept as {kept}, and a new file was begun."

    def _replace(self) -> str:
        """Begin a file; one that is there, and what belongs to it, get another name, which is returned."""
        new = self.path.with_name(f"{self.path.name}.new")
        kept = next(
            name
            for number in count(1)
            if not os.path.lexists(self.path.with_name(name := f"{self.path.name}.broken-{number}"))
        )
        new.unlink(missing_ok=True)
        with self._connected(new, "rwc") as connection:
            for statement in (
                f"PRAGMA application_id = {APPLICATION}",
                f"PRAGMA user_version = {VERSION}",
                TABLE,
            ):
                connection.execute(statement)
        # The journal of another file would be played back into the new one.
        for ending in ("-journal", "-wal", "-shm", ""):
            old = self.path.with_name(self.path.name + ending)
            if os.path.lexists(old):
                os.replace(old, self.path.with_name(kept + ending))
        os.replace(new, self.path)
        return kept

    @contextmanager
    def _alone(self) -> Iterator[None]:
        """Keep other windows from writing; they wait."""
        lock = self.path.with_name(f"{self.path.name}.lock")
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            lock.touch()  # The system says why it cannot; SQLite does not.
            with self._connected(lock, "rwc") as connection:
                _lock(connection)
                yield
        except AttemptFileError:
            raise
        except OSError as problem:
            raise AttemptFileError(f"{self.path} cannot be written: {os_error_reason(problem)}") from problem

    @contextmanager
    def _opened(self) -> Iterator[sqlite3.Connection]:
        """Open the file, if it is one of this version."""
        with self._connected(self.path, "rw") as connection:
            (version,) = connection.execute("PRAGMA user_version").fetchone()
            (application,) = connection.execute("PRAGMA application_id").fetchone()
            if application == APPLICATION and version > VERSION:
                raise AttemptFileError(
                    f"{self.path} was written by a later version of the program: "
                    f"its version is {version}, this one reads {VERSION}. It is left alone"
                )
            statements = connection.execute("SELECT sql FROM sqlite_master WHERE sql IS NOT NULL").fetchall()
            if (application, version, statements) != (APPLICATION, VERSION, [(TABLE,)]):
                raise DamagedFileError(f"{self.path} is no file of attempts")
            # After a commit, the folder is written too: its entry of the journal must be gone.
            connection.execute("PRAGMA synchronous = EXTRA")
            yield connection

    @contextmanager
    def _connected(self, path: Path, mode: str) -> Iterator[sqlite3.Connection]:
        address = f"{path.absolute().as_uri()}?mode={mode}"
        try:
            with closing(
                sqlite3.connect(address, timeout=SECONDS_TO_WAIT, isolation_level=None, uri=True)
            ) as connection:
                # A byte that is no UTF-8 makes one row unreadable, not the file.
                connection.text_factory = lambda text: text.decode("utf-8", "surrogateescape")
                yield connection
        except sqlite3.Error as problem:
            code = getattr(problem, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
            if code in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB):
                raise DamagedFileError(f"{self.path} is damaged: {problem}") from problem
            reason = _REASONS.get(code, str(problem))
            if code in _REFUSED:
                reason = _refusal(path) or "its folder cannot be written to"
            raise AttemptFileError(f"{self.path} cannot be read or written: {reason}") from problem


def _refusal(path: Path) -> str:
    """Return why the system lets nobody write to a file, as the end of a sentence; empty: it does."""
    try:
        with path.open("r+b"):
            return ""
    except OSError as problem:
        return os_error_reason(problem)


def _lock(connection: sqlite3.Connection) -> None:
    """Take the lock, asking often: SQLite's own waiting sleeps longer and longer, and finds no gap for seconds."""
    connection.execute("PRAGMA busy_timeout = 0")
    end = monotonic() + SECONDS_TO_WAIT
    while True:
        try:
            connection.execute("BEGIN EXCLUSIVE")
        except sqlite3.OperationalError as problem:
            if problem.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY or monotonic() > end:
                raise
            sleep(PAUSE)
        else:
            return


def _row_of_attempt(attempt: Attempt) -> tuple[Any, ...]:
    return tuple(attempt_row(attempt).values())


def _attempt_of_row(row: tuple[Any, ...]) -> Attempt | None:
    values = dict(zip(COLUMNS, row, strict=True))
    values |= {name: tuple(str(values[name]).split()) for name in ("asked", "mistakes")}
    try:
        return Attempt(**values)
    except ValidationError:
        return None
