"""Signals that end the program: SIGTERM, SIGHUP and Ctrl+C close the window, which saves what is open."""

import signal
import socket
from time import monotonic
from types import FrameType

from PySide6.QtCore import QObject, QSocketNotifier, Signal, Slot

PATIENCE = 3.0
"""Seconds after the first signal in which others change nothing: longer than closing takes."""
NAMES = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
"""Not every system has all of them."""


class EndSignals(QObject):
    """Listens to the signals, and reports the first one; one that comes much later ends the program at once.

    Qt's event loop is not Python, and Python handles a signal only between two of its own instructions. So Python
    writes the number of the signal into a socket, and Qt wakes up when there is something to read in it.
    """

    received = Signal(int)
    """The number of a signal."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._first_at: float | None = None
        self._reader, self._writer = socket.socketpair()
        for end in (self._reader, self._writer):
            end.setblocking(False)
        self._notifier = QSocketNotifier(self._reader.fileno(), QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(self._read)
        signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)
        for number in (getattr(signal, name) for name in NAMES if hasattr(signal, name)):
            # A program that was started to outlive its terminal, as by nohup, still does.
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._take)

    def stop(self) -> None:
        """Do not listen any more."""
        signal.set_wakeup_fd(-1)
        self._notifier.setEnabled(False)
        self._reader.close()
        self._writer.close()

    def _take(self, number: int, frame: FrameType | None) -> None:
        # Whoever ends a group of processes may well send two signals at once: the first is still being obeyed.
        if self._first_at is None:
            self._first_at = monotonic()
        elif monotonic() - self._first_at > PATIENCE:
            signal.signal(number, signal.SIG_DFL)
            signal.raise_signal(number)

    @Slot()
    def _read(self) -> None:
        self._notifier.setEnabled(False)
        self.received.emit(self._reader.recv(1)[0])
