"""What was in the form of an answer, for undo: what one stroke or one key changed on the picture goes together."""

from PySide6.QtCore import QObject, Slot

from app.session.history import History
from widgets.exercises.mark_grid import MarkGrid


class AnswerHistory(QObject):
    """Values of a form in the order in which they were given."""

    def __init__(self, grid: MarkGrid, parent: QObject | None = None) -> None:
        """Listen to the picture before any form does."""
        super().__init__(parent)
        self._grid = grid
        self._values: History[object] = History(None)
        self._gesture = ""
        """Of the change on the picture that the form takes now."""
        for changed in (grid.pixels_painted, grid.point_moved, grid.point_nudged):
            changed.connect(self._begin_gesture)

    @Slot()
    def _begin_gesture(self) -> None:
        self._gesture = f"{self._grid.gesture}"

    def begin(self, given: object) -> None:
        """Forget everything: another question is asked."""
        self._values = History(given)

    def put(self, given: object) -> None:
        """Take over a change."""
        self._values.put(given, self._gesture)
        self._gesture = ""

    def can_go(self, direction: int) -> bool:
        """Return whether there is a value before (-1) or after (1) the present one."""
        return self._values.can_undo if direction < 0 else self._values.can_redo

    def go(self, direction: int) -> object:
        """Return the value before (-1) or after (1), which is the present one now."""
        return self._values.undo() if direction < 0 else self._values.redo()
