"""Drawing off the GUI thread: one picture at a time, and of those that wait only the last."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import Lock

from PySide6.QtCore import QObject, Signal

from app.views.scene_picture import DrawnScene


class SceneWorker(QObject):
    """Runs the last job it was given; the signal reaches the GUI thread through its event loop."""

    drawn = Signal(int, object)
    """Number of the job and its :class:`~app.views.scene_picture.DrawnScene`."""
    failed = Signal(int, str)
    """Number of the job and why there is no picture."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._lock = Lock()
        self._waiting: tuple[int, Callable[[], DrawnScene]] | None = None
        self._is_running = False
        self._number = 0
        self._executor = ThreadPoolExecutor(max_workers=1, thread_name_prefix="scene picture")
        self._relay = _Relay()
        self._relay.drawn.connect(self.drawn)
        self._relay.failed.connect(self.failed)

    def start(self, job: Callable[[], DrawnScene]) -> int:
        """Draw as soon as what is being drawn now is done; return the number of the job."""
        with self._lock:
            self._number += 1
            self._waiting = (self._number, job)
            if not self._is_running:
                self._is_running = True
                self._executor.submit(_run, self._relay, self._next)
            return self._number

    def forget(self) -> None:
        """Drop what waits; what is being drawn is told, with its old number."""
        with self._lock:
            self._waiting = None
            self._number += 1

    def stop(self) -> None:
        """Drop what waits, and wait for what is being drawn."""
        self.forget()
        self._executor.shutdown(wait=True)

    @property
    def latest(self) -> int:
        """Number of the last job; what comes with another one is out of date."""
        return self._number

    def _next(self) -> tuple[int, Callable[[], DrawnScene]] | None:
        with self._lock:
            job, self._waiting = self._waiting, None
            self._is_running = job is not None
            return job


class _Relay(QObject):
    """Outlives the worker while the thread still draws."""

    drawn = Signal(int, object)
    failed = Signal(int, str)


def _run(relay: _Relay, take: Callable[[], tuple[int, Callable[[], DrawnScene]] | None]) -> None:
    while (job := take()) is not None:
        number, draw = job
        try:
            relay.drawn.emit(number, draw())
        except Exception as problem:
            # Told to the user by whoever asked; the thread goes on with the next job.
            relay.failed.emit(number, f"the picture could not be drawn: {problem}")
