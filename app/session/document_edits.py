"""Edits of the whole document, and drags of vertices, of which the newest place counts."""

from collections.abc import Callable
from dataclasses import replace

from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.session.document import Document, fit_region, focus_on, same_view
from app.session.session import Session
from core.scene import ClipScene
from lessons.scene_edits import join_shared, split_shared

# Calls that come faster than they are done: the first of a turn of the event loop is done at once, then the
# last.


class LatestCall(QObject):
    """Does the last of the calls that wait, as of a pointer that moves on while its last place is worked on."""

    def __init__(self, do: Callable[..., None], parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._do = do
        self._waiting: tuple[object, ...] | None = None
        self._turn = QTimer(self, singleShot=True)
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


# Drags of vertices, one after the other: the newest place counts, and each drag is undone as a whole.


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


# Edits of the whole document: which triangle is in focus, which raster is drawn, what is shared and
# cleared.


class DocumentEdits(QObject):
    """Makes edits that undo takes back."""

    edit_refused = Signal(object)
    """The exception that says why an edit is not possible, or came to nothing."""
    edit_pointless = Signal(str)
    """Why there is nothing to edit."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        session.edit_failed.connect(self._fail)

    def edit(self, document: Document) -> None:
        """Take over an edited document, or say why that is not possible."""
        try:
            self._session.edit(document)
        except ValueError as error:
            self.edit_refused.emit(error)

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        """Say why an edit that was traced in the background came to nothing."""
        if not isinstance(error, ValueError | MemoryError):
            raise error
        self.edit_refused.emit(error)

    @Slot()
    def cancel(self) -> None:
        """Say that an edit was cancelled."""
        self.edit_refused.emit(ValueError("The edit was cancelled; nothing has changed."))

    def undo(self) -> None:
        """Take the last edit back, or say that there is none."""
        if self._session.can_undo:
            self._session.undo()
        else:
            self.edit_pointless.emit("There is no edit to undo.")

    def redo(self) -> None:
        """Do the edit again that was undone last, or say that there is none."""
        if self._session.can_redo:
            self._session.redo()
        else:
            self.edit_pointless.emit("There is no edit to redo.")

    def toggle_shared(self) -> None:
        """Let corners at one place move together, or each by itself."""
        document = self._session.latest
        scene = document.scene
        if not isinstance(scene, ClipScene):
            self.edit_pointless.emit("Vertices of a mesh are always shared by its triangles.")
            return
        if scene.table is not None:
            self.edit_pointless.emit("A table of depths has no corners to share.")
            return
        edited = split_shared(scene) if scene.shared is not None else join_shared(scene)
        self.edit(replace(document, scene=edited))

    def fit_region(self) -> None:
        """Show the smallest raster around the triangle in focus."""
        document = self._session.latest
        if document.triangle is None and document.triangle_count == 1:
            document = replace(document, triangle=0)
        self.edit(fit_region(document))

    def show_whole(self) -> None:
        """Show the whole picture on a small raster; the triangle in focus stays."""
        document = self._session.latest
        if document.raster.origin is not None:
            self.edit(replace(document, raster=same_view(document.scene, 64, 48)))

    def focus_all(self) -> None:
        """Step all triangles instead of the one in focus."""
        document = self._session.latest
        self.edit(replace(document, triangle=None, raster=same_view(document.scene, 64, 48)))

    @Slot(int)
    def focus_triangle(self, triangle: int) -> None:
        """Bring a triangle into focus."""
        self.edit(focus_on(self._session.latest, triangle))

    def step_triangle(self, direction: int) -> None:
        """Bring the next (1) or previous (-1) triangle into focus, round and round."""
        document = self._session.latest
        last = -1 if direction > 0 else 0
        before = last if document.triangle is None else document.triangle
        self.focus_triangle((before + direction) % document.triangle_count)

    def toggle_cleared(self) -> None:
        """Start from cleared buffers, or as the earlier triangles left them."""
        document = self._session.latest
        before = "earlier" if document.before == "cleared" else "cleared"
        self.edit(replace(document, before=before))

    @Slot(int, int)
    def choose_raster(self, columns: int, rows: int) -> None:
        """Draw the whole view in so many columns and rows."""
        document = self._session.latest
        self.edit(replace(document, raster=same_view(document.scene, columns, rows)))
