"""A pixel grid that is answered on: click, drag, or arrows and Space mark pixels."""

import numpy as np
from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QWidget

from widgets.basics.accessible import announce
from widgets.exercises.records import Pixel, PixelMarks, Pixels
from widgets.grid.buffer import GridBuffer
from widgets.grid.geometry import GridGeometry
from widgets.grid.overlay import Mark, MaskOverlay
from widgets.grid.pixel_grid import PixelGrid

NOTHING: Pixels = frozenset()
_MOVES = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}


class MarkGrid(PixelGrid):
    """Shows a raster with its outlines and the pixels that the learner has marked; nothing else is in its buffer."""

    pixels_painted = Signal(object, bool)
    """Pixels, and whether they are marked now."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._size = (1, 1)
        self._marked = NOTHING
        self._is_paintable = False
        self._stroke: bool | None = None
        """What the drag in progress does to pixels; ``None``: the next one decides."""
        self._last: Pixel | None = None
        self.pixel_clicked.connect(self._paint_at)

    def show_raster(self, size: tuple[int, int], geometry: GridGeometry | None, pixel: Pixel | None) -> None:
        """Show an empty raster of (columns, rows) with outlines; ``pixel`` is what the question is about."""
        self._size, self._marked = size, NOTHING
        self.fit()
        self._show_marked()
        self.show_geometry(geometry)
        self.show_overlays(())
        self.show_pin(pixel)

    def set_paintable(self, is_paintable: bool) -> None:
        """Let clicks and keys mark pixels."""
        self._is_paintable = is_paintable
        self.set_brush(is_paintable)

    def marked(self) -> Pixels:
        """Return the marked pixels."""
        return self._marked

    def show_marked(self, pixels: Pixels) -> None:
        """Mark these pixels, and no others."""
        self._marked = pixels
        self._show_marked()

    def show_marks(self, marks: PixelMarks | None) -> None:
        """Mark what is right, missing, extra or double, each by a shape of its own."""
        if marks is None:
            self.show_overlays(())
            return
        kinds = (
            ("right", Mark.RIGHT, marks.right),
            ("missing", Mark.MISSING, marks.missing),
            ("extra", Mark.EXTRA, marks.extra),
            ("double", Mark.DOUBLE, marks.double),
        )
        self.show_overlays([MaskOverlay(key, mark, self._mask(pixels)) for key, mark, pixels in kinds])

    def _mask(self, pixels: Pixels) -> np.ndarray:
        mask = np.zeros(self._size[::-1], bool)
        if pixels:
            columns, rows = np.array(sorted(pixels)).T
            mask[rows, columns] = True
        return mask

    def _show_marked(self) -> None:
        self.show_buffer(GridBuffer("marked", self._mask(self._marked), "bool", title="your marks"))

    def spoken_description(self) -> str:
        """Return what a screen reader says of the pixel that the keyboard is at."""
        if not self._is_paintable or self.pin() is None:
            return super().spoken_description()
        return f"{self._pixel_text(self.pin() or (0, 0))}. {len(self._marked)} marked."

    def _pixel_text(self, pixel: Pixel) -> str:
        found = [
            overlay.label
            for overlay in self.overlays()
            if isinstance(overlay, MaskOverlay) and overlay.mask[pixel[1], pixel[0]]
        ]
        state = "marked" if pixel in self._marked else "not marked"
        return f"Pixel {pixel[0]}, {pixel[1]}: {', '.join([state, *found])}"

    # By mouse.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a stroke: its first pixel decides whether it marks or clears."""
        self._stroke = self._last = None
        super().mousePressEvent(event)

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

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go with the arrows, Home and End; mark with Space; with Shift take the mark of this pixel along."""
        if self._is_paintable and self.pin() is None and event.key() in (*_MOVES, Qt.Key.Key_Space):
            self.show_pin((0, self._size[1] - 1))
            announce(self, self._pixel_text((0, self._size[1] - 1)))
            return
        pixel, columns = self.pin(), self._size[0]
        moves = {**_MOVES, Qt.Key.Key_Home: (-columns, 0), Qt.Key.Key_End: (columns, 0)}
        key = Qt.Key(event.key())
        if not self._is_paintable or pixel is None or event.modifiers() & ~Qt.KeyboardModifier.ShiftModifier:
            super().keyPressEvent(event)
        elif key == Qt.Key.Key_Space:
            self._paint(frozenset({pixel}), pixel not in self._marked)
            announce(self, self._pixel_text(pixel))
        elif key in moves:
            across, up = moves[key]
            there = (
                min(max(pixel[0] + across, 0), columns - 1),
                min(max(pixel[1] + up, 0), self._size[1] - 1),
            )
            if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
                self._paint(_between(pixel, there), pixel in self._marked)
            self.show_pin(there)
            announce(self, self._pixel_text(there))
        else:
            super().keyPressEvent(event)


def _between(start: Pixel, end: Pixel) -> Pixels:
    """Return the pixels nearest to a straight line, both ends included."""
    count = max(abs(end[0] - start[0]), abs(end[1] - start[1]))
    steps = np.rint(np.linspace(start, end, count + 1)).astype(int)
    return frozenset((column, row) for column, row in steps.tolist())
