"""A pixel grid that is answered on: pixels are marked and points placed; and what all forms of answers share."""

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from PySide6.QtCore import QEvent, QLineF, QPointF, QRectF, Qt, Signal, Slot
from PySide6.QtGui import QColor, QFocusEvent, QKeyEvent, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import QWidget

from core.records.cells import Form, Marks
from widgets.basics.accessibility import announce
from widgets.basics.theme import Theme, current_theme, text_font
from widgets.exercises.records import Pixel, Pixels
from widgets.grid.geometry import GridGeometry, outline_text, paint_chip
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay, Overlay
from widgets.grid.names import moved_inside
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridPlacement

# Named points over a pixel grid, which are placed by clicks, drags and keys.


Place = tuple[float, float]
REACH = 12.0
"""How near the pointer must come to a point to take it, in widget pixels."""
RADIUS = 6.0


class PointLayer:
    """The points that a form has on the picture; those without a place are not drawn."""

    def __init__(self, names: Sequence[str] = ()) -> None:
        self.names = tuple(names)
        self.places: list[Place | None] = [None] * len(self.names)
        self.marks: dict[int, bool] = {}
        """By point, whether a check has found it right."""
        self.chosen = 0
        """The point that the keys move, and that a click beside all points places."""

    def near(self, placement: GridPlacement, position: QPointF) -> int | None:
        """Return the point under a widget position, or ``None``."""
        best, reach = None, REACH
        for number, place in enumerate(self.places):
            if place is not None:
                distance = QLineF(placement.to_widget(*place), position).length()
                if distance <= reach:
                    best, reach = number, distance
        return best

    def next_free(self) -> int:
        """Return the point that a click places: the first without a place, or else the chosen one."""
        return next((number for number, place in enumerate(self.places) if place is None), self.chosen)

    def text(self, number: int) -> str:
        """Return a point and its place in words."""
        place = self.places[number]
        where = "not placed" if place is None else f"at {place[0]:.6g}, {place[1]:.6g}"
        mark = {True: ", right", False: ", wrong", None: ""}[self.marks.get(number)]
        return f"Point {self.names[number]} {where}{mark}"

    def paint(self, painter: QPainter, placement: GridPlacement, theme: Theme, *, has_focus: bool) -> None:
        """Paint every point with its name; a right one has a tick in its name, a wrong one a cross."""
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(text_font(theme))
        for number, place in enumerate(self.places):
            if place is None:
                continue
            center = placement.to_widget(*place)
            radius = RADIUS + 2 * (has_focus and number == self.chosen)
            for color, width in (("#ffffff", 5.0), ("#000000", 2.0)):
                painter.setPen(QPen(QColor(color), width))
                painter.setBrush(QColor(theme.panel))
                painter.drawEllipse(center, radius, radius)
            mark = {True: " ✓", False: " ✗", None: ""}[self.marks.get(number)]
            text = f"{self.names[number]}{mark}"
            box = _label_box(painter, text)
            box.moveBottomLeft(center + QPointF(RADIUS + 2, -RADIUS))
            paint_chip(painter, moved_inside(box, QRectF(placement.viewport)), text, theme.text, theme)
        painter.restore()


def paint_names(
    painter: QPainter, placement: GridPlacement, theme: Theme, names: Sequence[str], places: Sequence[Place]
) -> None:
    """Write names about places in the window; of a place beside the picture at its border."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setFont(text_font(theme))
    for name, place in zip(names, places, strict=True):
        box = _label_box(painter, name)
        box.moveCenter(placement.to_widget(*place))
        paint_chip(painter, moved_inside(box, QRectF(placement.viewport)), name, theme.text, theme)
    painter.restore()


def _label_box(painter: QPainter, text: str) -> QRectF:
    """Return the room of a name."""
    metrics = painter.fontMetrics()
    return QRectF(0, 0, metrics.horizontalAdvance(text) + 10, metrics.height() + 2)


# A pixel grid that is answered on: click, drag, or arrows and Space mark pixels and place points.


NOTHING: Pixels = frozenset()
FOUND = {
    "right": CellMark.RIGHT,
    "missing": CellMark.MISSING,
    "extra": CellMark.EXTRA,
    "double": CellMark.DOUBLE,
}
_MOVES = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Up: (0, 1), Qt.Key.Key_Down: (0, -1)}
_WINDOWS_OWN = (
    Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.MetaModifier
)


class MarkGrid(PixelGrid):
    """Shows a raster with its outlines and what the learner has marked; of the answer it holds nothing else."""

    pixels_painted = Signal(object, bool)
    """Pixels, and whether they are marked now."""
    point_moved = Signal(int, float, float)
    """Number of a point, and its new place in the window; where it can lie is the form's affair."""
    point_nudged = Signal(int, int, int, bool)
    """Number of a point, steps to the right and up, and whether they are whole pixels."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._size = (1, 1)
        self._marked = NOTHING
        self._picture: GridBuffer | None = None
        self._found: tuple[Overlay, ...] = ()
        self._is_paintable = False
        self._stroke: bool | None = None
        """What the drag in progress does to pixels; ``None``: the next one decides."""
        self._last: Pixel | None = None
        self._points = PointLayer()
        self._dragged: int | None = None
        self.gesture = 0
        """Number of the stroke, drag or key that changes the answer now."""
        self.pixel_clicked.connect(self._paint_at)

    def show_raster(self, size: tuple[int, int], geometry: GridGeometry | None, pixel: Pixel | None) -> None:
        """Show an empty raster of (columns, rows) with outlines; ``pixel`` is what the question is about."""
        self._size, self._marked, self._picture, self._found = size, NOTHING, None, ()
        self.fit()
        self._show_marked()
        self.show_geometry(geometry)
        self.show_pin(pixel)
        self.show_points(())

    def show_picture(self, picture: GridBuffer | None, overlays: Sequence[Overlay] = ()) -> None:
        """Show a picture under the marks; ``None``: the marks themselves are the picture."""
        self._picture, self._found = picture, tuple(overlays)
        self._show_marked()

    def set_paintable(self, is_paintable: bool) -> None:
        """Let clicks and keys mark pixels."""
        self._is_paintable = is_paintable
        self.set_brush(is_paintable)
        self._begin_at_pixel()

    def marked(self) -> Pixels:
        """Return the marked pixels."""
        return self._marked

    def show_marked(self, pixels: Pixels) -> None:
        """Mark these pixels, and no others."""
        self._marked = pixels
        self._show_marked()

    def show_marks(self, marks: Marks | None) -> None:
        """Mark what is right, missing, extra or double, each by a shape of its own."""
        kinds = {} if marks is None else FOUND
        self._found = tuple(
            MaskOverlay(key, mark, self._mask((marks or {}).get(key, ()))) for key, mark in kinds.items()
        )
        self._show_marked()

    def _mask(self, pixels: Collection[Pixel]) -> np.ndarray:
        mask = np.zeros(self._size[::-1], bool)
        if pixels:
            columns, rows = np.array(sorted(pixels)).T
            mask[rows, columns] = True
        return mask

    def _show_marked(self) -> None:
        """Show the marks: as the picture, or as rings over one."""
        marked = self._mask(self._marked)
        own = GridBuffer("marked", marked, "bool", title="your marks")
        self.show_buffer(self._picture or own)
        rings = (
            () if self._picture is None else (MaskOverlay("marked", CellMark.TIE, marked, title="your mark"),)
        )
        self.show_overlays((*rings, *self._found))

    def spoken_description(self) -> str:
        """Return what a screen reader says of the pixel or point that the keyboard is at; at first, of the outlines."""
        pixel = self.pin()
        if self._points.names:
            return self._points.text(self._points.chosen)
        if not self._is_paintable or pixel is None:
            return super().spoken_description()
        outlines = "" if self._marked or self._geometry is None else outline_text(self._geometry)
        return f"{self._pixel_text(pixel)}. {len(self._marked)} marked.{outlines}"

    def _pixel_text(self, pixel: Pixel) -> str:
        found = [
            overlay.label
            for overlay in self._found
            if isinstance(overlay, MaskOverlay) and overlay.mask[pixel[1], pixel[0]]
        ]
        value = [] if self._picture is None else [self.value_text(pixel)]
        state = "marked" if pixel in self._marked else "not marked"
        return f"Pixel {pixel[0]}, {pixel[1]}: {', '.join([*value, state, *found])}"

    # Points.

    def show_points(self, names: Sequence[str]) -> None:
        """Have points with these names, without places; none: pixels are marked."""
        self._points, self._dragged = PointLayer(names), None
        self.update()

    def place_point(self, number: int, place: Place | None) -> None:
        """Put a point somewhere, or nowhere."""
        self._points.places[number] = place
        self.update()

    def mark_points(self, marks: dict[int, bool]) -> None:
        """Mark points as right or wrong."""
        self._points.marks = marks
        self.update()

    def _paint_marks(self, painter: QPainter, placement: GridPlacement) -> None:
        """Paint the names of triangles and the points above everything."""
        super()._paint_marks(painter, placement)
        outline = self._geometry
        if outline is not None and outline.names:
            middles = outline.vertices[outline.triangles].mean(axis=1).tolist()
            paint_names(painter, placement, current_theme(), outline.names, middles)
        if self._points.names:
            self._points.paint(painter, placement, current_theme(), has_focus=self.hasFocus())

    # By mouse.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a stroke, whose first pixel decides whether it marks or clears; or take or place a point."""
        self._stroke = self._last = None
        self.gesture += 1
        if self._points.names and self._is_paintable and event.button() == Qt.MouseButton.LeftButton:
            taken = self._points.near(self.placement(), event.position())
            self._dragged = self._points.next_free() if taken is None else taken
            self._points.chosen = self._dragged
            if taken is None:
                self._drag_point(event)
            self.update()
        else:
            super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag a point, or what else was taken."""
        if self._dragged is None:
            super().mouseMoveEvent(event)
        else:
            self._drag_point(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Leave a point where it is."""
        if self._dragged is None:
            super().mouseReleaseEvent(event)
        self._dragged = None

    def _drag_point(self, event: QMouseEvent) -> None:
        assert self._dragged is not None
        x, y = self.placement().to_window(event.position())
        columns, rows = self._size
        self.point_moved.emit(self._dragged, min(max(x, 0.0), columns), min(max(y, 0.0), rows))

    @Slot(int, int)
    def _paint_at(self, column: int, row: int) -> None:
        """Paint to a pixel, also through those that a fast drag has left out."""
        if not self._is_paintable:
            return
        pixel = column, row
        if self._stroke is None:
            self._stroke = pixel not in self._marked
        self._paint(_between(self._last or pixel, pixel), self._stroke)
        self._last = pixel
        self.show_pin(pixel)

    def _paint(self, pixels: Pixels, is_marked: bool) -> None:
        changed = pixels - self._marked if is_marked else pixels & self._marked
        if changed:
            self.show_marked(self._marked | changed if is_marked else self._marked - changed)
            self.pixels_painted.emit(changed, is_marked)

    # By keyboard.

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show the pixel that Space marks first."""
        super().focusInEvent(event)
        self._begin_at_pixel()

    def _begin_at_pixel(self) -> None:
        if self._is_paintable and self.hasFocus() and self.pin() is None and not self._points.names:
            self.show_pin((0, self._size[1] - 1))

    def event(self, event: QEvent) -> bool:
        """Keep its keys from the shortcuts of the window while it is marked, also after a click."""
        if event.type() == QEvent.Type.ShortcutOverride and self._is_own(event):
            event.accept()
            return True
        return super().event(event)

    def _is_own(self, event: QEvent) -> bool:
        if not self._is_paintable or not isinstance(event, QKeyEvent) or event.modifiers() & _WINDOWS_OWN:
            return False
        return event.key() in (*_MOVES, Qt.Key.Key_Space, Qt.Key.Key_Home, Qt.Key.Key_End)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go with the arrows and mark with Space, or choose a point with Space and move it with the arrows."""
        self.gesture += 1
        key, is_shifted = Qt.Key(event.key()), bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
        if not self._is_own(event):
            super().keyPressEvent(event)
        elif self._points.names:
            self._go_points(key, is_shifted)
        else:
            self._go_pixels(key, is_shifted)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Keep Space from the base class, which pans with it."""
        if not (self._is_paintable and event.key() == Qt.Key.Key_Space):
            super().keyReleaseEvent(event)

    def _go_pixels(self, key: Qt.Key, is_shifted: bool) -> None:
        """Go to a neighbour, or to the end of the row; with Shift take the mark of this pixel along."""
        columns, rows = self._size
        pixel = self.pin() or (0, rows - 1)
        if key == Qt.Key.Key_Space:
            self._paint(frozenset({pixel}), pixel not in self._marked)
        else:
            ends = {Qt.Key.Key_Home: (-columns, 0), Qt.Key.Key_End: (columns, 0)}
            across, up = {**_MOVES, **ends}[key]
            there = min(max(pixel[0] + across, 0), columns - 1), min(max(pixel[1] + up, 0), rows - 1)
            if is_shifted:
                self._paint(_between(pixel, there), pixel in self._marked)
            self.show_pin(there)
        announce(self, self._pixel_text(self.pin() or pixel))

    def _go_points(self, key: Qt.Key, is_shifted: bool) -> None:
        """Choose the next point, or move the chosen one by steps; with Shift by pixels."""
        points = self._points
        if key == Qt.Key.Key_Space:
            points.chosen = (points.chosen + 1) % len(points.names)
            self.update()
        elif key in _MOVES:
            self.point_nudged.emit(points.chosen, *_MOVES[key], is_shifted)
        announce(self, points.text(points.chosen))


def _between(start: Pixel, end: Pixel) -> Pixels:
    """Return the pixels nearest to a straight line, both ends included."""
    count = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    steps = np.rint(np.linspace(start, end, count + 1)).astype(int)
    return frozenset((column, row) for column, row in steps.tolist())


# What all forms of answers share.


class AnswerView(QWidget):
    """A form: what is in it, and what a check found of it. Set by code, it emits nothing."""

    answer_changed = Signal()
    """The learner has changed the answer."""
    note_changed = Signal(str)
    """How what is being typed is understood; empty: nothing is to be said."""

    stop_requested = Signal()
    """A check of the answer that runs is to end."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        """Make an empty form; ``grid`` is the picture beside it."""
        super().__init__(parent)
        self._form, self._grid = form, grid

    def given(self) -> object:
        """Return what is in the form, as an answer file has it."""
        raise NotImplementedError

    def unread(self) -> str:
        """Say what is typed but is not in the answer, and why; empty: nothing."""
        return ""

    def show_given(self, given: Any) -> None:
        """Fill the form with what was in it; ``None`` empties it."""
        raise NotImplementedError

    def show_problem(self, problem: tuple[int, int, str] | None) -> None:
        """Mark line and column, from 1, at which a listing cannot run; ``None``: it can."""

    def show_marks(self, marks: Marks | None) -> None:
        """Mark what is right and what is not; ``None`` takes the marks away. Where a run decides, words say it."""

    def set_open(self, is_open: bool) -> None:
        """Take an answer, or only show it."""
        self.setEnabled(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
