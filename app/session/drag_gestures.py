"""Drags of vertices, one after the other: the newest place counts, and each drag is undone as a whole."""

from collections.abc import Callable

from PySide6.QtCore import QObject, Slot

from app.session.latest_call import LatestCall
from app.session.session import Session


class DragGestures(QObject):
    """Names each drag, and ends it in the session."""

    def __init__(
        self, session: Session, name: str, move: Callable[[int, float, float], None], parent: QObject
    ) -> None:
        """``move`` takes a vertex to a place; ``name`` tells these drags from those in other views."""
        super().__init__(parent)
        self._session, self._name, self._count = session, name, 0
        self._moves = LatestCall(move, self)

    @property
    def name(self) -> str:
        """Name of the present drag, for `Session.edit`."""
        return f"{self._name} {self._count}"

    @Slot(int, float, float)
    def drag(self, vertex: int, x: float, y: float) -> None:
        """Move a vertex, unless a later place of it comes first."""
        self._moves.call(vertex, x, y)

    @Slot(int)
    def end(self, vertex: int) -> None:
        """End the drag; what follows is another one."""
        self._moves.flush()
        self._session.come_to_rest()
        self._count += 1

    @Slot(int)
    def take_back(self, vertex: int) -> None:
        """End the drag as if it had not been."""
        self._moves.flush()
        self._session.take_back(self.name)
        self._count += 1
