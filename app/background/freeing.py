"""Giving freed memory back to the system, a moment after what takes much of it."""

from PySide6.QtCore import QObject, QTimer, Slot

from app.background.workers import Job
from core.numeric.buffers import give_back

PAUSE = 500
"""Milliseconds without such work: not between the moves of a drag."""


class Freeing(QObject):
    """Gives memory back off the GUI thread, where it may take a tenth of a second."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._job = Job(self, expected=())
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE)
        self._pause.timeout.connect(self._start)

    @property
    def is_waiting(self) -> bool:
        """Whether memory is still to be given back."""
        return self._pause.isActive() or self._job.is_running

    @Slot()
    def ask(self) -> None:
        """Give back soon: something large was replaced."""
        self._pause.start()

    def shut_down(self) -> None:
        """Give nothing back any more."""
        self._pause.stop()
        self._job.shut_down()

    @Slot()
    def _start(self) -> None:
        self._job.call(give_back)
