"""Drawing what comes bit by bit: at most some times a second, and only while somebody sees it."""

from PySide6.QtCore import QEvent, QObject, QTimer, Signal, Slot
from PySide6.QtWidgets import QWidget

PAUSE = 250
"""Milliseconds between the end of one drawing and the beginning of the next."""


class PacedDrawing(QObject):
    """Says when to draw: at once after a pause, else when the pause is over; of a hidden page, when it is shown."""

    due = Signal()
    """It is to be drawn now."""

    def __init__(self, page: QWidget) -> None:
        super().__init__(page)
        self._page = page
        self._is_owed = False
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE)
        self._pause.timeout.connect(self._draw_what_is_owed)
        page.installEventFilter(self)

    def ask(self) -> None:
        """Something new has come."""
        self._is_owed = True
        self._draw_what_is_owed()

    def settle(self) -> None:
        """Owe nothing: everything has just been drawn."""
        self._is_owed = False

    @Slot()
    def _draw_what_is_owed(self) -> None:
        if self._is_owed and not self._pause.isActive() and self._page.isVisible():
            self._is_owed = False
            self.due.emit()
            self._pause.start()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Draw what came while the page was hidden."""
        if event.type() == QEvent.Type.Show:
            self._draw_what_is_owed()
        return False
