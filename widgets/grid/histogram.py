"""A small histogram of a buffer with a handle at each end of its colour range."""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QAccessible, QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from widgets.basics.colormaps import colormap_table
from widgets.basics.theme import current_theme, theme_notifier

_BINS = 48
_MARGIN = 8
"""Room for half a handle at both sides."""
_BAND = 6
"""Height of the colour band under the bars."""


class Histogram(QWidget):
    """Bars of how often values occur, the colormap's band over the range, and two handles to drag.

    The horizontal axis runs over all finite values and the range, with a little room at both sides.
    """

    spoken_role = QAccessible.Role.Chart

    range_dragged = Signal(float, float)
    """Low and high while the user drags a handle; low <= high."""

    def __init__(self, parent: QWidget | None = None) -> None:
        """Make a histogram without values."""
        super().__init__(parent)
        self._counts = np.zeros(_BINS)
        self._extent = (0.0, 1.0)
        """Smallest and largest finite value."""
        self._axis = (0.0, 1.0)
        self._low, self._high = 0.0, 1.0
        self._colormap = "viridis"
        self._held = -1
        """0 while the low handle is dragged, 1 for the high one, else -1."""
        self._hovered = -1
        self.setMouseTracking(True)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setToolTip("Drag a handle to set an end of the colour range")
        self.setAccessibleName("Histogram")
        theme_notifier().theme_changed.connect(self.update)

    def show_values(self, values: NDArray[np.generic], colormap: str) -> None:
        """Show how often the finite values of an array of any shape occur, and the band of a colormap."""
        floats = values.astype(np.float64).ravel()
        floats = floats[np.isfinite(floats)]
        self._colormap = colormap
        if floats.size:
            low, high = float(floats.min()), float(floats.max())
            self._extent = (low, high)
            span = high - low
            if 0 < span < np.inf:
                bins = np.minimum(((floats - low) / span * _BINS).astype(np.intp), _BINS - 1)
                self._counts = np.bincount(bins, minlength=_BINS).astype(np.float64)
            else:
                self._counts = np.zeros(_BINS)
                self._counts[_BINS // 2] = floats.size
        else:
            self._extent, self._counts = (0.0, 1.0), np.zeros(_BINS)
        self._fit_axis()

    def show_range(self, low: float, high: float) -> None:
        """Put the handles at the ends of a range; emits nothing."""
        self._low, self._high = low, high
        if self._held < 0:
            self._fit_axis()
        self.update()

    def sizeHint(self) -> QSize:
        """Return a size that leaves the bars readable."""
        return QSize(160, 40)

    def minimumSizeHint(self) -> QSize:
        """Return the least size at which a handle can be taken."""
        return QSize(40, 40)

    def position_of(self, value: float) -> float:
        """Return the widget x of a value."""
        low, high = self._axis
        span = high / 2 - low / 2
        part = (value / 2 - low / 2) / span if span > 0 else 0.5
        return _MARGIN + part * (self.width() - 2 * _MARGIN)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint bars, band and handles; switched off, nothing: they would be those of another buffer."""
        if not self.isEnabled():
            return
        theme = current_theme()
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            floor = self.height() - _BAND - 4
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(theme.outline))
            # One full bar of background must not flatten the others: the scale follows the second highest.
            scale = max(float(np.sort(self._counts)[-2]) * 1.25, 1.0)
            heights = np.sqrt(np.minimum(self._counts / scale, 1.0)) * (floor - 6)
            left, right = self.position_of(self._extent[0]), self.position_of(self._extent[1])
            if right - left < 4:
                left, right = left - 2, right + 2
                painter.drawRect(QRectF(left, 4, right - left, floor - 4 if self._counts.any() else 0))
            else:
                width = (right - left) / _BINS
                bars = [
                    QRectF(left + index * width, floor - height, max(width - 0.5, 0.5), height)
                    for index, height in enumerate(heights.tolist())
                    if height > 0
                ]
                painter.drawRects(bars)
            low, high = self.position_of(self._low), self.position_of(self._high)
            painter.drawImage(QRectF(low, floor + 2, max(high - low, 1.0), _BAND), _band(self._colormap))
            for index, x in enumerate((low, high)):
                strong = index in (self._held, self._hovered)
                painter.setPen(QPen(QColor(theme.text), 2.0 if strong else 1.4))
                painter.drawLine(QPointF(x, 2), QPointF(x, self.height() - 2))
                painter.setPen(QPen(QColor(theme.panel), 1.0))
                painter.setBrush(QColor(theme.text))
                reach = 6.0 if strong else 5.0
                painter.drawPolygon(
                    QPolygonF([QPointF(x - reach, 0), QPointF(x + reach, 0), QPointF(x, reach * 1.6)])
                )
                painter.setBrush(Qt.BrushStyle.NoBrush)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take the handle that is nearer, from anywhere: a click moves it there."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._held = self._nearer(event.position().x())
            self._drag(event.position().x())

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Drag the handle that was taken."""
        x = event.position().x()
        if self._held >= 0:
            self._drag(x)
        else:
            near = self._nearer(x)
            at = self.position_of((self._low, self._high)[near])
            self._hovered = near if abs(x - at) <= 8 else -1
            self.setCursor(Qt.CursorShape.SplitHCursor if self._hovered >= 0 else Qt.CursorShape.ArrowCursor)
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Let the handle go."""
        if self._held >= 0:
            self._held = -1
            self._fit_axis()

    def _nearer(self, x: float) -> int:
        """Return 0 or 1: the handle nearer to widget ``x``; of two at one place, the one on that side."""
        low, high = self.position_of(self._low), self.position_of(self._high)
        return 0 if abs(x - low) < abs(x - high) or (low == high and x < low) else 1

    def _drag(self, x: float) -> None:
        """Move the held handle to widget ``x``, but not past the other."""
        part = (x - _MARGIN) / max(self.width() - 2 * _MARGIN, 1)
        part = min(max(part, 0.0), 1.0)
        value = self._axis[0] * (1 - part) + self._axis[1] * part
        if self._held == 0:
            self._low = min(value, self._high)
        else:
            self._high = max(value, self._low)
        self.update()
        self.range_dragged.emit(self._low, self._high)

    def _fit_axis(self) -> None:
        """Let the axis hold all values and both handles, with room to drag outward."""
        low, high = min(self._extent[0], self._low), max(self._extent[1], self._high)
        room = 0.05 * (high / 2 - low / 2) * 2 if np.isfinite(high - low) else 0.0
        if high <= low:
            room = max(abs(low) * 0.5, 0.5)
        self._axis = (low - room, high + room)
        self.update()


def _band(name: str) -> QImage:
    """Return a colormap as an image of one row."""
    table = np.ascontiguousarray(colormap_table(name))
    return QImage(table.data, len(table), 1, 3 * len(table), QImage.Format.Format_RGB888).copy()
