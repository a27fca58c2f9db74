"""Garbage collected in the GUI thread only, for the collector deletes what it finds in the thread that it runs in."""

import gc

from PySide6.QtCore import QObject, QTimer, Slot

LOOK_MS = 200
"""How often is looked whether there may be enough garbage."""


class Collecting(QObject):
    """Collects as often as Python would, but between two events of the GUI thread.

    Python collects in whatever thread makes one object too many, half of the time a worker: a widget or a timer in a
    ring of references would be deleted there while the GUI thread uses it.
    """

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._most = gc.get_threshold()
        gc.set_threshold(0)  # Not ``disable``: who times something turns the collector off and on again.
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._collect)
        self._timer.start(LOOK_MS)

    def stop(self) -> None:
        """Let Python collect by itself again."""
        self._timer.stop()
        gc.set_threshold(*self._most)

    @Slot()
    def _collect(self) -> None:
        """Collect the oldest generation of which all younger ones, and it, are over their limit."""
        if not gc.isenabled():
            return
        oldest = -1
        for count, most in zip(gc.get_count(), self._most, strict=True):
            if count <= most:
                break
            oldest += 1
        if oldest >= 0:
            gc.collect(oldest)
