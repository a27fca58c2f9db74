"""Drawing off the GUI thread: one picture at a time, and of those that wait only the last.

So the newest camera wins: what was asked for in between is never drawn, and no picture waits behind another.
"""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from threading import Lock

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import leave, seconds_to_end

Work = Callable[[], object]


class SceneWorker(QObject):
    """Runs the last work it was given; the signals reach the GUI thread through its event loop."""

    done = Signal(object)
    """What the work returned."""
    failed = Signal(str)
    """Why there is no result."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._lock = Lock()
        self._waiting: tuple[int, Work] | None = None
        self._is_running = False
        self._is_stopped = False
        self._number = 0
        self._told = 0
        """Number of the last work whose result was reported or dropped."""
        self._running: Future[None] | None = None
        self._executor = ThreadPoolExecutor(max_workers=1, thread_name_prefix="scene picture")
        self._relay = _Relay()
        self._relay.done.connect(self._take_result)
        self._relay.failed.connect(self._take_failure)

    def start(self, work: Work) -> None:
        """Run it as soon as what is running now is done, unless something newer comes before that.

        After `stop` nothing is run any more: a window that closes may still change its theme.
        """
        if self._is_stopped:
            return
        with self._lock:
            self._number += 1
            self._waiting = (self._number, work)
            if not self._is_running:
                self._is_running = True
                self._running = self._executor.submit(_run, self._relay, self._next)

    def forget(self) -> None:
        """Drop what waits, and what comes of what is running now."""
        with self._lock:
            self._waiting = None
            self._told = self._number

    def stop(self) -> None:
        """Drop what waits, and wait for what is running; see `app.background.workers.ending_within`."""
        self._is_stopped = True
        self.forget()
        if self._running is not None and wait([self._running], seconds_to_end()).not_done:
            leave(self._executor)
        self._executor.shutdown(wait=False)

    @property
    def is_busy(self) -> bool:
        """Whether a result is still to come."""
        return self._told < self._number

    def _next(self) -> tuple[int, Work] | None:
        with self._lock:
            work, self._waiting = self._waiting, None
            self._is_running = work is not None
            return work

    @Slot(int, object)
    def _take_result(self, number: int, result: object) -> None:
        if number > self._told:
            self._told = number
            self.done.emit(result)

    @Slot(int, str)
    def _take_failure(self, number: int, reason: str) -> None:
        if number > self._told:
            self._told = number
            self.failed.emit(reason)


class _Relay(QObject):
    """Outlives the worker while the thread still draws."""

    done = Signal(int, object)
    failed = Signal(int, str)


def _run(relay: _Relay, take: Callable[[], tuple[int, Work] | None]) -> None:
    while (taken := take()) is not None:
        number, work = taken
        try:
            relay.done.emit(number, work())
        except Exception as problem:
            # Told to the user by whoever asked; the thread goes on with the next one.
            relay.failed.emit(number, f"the picture could not be drawn: {problem}")
