"""A magnified pixel grid under the pointer: hover, click, zoom, pan, and vertices that can be dragged."""

from enum import Enum
from math import floor

from PySide6.QtCore import QEvent, QPoint, QPointF, Qt, Signal
from PySide6.QtGui import (
    QContextMenuEvent,
    QFocusEvent,
    QGuiApplication,
    QHelpEvent,
    QHideEvent,
    QKeyEvent,
    QKeySequence,
    QMouseEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QApplication, QToolTip, QWidget

from widgets.basics.accessibility import EscapeClaim
from widgets.grid.display import GridDisplay
from widgets.grid.geometry import vertex_near
from widgets.grid.view import FIT, GridView, panned, zoomed

_WHEEL_FACTOR = 1.25
"""Magnification of one notch of the wheel."""


class _Drag(Enum):
    """What the pressed mouse button does."""

    NONE = 0
    PAN = 1
    VERTEX = 2
    BRUSH = 3


class PixelGrid(GridDisplay):
    """Shows a :class:`~widgets.grid.layers.GridBuffer` magnified and reports what the user points at and drags.

    Wheel: zoom about the pointer. Middle drag, right drag or Space and drag: pan. Click: ``pixel_clicked``.
    Vertices of the triangle in focus can be dragged; Shift rounds to half pixels, Escape takes the drag
    back. Double click beside the raster, or :meth:`fit`: all of its pixels. Ctrl+C copies the pinned value
    in full precision.
    """

    pixel_hovered = Signal(int, int)
    """Column and row under the pointer, when it changes."""
    pixel_left = Signal()
    """The pointer is on no pixel any more."""
    pixel_clicked = Signal(int, int)
    """Column and row; while a brush is on, also of each further pixel of a drag."""
    pixel_menu_requested = Signal(int, int, QPoint)
    """Column, row and global position of a right click."""
    vertex_dragged = Signal(int, float, float)
    """Vertex and its new window position (y up)."""
    vertex_drag_finished = Signal(int)
    """Vertex."""
    vertex_drag_taken_back = Signal(int)
    """Vertex; the drag ended and is to be as if it had not been."""
    view_changed = Signal(object)
    """The new :class:`~widgets.grid.view.GridView` after the user zoomed or panned."""

    def __init__(self, parent: QWidget | None = None, compact: bool = False) -> None:
        """Make an empty grid; a ``compact`` one is a thumbnail without rulers, handles and keyboard focus."""
        super().__init__(parent, compact)
        self._pointed: tuple[int, int] | None = None
        self._drag = _Drag.NONE
        self._pressed_at = QPointF()
        self._last_at = QPointF()
        self._vertex_origin = (0.0, 0.0)
        self._has_moved = False
        self._has_space = False
        self._has_brush = False
        self._escape = EscapeClaim(self, self._is_dragging_vertex)
        self.setMouseTracking(True)

    def set_brush(self, has_brush: bool) -> None:
        """Let a drag click every pixel that it crosses, as for drawing a prediction."""
        self._has_brush = has_brush

    def fit(self) -> None:
        """Show all pixels that the grid has, as the user's wish."""
        self.change_view(FIT)

    def zoom_by(self, factor: float) -> None:
        """Magnify by a factor about the pinned pixel, or else the middle, as the user's wish."""
        placement = self.placement()
        middle = QPointF(placement.viewport.center())
        if self._pin is not None:
            pinned = placement.cells_rect(*self._pin).center()
            middle = pinned if placement.viewport.contains(pinned.toPoint()) else middle
        self.change_view(zoomed(placement, middle, factor, self.devicePixelRatioF()))

    def move_view(self, across: int, up: int) -> None:
        """Look further to one side by an eighth of what is seen, as the user's wish."""
        placement = self.placement()
        step = 0.125 * min(placement.viewport.width(), placement.viewport.height())
        self.change_view(panned(placement, self._view, QPointF(-step * across, step * up)))

    def choose_next_vertex(self) -> int | None:
        """Mark the next vertex that can be moved, as if the pointer were on it; ``None``: there is none."""
        geometry = self._geometry
        if geometry is None or not geometry.draggable or geometry.focus < 0 or not len(geometry.triangles):
            return None
        own = geometry.focus_vertices
        self._vertex = own[(own.index(self._vertex) + 1) % len(own)] if self._vertex in own else own[0]
        self.update()
        return self._vertex

    def nudge_vertex(self, across: float, up: float) -> bool:
        """Move the marked vertex by pixels, as a whole drag does; return whether one is marked."""
        vertex, geometry = self._vertex, self._geometry
        if vertex is None or geometry is None or not geometry.draggable or self._drag is not _Drag.NONE:
            return False
        x, y = geometry.vertices[vertex].tolist()
        self.vertex_dragged.emit(vertex, x + across, y + up)
        self.vertex_drag_finished.emit(vertex)
        return True

    def vertex_text(self) -> str:
        """Return the marked vertex and its place; empty: none is marked."""
        vertex, geometry = self._vertex, self._geometry
        if vertex is None or geometry is None:
            return ""
        own = geometry.focus_vertices
        x, y = geometry.vertices[vertex].tolist()
        return f"Vertex {own.index(vertex) if vertex in own else vertex} at ({x:.4g}, {y:.4g})"

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Click a pixel, take a vertex, or begin to pan."""
        position, button = event.position(), event.button()
        if self._drag is not _Drag.NONE or self.buffer() is None:
            return
        self._pressed_at = self._last_at = position
        self._has_moved = False
        is_pan = button in (Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton) or self._has_space
        if is_pan:
            self._drag = _Drag.PAN
        elif button == Qt.MouseButton.LeftButton:
            vertex = None if self._compact else self._vertex_at(position)
            if vertex is not None and self._geometry is not None:
                self._drag, self._vertex = _Drag.VERTEX, vertex
                x, y = self._geometry.vertices[vertex]
                self._vertex_origin = (float(x), float(y))
            else:
                self._click(position)
                if self._has_brush:
                    self._drag = _Drag.BRUSH
        self._update_cursor()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag what was taken, or point at a pixel or vertex."""
        position = event.position()
        delta, self._last_at = position - self._last_at, position
        travelled = (position - self._pressed_at).manhattanLength()
        starts = not self._has_moved and travelled >= QApplication.startDragDistance() / 2
        if self._drag is _Drag.NONE:
            self._point_at(position)
            return
        if self._drag is _Drag.BRUSH:
            before = self._pointed
            self._point_at(position)
            if self._pointed is not None and self._pointed != before:
                self.pixel_clicked.emit(*self._pointed)
            return
        if starts:
            self._has_moved = True
            delta = position - self._pressed_at
            if self._drag is _Drag.VERTEX:
                self._set_pointed(None)  # the pixel where the drag began is not the one under the pointer
            self._update_cursor()
        if not self._has_moved:
            return
        if self._drag is _Drag.PAN:
            self.change_view(panned(self.placement(), self._view, delta))
        elif (
            self.buffer() is not None
        ):  # Else there are no pixels to place it by, until there is a picture again.
            self._drag_vertex(position, bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End a drag; without a movement it was a click."""
        drag, self._drag = self._drag, _Drag.NONE
        if drag is _Drag.VERTEX and self._vertex is not None:
            if self._has_moved:
                self.vertex_drag_finished.emit(self._vertex)
            else:
                self._click(event.position())
        elif drag is _Drag.PAN and not self._has_moved and event.button() == Qt.MouseButton.RightButton:
            pixel = self.placement().pixel_at(event.position())
            if pixel is not None:
                self.pixel_menu_requested.emit(*pixel, event.globalPosition().toPoint())
        self._has_moved = False
        self._point_at(event.position())

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show all pixels after a double click beside them; elsewhere it is two clicks."""
        beside = self.placement().pixel_at(event.position()) is None
        if beside and event.button() == Qt.MouseButton.LeftButton and self.buffer() is not None:
            self.fit()
        else:
            self.mousePressEvent(event)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom about the pointer."""
        notches = event.angleDelta().y() / 120.0
        if self.buffer() is None or notches == 0:
            event.ignore()
            return
        placement, position = self.placement(), event.position()
        factor = _WHEEL_FACTOR**notches
        self.change_view(zoomed(placement, position, factor, self.devicePixelRatioF()))
        self._point_at(position)
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Hold Space to pan, Escape to take a drag back, Ctrl+C to copy; other keys belong to the window."""
        if event.key() == Qt.Key.Key_Space and not event.modifiers():
            self._has_space = True
            self._update_cursor()
        elif event.key() == Qt.Key.Key_Escape and self._is_dragging_vertex():
            self._end_drag(take_back=True)
        elif event.matches(QKeySequence.StandardKey.Copy):
            pixel = self._pin or self._pointed
            if pixel is not None:
                QGuiApplication.clipboard().setText(self.value_text(pixel, digits=0).replace("\u2212", "-"))
        else:
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Let go of Space."""
        if event.key() == Qt.Key.Key_Space and not event.isAutoRepeat():
            self._has_space = False
            self._update_cursor()
        else:
            super().keyReleaseEvent(event)

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Ask for the pinned pixel's menu with the menu key; the right button asks when released without a move."""
        if event.reason() == QContextMenuEvent.Reason.Keyboard and self._pin is not None:
            corner = self.placement().cells_rect(*self._pin).bottomRight().toPoint()
            self.pixel_menu_requested.emit(*self._pin, self.mapToGlobal(corner))
        event.accept()

    def leaveEvent(self, event: QEvent) -> None:
        """Point at nothing."""
        self._set_pointed(None)
        super().leaveEvent(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Forget a held Space; its release may go elsewhere."""
        self._has_space = False
        self._update_cursor()
        super().focusOutEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        """End a drag that would never see its release."""
        self._end_drag(take_back=False)
        super().hideEvent(event)

    def event(self, event: QEvent) -> bool:
        """Show the value in full precision as a tooltip."""
        if event.type() == QEvent.Type.ToolTip and isinstance(event, QHelpEvent):
            pixel = self.placement().pixel_at(QPointF(event.pos()))
            buffer = self.buffer()
            if buffer is None or pixel is None:
                QToolTip.hideText()
            else:
                lines = [f"{buffer.label} at ({pixel[0]}, {pixel[1]})", self.value_text(pixel, digits=0)]
                lines += [text for text in (self.samples_text(pixel), buffer.description) if text]
                QToolTip.showText(event.globalPos(), "\n".join(lines))
            return True
        return super().event(event)

    def _click(self, position: QPointF) -> None:
        """Emit the click of the pixel under the pointer."""
        pixel = self.placement().pixel_at(position) if self.buffer() is not None else None
        if pixel is not None:
            self._pointed = pixel
            self.pixel_clicked.emit(*pixel)

    def _point_at(self, position: QPointF) -> None:
        """Mark and tell the pixel under the pointer, and mark a vertex that can be taken."""
        has_buffer = self.buffer() is not None
        self._set_pointed(self.placement().pixel_at(position) if has_buffer else None)
        vertex = self._vertex_at(position) if has_buffer and not self._compact else None
        if vertex != self._vertex and self._drag is _Drag.NONE:
            self._vertex = vertex
            self.update()
        self._update_cursor()

    def _set_pointed(self, pixel: tuple[int, int] | None) -> None:
        """Mark the pixel under the pointer at once, and tell if it is another."""
        if pixel == self._pointed:
            return
        self._pointed = pixel
        self.show_hover(pixel)
        if pixel is None:
            self.pixel_left.emit()
        else:
            self.pixel_hovered.emit(*pixel)

    def _vertex_at(self, position: QPointF) -> int | None:
        """Return the vertex that could be taken at a widget position."""
        return None if self._geometry is None else vertex_near(self._geometry, self.placement(), position)

    def _drag_vertex(self, position: QPointF, rounds: bool) -> None:
        """Tell the new position of the vertex: as far from its old one as the pointer went."""
        placement = self.placement()
        x0, y0 = placement.to_window(self._pressed_at)
        x1, y1 = placement.to_window(position)
        x, y = self._vertex_origin[0] + x1 - x0, self._vertex_origin[1] + y1 - y0
        if rounds:
            x, y = floor(2 * x + 0.5) / 2, floor(2 * y + 0.5) / 2
        self.vertex_dragged.emit(self._vertex, x, y)

    def _is_dragging_vertex(self) -> bool:
        return self._drag is _Drag.VERTEX and self._has_moved

    def _end_drag(self, take_back: bool) -> None:
        """End a drag before the button is released."""
        drag, self._drag = self._drag, _Drag.NONE
        if drag is _Drag.VERTEX and self._has_moved and self._vertex is not None:
            (self.vertex_drag_taken_back if take_back else self.vertex_drag_finished).emit(self._vertex)
        self._has_moved = False
        self._update_cursor()

    def change_view(self, view: GridView) -> None:
        """Take over a view that the user chose."""
        if view != self._view:
            self._view = view
            self.update()
            self.view_changed.emit(view)

    def _update_cursor(self) -> None:
        """Show what the button does or would do here."""
        if self._drag is _Drag.PAN and self._has_moved:
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        elif self._has_space:
            self.setCursor(Qt.CursorShape.OpenHandCursor)
        elif self._drag is _Drag.VERTEX or (self._drag is _Drag.NONE and self._vertex is not None):
            self.setCursor(Qt.CursorShape.SizeAllCursor)
        else:
            self.setCursor(Qt.CursorShape.CrossCursor)
