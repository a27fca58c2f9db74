"""The whole picture in small, over a corner of the grid: where the magnified region is, and a way to move it."""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QImage, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import flat_button
from widgets.basics.key_claim import FocusRing, KeyClaim
from widgets.basics.theme import current_theme, theme_notifier

WIDTH = 13
"""Largest width and height of the picture, in heights of the text."""
KEY_PART = 0.25
"""Part of the region that an arrow key moves it by."""
_FRAME = 3
_LEAST_BOX = 6.0
"""Least side of the outlined region, in logical pixels: a few pixels of a large picture can be found too."""
_MOVES = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Down: (0, -1), Qt.Key.Key_Up: (0, 1)}


class Navigator(QWidget):
    """A picture with the region and the triangle in focus outlined; a drag or the arrow keys move the region.

    Places are parts of the picture's width and height, from its lower left corner.
    """

    region_moved = Signal(float, float)
    """The user wants the middle of the region here."""
    drag_ended = Signal()
    """The pointer was released: what comes next is another movement."""
    close_requested = Signal()
    """The user wants it out of the way."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._image: QImage | None = None
        self._region = QRectF(0, 0, 1, 1)
        self._triangle: NDArray[np.float64] | None = None
        self._aspect, self._most = 4 / 3, 1000
        self._grab: QPointF | None = None
        self._ring = FocusRing(self)
        KeyClaim(self, tuple(_MOVES))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setCursor(Qt.CursorShape.OpenHandCursor)
        self.setAccessibleName("Navigator: the whole picture")
        self.setToolTip("The whole picture. Drag, or press the arrow keys, to move the magnified region")
        self.close_button = flat_button("✕", "Hide the navigator", "Hide the navigator (G)", self)
        self.close_button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.close_button.setProperty("flat", False)
        self.close_button.setFixedSize(24, 24)
        self.close_button.setCursor(Qt.CursorShape.ArrowCursor)
        self.close_button.clicked.connect(self.close_requested)
        theme_notifier().theme_changed.connect(self._fit)
        self._fit()

    def show_picture(self, image: QImage | None) -> None:
        """Show the whole picture; None while there is none."""
        self._image = image
        self.update()

    def show_shape(self, aspect: float, most: int) -> None:
        """Take the shape of a picture, its width over its height, and no more than ``most`` logical pixels."""
        if (aspect, most) != (self._aspect, self._most):
            self._aspect, self._most = aspect, most
            self._fit()

    def show_region(self, region: QRectF, words: str) -> None:
        """Outline a region; ``words`` say which pixels it holds."""
        self.setAccessibleDescription(words)
        if region != self._region:
            self._region = region
            self.update()

    def show_triangle(self, corners: NDArray[np.float64] | None) -> None:
        """Outline the (3, 2) corners of the triangle in focus, or none."""
        self._triangle = corners
        self.update()

    def region(self) -> QRectF:
        """Return the region that is outlined."""
        return QRectF(self._region)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the picture, then both outlines: dark in light lines, seen on every colour."""
        del event
        theme = current_theme()
        with QPainter(self) as painter:
            painter.fillRect(self.rect(), QColor(theme.outline))
            inside = self._inside()
            painter.fillRect(inside, QColor(theme.canvas))
            if self._image is not None:
                painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
                painter.drawImage(inside, self._image)
            painter.setClipRect(inside)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            for color, width in (("#ffffff", 4.0), ("#000000", 1.6)):
                painter.setPen(QPen(QColor(color), width))
                if self._triangle is not None and self._shows_triangle(self._triangle):
                    painter.drawPolygon(QPolygonF([self._place(x, y) for x, y in self._triangle.tolist()]))
                painter.drawRect(self._box())
            painter.setClipping(False)
            self._ring.paint(painter, self.rect())

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the region where it is, or bring its middle here."""
        if event.button() != Qt.MouseButton.LeftButton:
            return
        box = self._box()
        self._grab = box.center() - event.position() if box.contains(event.position()) else QPointF()
        self.setCursor(Qt.CursorShape.ClosedHandCursor)
        self._move_to(event.position())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the region along."""
        if self._grab is not None:
            self._move_to(event.position())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Leave the region here."""
        del event
        self._grab = None
        self.setCursor(Qt.CursorShape.OpenHandCursor)
        self.drag_ended.emit()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the region by a quarter of itself."""
        move = _MOVES.get(Qt.Key(event.key()))
        if move is None:
            super().keyPressEvent(event)
            return
        middle, region = self._region.center(), self._region
        across, up = (KEY_PART * step for step in move)
        self.region_moved.emit(middle.x() + across * region.width(), middle.y() + up * region.height())
        self.drag_ended.emit()

    def _move_to(self, position: QPointF) -> None:
        assert self._grab is not None
        inside, middle = self._inside(), position + self._grab
        x = (middle.x() - inside.left()) / inside.width()
        y = (inside.bottom() - middle.y()) / inside.height()
        self.region_moved.emit(x, y)

    def _inside(self) -> QRectF:
        return QRectF(self.rect()).adjusted(_FRAME, _FRAME, -_FRAME, -_FRAME)

    def _place(self, x: float, y: float) -> QPointF:
        inside = self._inside()
        return QPointF(inside.left() + x * inside.width(), inside.bottom() - y * inside.height())

    def _shows_triangle(self, corners: NDArray[np.float64]) -> bool:
        """Return whether a triangle is large enough to be told from the outline of the region."""
        inside = self._inside()
        return bool((np.ptp(corners, axis=0) * (inside.width(), inside.height())).max() >= 2 * _LEAST_BOX)

    def _box(self) -> QRectF:
        region = self._region
        box = QRectF(self._place(region.left(), region.bottom()), self._place(region.right(), region.top()))
        room = QPointF(max(_LEAST_BOX - box.width(), 0) / 2, max(_LEAST_BOX - box.height(), 0) / 2)
        return QRectF(box.topLeft() - room, box.bottomRight() + room)

    @Slot()
    def _fit(self) -> None:
        """Take the size that the picture's shape and the text ask for."""
        side = min(WIDTH * current_theme().text_px, self._most)
        wide = max(self._aspect, 0.05)
        size = QSize(side, round(side / wide)) if wide >= 1 else QSize(round(side * wide), side)
        self.setFixedSize(size.expandedTo(QSize(48, 48)) + QSize(2 * _FRAME, 2 * _FRAME))
        self.close_button.move(self.width() - self.close_button.width(), 0)
