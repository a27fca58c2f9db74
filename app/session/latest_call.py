"""Calls that come faster than they are done: the first of a turn of the event loop is done at once, then the last."""

from collections.abc import Callable

from PySide6.QtCore import QObject, QTimer, Slot


class LatestCall(QObject):
    """Does the last of the calls that wait, as of a pointer that moves on while its last place is worked on."""

    def __init__(self, do: Callable[..., None], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._do = do
        self._waiting: tuple[object, ...] | None = None
        self._turn = QTimer(self)
        self._turn.setSingleShot(True)
        self._turn.timeout.connect(self._do_waiting)

    def call(self, *arguments: object) -> None:
        """Do this now, or when everything that waits in the event loop has come, unless there is a later call then."""
        if self._turn.isActive():
            self._waiting = arguments
        else:
            self._turn.start(0)
            self._do(*arguments)

    def flush(self) -> None:
        """Do what waits now."""
        self._turn.stop()
        arguments, self._waiting = self._waiting, None
        if arguments is not None:
            self._do(*arguments)

    @Slot()
    def _do_waiting(self) -> None:
        arguments, self._waiting = self._waiting, None
        if arguments is not None:
            self.call(*arguments)
