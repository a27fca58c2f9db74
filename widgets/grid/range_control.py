"""The colour range of a buffer: its legend, and two ends that are typed or dragged over a histogram."""

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPoint, QPointF, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QAccessible,
    QColor,
    QIcon,
    QImage,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
)
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from core.explain.number_text import parse_number
from widgets.basics.controls import button_with_tip, keep_room, row_layout
from widgets.basics.image import colormap_on, colormap_table, fitted_range, value_range
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.basics.typed_value import NumberEdit
from widgets.grid.layers import GridBuffer, number_text

# A small histogram of a buffer with a handle at each end of its colour range.


_BINS = 48
_MARGIN = 8
"""Room for half a handle at both sides."""
_BAND_HEIGHT = 6
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
            floor = self.height() - _BAND_HEIGHT - 4
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
            painter.drawImage(
                QRectF(low, floor + 2, max(high - low, 1.0), _BAND_HEIGHT), _band(self._colormap)
            )
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
    table = np.ascontiguousarray(colormap_table(colormap_on(name, current_theme())))
    return QImage(table.data, len(table), 1, 3 * len(table), QImage.Format.Format_RGB888).copy()


# The colour range of a buffer: two ends, typed or dragged over a histogram, and a button that fits them.


class RangeControl(QWidget):
    """Low end, histogram with two handles, high end, Fit and Reset.

    A right click on Fit (or the menu key) asks to keep fitting: then the owner shows buffers without a
    range of their own, which follow their values from step to step.
    """

    range_changed = Signal(float, float)
    """Low and high end, low <= high, chosen by the user."""
    range_reset = Signal()
    """The user wants the buffer's own range back."""
    fitting_changed = Signal(bool)
    """Whether the range shall follow the values from now on."""

    def __init__(self, parent: QWidget | None = None) -> None:
        """Make a control without a buffer."""
        super().__init__(parent)
        self._buffer: GridBuffer | None = None
        self._low, self._high = 0.0, 1.0
        self._keeps_fitting = False
        self._low_edit = self._make_edit("Low end of the colour range")
        self._high_edit = self._make_edit("High end of the colour range")
        self._histogram = Histogram(self)
        self._histogram.range_dragged.connect(self._choose)
        self._fit_button = button_with_tip(
            "Fit", "Fit the range to the values; right click: keep fitting", self
        )
        self._fit_button.setAccessibleName("Fit the colour range to the values")
        self._fit_button.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self._fit_button.clicked.connect(self.fit)
        self._fit_button.customContextMenuRequested.connect(self._toggle_fitting)
        self._reset_button = button_with_tip("Reset", "Back to the buffer's own range", self)
        self._reset_button.clicked.connect(self._reset)
        row = row_layout(self, 2 * current_theme().unit)
        self._parts = (self._low_edit, self._histogram, self._high_edit, self._fit_button, self._reset_button)
        for part in self._parts:
            keep_room(part)
            row.addWidget(part, 1 if part is self._histogram else 0)
        self.setAccessibleName("Colour range")
        theme_notifier().theme_changed.connect(self._take_font)
        self._take_font()
        self._show_ends()
        self.show_buffer(None)

    def show_buffer(self, buffer: GridBuffer | None) -> None:
        """Show the values and the range of a buffer; of kinds that have no range the place stays empty."""
        self._buffer = buffer
        has_range = buffer is not None and buffer.kind in ("scalar", "signed")
        self.setEnabled(has_range)
        for part in self._parts:
            part.setVisible(has_range)
        if buffer is None or not has_range:
            return
        self._histogram.show_values(buffer.values, buffer.colormap)
        self.show_range(*value_range(buffer))

    def show_range(self, low: float, high: float) -> None:
        """Show a range; emits nothing."""
        self._low, self._high = low, high
        self._histogram.show_range(low, high)
        self._show_ends()

    def keeps_fitting(self) -> bool:
        """Return whether the range shall follow the values."""
        return self._keeps_fitting

    def set_keeps_fitting(self, keeps: bool) -> None:
        """Say whether the range follows the values; emits nothing."""
        self._keeps_fitting = keeps
        self._fit_button.setText("Fitting" if keeps else "Fit")
        self._fit_button.setCheckable(keeps)
        self._fit_button.setChecked(keeps)

    def fit(self) -> None:
        """Take the smallest and largest finite value, as the user's wish; a kept fit ends."""
        if self._keeps_fitting:
            self.set_keeps_fitting(False)
            self.fitting_changed.emit(False)
        elif self._buffer is not None:
            low, high = fitted_range(self._buffer.values)
            if self._buffer.kind == "signed":
                high = max(abs(low), abs(high))
                low = -high
            self._choose(low, high)
            self._histogram.show_range(self._low, self._high)

    def _choose(self, low: float, high: float) -> None:
        """Take over a range that the user chose, and tell; a signed buffer's range is symmetric about 0."""
        if self._buffer is not None and self._buffer.kind == "signed":
            # The end that moved leads.
            reach = abs(low) if low != self._low else abs(high)
            low, high = -reach, reach
            self._histogram.show_range(low, high)
        if (low, high) == (self._low, self._high):
            return
        if self._keeps_fitting:
            self.set_keeps_fitting(False)
            self.fitting_changed.emit(False)
        self._low, self._high = low, high
        self._show_ends()
        self.range_changed.emit(low, high)

    def _type_ends(self) -> None:
        """Take typed ends; text that is not a number, or ends in the wrong order, are put back, and it is said why."""
        ends = (self._low_edit, self._low), (self._high_edit, self._high)
        try:
            # An end that was not touched keeps its full precision.
            low, high = (parse_number(edit.text()) if edit.isModified() else end for edit, end in ends)
            if low > high:
                raise ValueError(
                    f"expected the lower end first, got {number_text(low)} and {number_text(high)}"
                )
        except ValueError as problem:
            next(edit for edit, _ in reversed(ends) if edit.isModified()).tell(str(problem))
        else:
            self._choose(low, high)
            self._histogram.show_range(self._low, self._high)
        self._show_ends()

    def _toggle_fitting(self, position: QPoint) -> None:
        """Begin or end to keep fitting, and report it."""
        self.set_keeps_fitting(not self._keeps_fitting)
        self.fitting_changed.emit(self._keeps_fitting)

    def _reset(self) -> None:
        """Tell that the user wants the buffer's own range."""
        if self._keeps_fitting:
            self.set_keeps_fitting(False)
            self.fitting_changed.emit(False)
        self.range_reset.emit()

    def _show_ends(self) -> None:
        """Write both ends with four digits; full precision as a tooltip."""
        for edit, value in ((self._low_edit, self._low), (self._high_edit, self._high)):
            edit.setText(number_text(float(value)))
            edit.setToolTip(number_text(float(value), 0))

    def _make_edit(self, name: str) -> NumberEdit:
        """Return a field for one end."""
        edit = NumberEdit(self)
        edit.setAccessibleName(name)
        edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        edit.editingFinished.connect(self._type_ends)
        return edit

    def _take_font(self) -> None:
        """Use tabular figures at the present theme's size, and room for nine of them."""
        font = text_font(current_theme())
        for edit in (self._low_edit, self._high_edit):
            edit.setFont(font)
            edit.setFixedWidth(edit.fontMetrics().horizontalAdvance("0") * 9 + 12)


# The colour range of the main grid in two numbers: a legend that opens the control of the range.


_BAND_SIZE = QSize(40, 10)


class RangeButton(QToolButton):
    """Shows the colours and both ends of the range; the control opens below it, over the grid."""

    def __init__(self, control: RangeControl, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._control = control
        self._buffer: GridBuffer | None = None
        self._colormap = ""
        self.setCheckable(True)
        self.setProperty("flat", True)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setIconSize(_BAND_SIZE)
        self.setToolTip("The colour range of the picture: click to change it")
        self.toggled.connect(self._open)
        self.show_buffer(None)

    def show_buffer(self, buffer: GridBuffer | None) -> None:
        """Show the range of a buffer; kinds that have none leave the place empty."""
        self._buffer = buffer
        if buffer is None or buffer.kind not in ("scalar", "signed"):
            self.setChecked(False)
            self.hide()
            return
        low, high = value_range(buffer)
        text = f"{number_text(low, 3)} … {number_text(high, 3)}"
        if text != self.text():
            self.setText(text)
            self.setAccessibleName(f"Colour range {number_text(low, 3)} to {number_text(high, 3)}")
        self._show_colors(buffer.colormap)
        self.show()
        if self.isChecked():
            self._control.show_buffer(buffer)

    def _show_colors(self, colormap: str) -> None:
        colormap = colormap_on(colormap, current_theme())
        if colormap == self._colormap:
            return
        self._colormap = colormap
        table = colormap_table(colormap)
        band = QImage(table.tobytes(), len(table), 1, 3 * len(table), QImage.Format.Format_RGB888)
        self.setIcon(QIcon(QPixmap.fromImage(band.scaled(_BAND_SIZE))))

    @Slot(bool)
    def _open(self, is_open: bool) -> None:
        if is_open:
            self._control.show_buffer(self._buffer)
        self._control.setVisible(is_open)
