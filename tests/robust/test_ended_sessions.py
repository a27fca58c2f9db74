"""However a session of edits ends, the next start has the last edit, or one that is at most three seconds older."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from threading import Thread

import pytest

from app.files.open_any import open_any
from app.window.start import Reopened, reopen

PROGRAM = Path(__file__).with_name("edited_session.py")
SECONDS = 3.0
"""How old an edit may be that a killed program has lost."""
CLOSING = ("SIGTERM", "SIGHUP", "SIGINT")
SEED = 20

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")


class EditedSession:
    """A running program, and the edits that it has made, each with its time."""

    def __init__(self, first: int, scene: str = "") -> None:
        environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
        self.process = subprocess.Popen(
            [sys.executable, str(PROGRAM), str(first), scene],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=environment,
        )
        self.edits: list[tuple[int, float]] = []
        self.listener = Thread(target=self.listen, daemon=True)
        self.listener.start()

    def listen(self) -> None:
        for line in self.process.stdout:
            self.edits.append((int(line), time.monotonic()))

    def wait_for_edits(self, count: int) -> None:
        while len(self.edits) < count:
            assert self.process.poll() is None, self.process.stderr.read()
            time.sleep(0.01)

    def end(self, name: str, times: int = 1) -> int:
        """Send a signal, or one after the other; return the last edit that must not be lost."""
        at = time.monotonic()
        for _ in range(times):
            self.process.send_signal(getattr(signal, name))
        try:
            self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.send_signal(signal.SIGABRT)  # It tells what each of its threads is at.
            pytest.fail(f"{name} after edit {self.edits[-1][0]}: {self.process.stderr.read()}")
        self.listener.join()
        with self.process.stderr, self.process.stdout:
            assert self.process.stderr.read() == ""
        number = getattr(signal, name)
        assert self.process.returncode == (-number if name == "SIGKILL" else 128 + number)
        if name in CLOSING:
            return self.edits[-1][0]
        return max([number for number, done in self.edits if done < at - SECONDS], default=-1)


def number_of(reopened: Reopened) -> int:
    """Return the number of the last edit that the next start has, offered or open; -1: none."""
    document = open_any(reopened.offered).document if reopened.offered else reopened.opened.document
    if reopened.file is not None:
        reopened.file.release()
    return int(document.title.removeprefix("edit ")) if document.title.startswith("edit ") else -1


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "config"))
    return tmp_path / "config"


@pytest.mark.slow
def test_a_program_that_is_asked_to_end_saves_first_and_goes_on_at_the_next_start(folder: Path) -> None:
    session = EditedSession(0)
    session.wait_for_edits(2)
    last = session.end("SIGTERM", times=3)
    found = reopen()
    assert (found.message, number_of(found)) == (None, last)
    assert not list(folder.glob(".*.part"))


def test_what_was_saved_before_a_program_is_killed_is_offered(folder: Path) -> None:
    session = EditedSession(0, "sphere")
    while not list(folder.glob("last*.rasterscope")):
        assert session.process.poll() is None
        time.sleep(0.02)
    session.end("SIGKILL")
    found = reopen()
    assert found.message.text.startswith("Rasterscope ended without closing its window (edit ")
    assert found.message.action == "Restore"
    assert found.opened.document.title == "Single triangle"
    assert number_of(found) >= 0
    assert reopen().offered == "", "it is offered once, and opened then"


@pytest.mark.slow
def test_fifty_sessions_that_end_at_random_moments(folder: Path) -> None:
    chance = random.Random(SEED)
    first, at_least = 0, -1
    for turn in range(50):
        name = chance.choice(("SIGKILL", *CLOSING))
        session = EditedSession(first, chance.choice(("", "", "sphere", "single-triangle")))
        session.wait_for_edits(1)
        time.sleep(chance.uniform(0, 6))
        at_least = max(at_least, session.end(name))
        found = number_of(reopen())
        assert at_least <= found, f"seed {SEED}, turn {turn}, {name}"
        first = session.edits[-1][0] + 1
    assert not list(folder.glob(".*.part"))
