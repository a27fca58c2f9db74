"""A chart under the pointer and the keyboard: points are hovered, chosen, and gone to by arrows."""

from math import hypot

from PySide6.QtCore import QEvent, QPointF, QRectF, QSizeF, Qt, Signal
from PySide6.QtGui import QAccessible, QColor, QFontMetricsF, QKeyEvent, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import QWidget

from widgets.basics.accessibility import FocusRing, announce
from widgets.basics.drawing import LabelPlaces, paint_empty
from widgets.basics.theme import current_theme, faded, text_font
from widgets.experiments.chart_canvas import ChartCanvas, axis_text
from widgets.experiments.series import (
    MOST_NAMED,
    ChartEmpty,
    ChartMark,
    ChartPicture,
    ChartSeries,
    series_color,
)

_NEAR = 18.0
"""Pixels within which a point is pointed at."""
_CLICK = 5.0
"""Pixels that the pointer may move between press and release of a click."""
_FURTHER = (1.0, 2.5, 5.0, 8.0, 12.0)
"""How far from its mark a name may stand, in halves of the mark's width; further off a line leads to it."""
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, -1),
    Qt.Key.Key_Down: (0, 1),
}
_ADDS = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier


class Chart(ChartCanvas):
    """Shows series of points and reports which one the user points at and chooses."""

    spoken_role = QAccessible.Role.Chart

    series_hovered = Signal(str)
    """Key of the series under the pointer, or gone to by an arrow key."""
    point_hovered = Signal(str, int)
    """The same with the number of the point in its series; -1 is the last."""
    series_left = Signal()
    """The pointer is on no point any more."""
    series_chosen = Signal(str, bool)
    """Key of a series that was clicked or entered, and whether Ctrl or Shift asks for it beside another one."""
    point_chosen = Signal(str, int)
    """Key of a series and number of the point in it that was clicked."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._empty = ChartEmpty("")
        self._pointed = ""
        self._index = -1
        """Which of its points."""
        self._marks: ChartMark = {}
        self._pressed_at: QPointF | None = None
        self._ring = FocusRing(self, self.viewport())
        self.setAccessibleName(name)

    # Showing.

    def show_picture(self, picture: ChartPicture | ChartEmpty | None) -> None:
        """Show series, or say why there are none; one that is no longer there is not pointed at any more."""
        if isinstance(picture, ChartEmpty):
            self._empty, picture = picture, None
        super().show_picture(picture)
        if picture is None or self._pointed not in {series.key for series in picture.series}:
            self._pointed, self._index = "", -1

    def show_pointed(self, key: str, index: int = -1) -> None:
        """Mark the series that is pointed at elsewhere, at its last point or another one; empty: none."""
        if (key, index) != (self._pointed, self._index):
            self._pointed, self._index = key, index
            self.viewport().update()

    def spoken_description(self) -> str:
        """Return what a screen reader says of the point that is pointed at, or of the chart."""
        picture = self.picture
        if picture is None:
            return self._empty.text
        axes = picture.x_axis, picture.y_axis
        for series in picture.series:
            if series.key == self._pointed:
                at = float(series.x[self._index]), float(series.y[self._index])
                texts = (
                    f"{axis.label} {axis_text(value, axis.unit)}"
                    for axis, value in zip(axes, at, strict=True)
                )
                return f"{series.title}: {', '.join(texts)}"
        return f"{len(picture.series)} series. Across: {axes[0].label}. Up: {axes[1].label}."

    def show_marks(self, marks: ChartMark) -> None:
        """Mark the chosen series with letters."""
        self._marks = dict(marks)
        self.viewport().update()

    @property
    def pointed(self) -> str:
        """Key of the series that is pointed at; empty: none."""
        return self._pointed

    # Pointer.

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Remember where a click begins; pyqtgraph pans."""
        self._pressed_at = event.position()
        super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Choose the point under a click."""
        pressed_at, self._pressed_at = self._pressed_at, None
        super().mouseReleaseEvent(event)
        if pressed_at is None or event.button() != Qt.MouseButton.LeftButton:
            return
        moved = event.position() - pressed_at
        key, index = self._near(event.position())
        if key and hypot(moved.x(), moved.y()) <= _CLICK:
            self.series_chosen.emit(key, bool(event.modifiers() & _ADDS))
            self.point_chosen.emit(key, index)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Show everything, after a double click beside the points."""
        super().mouseDoubleClickEvent(event)
        if not self._near(event.position())[0]:
            self.fit()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Point at the nearest series."""
        super().mouseMoveEvent(event)
        self._point_at(*self._near(event.position()))

    def leaveEvent(self, event: QEvent) -> None:
        """Point at nothing."""
        super().leaveEvent(event)
        self._point_at("")

    def _near(self, at: QPointF) -> tuple[str, int]:
        """Return key and number of the nearest point that is near, or no key."""
        distances = [(hypot(p.x() - at.x(), p.y() - at.y()), key, index) for key, index, p in self.points()]
        near = [found for found in distances if found[0] <= _NEAR]
        return min(near)[1:] if near else ("", -1)

    def _point_at(self, key: str, index: int = -1) -> None:
        if (key, index) == (self._pointed, self._index):
            return
        is_another = key != self._pointed
        self.show_pointed(key, index)
        if key:
            announce(self, self.spoken_description())
        if not key:
            self.series_left.emit()
            return
        if is_another:
            self.series_hovered.emit(key)
        self.point_hovered.emit(key, index)

    # Keyboard.

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go to the neighbouring point with an arrow, choose with Enter; other keys belong to the page."""
        key = Qt.Key(event.key())
        if key in _ARROWS:
            self._go(*_ARROWS[key])
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space) and self._pointed:
            self.series_chosen.emit(self._pointed, bool(event.modifiers() & _ADDS))
        else:
            event.ignore()

    def _go(self, across: int, down: int) -> None:
        """Point at the next series to one side: by x where ``across``, else by y; of a line its last point counts."""
        found = [] if self.picture is None else [(s.key, self.place_of(s.key)) for s in self.picture.series]
        places = [(at.x(), at.y(), key) for key, at in found if at is not None]
        ranked = sorted(places if across else ((y, x, key) for x, y, key in places))
        keys = [key for _, _, key in ranked]
        if self._pointed not in keys:
            self._point_at(keys[0] if keys else "")
            return
        index = keys.index(self._pointed) + across + down
        self._point_at(keys[min(max(index, 0), len(keys) - 1)])

    # Painting what lies over the chart.

    def drawForeground(self, painter: QPainter, rect: QRectF) -> None:
        """Write the names, mark what is pointed at and chosen."""
        theme = current_theme()
        area = self.sceneRect()
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self.picture is None:
            paint_empty(painter, area.toRect(), self._empty.text, theme)
        else:
            self.paint_series(painter, self.picture)
            self._paint_titles(painter, self.picture)
            self._paint_pointed_line(painter, self.picture)
            self._paint_rings(painter, self.picture)
            self._paint_names(painter, self.picture)
        self._ring.paint(painter, area.toRect())
        painter.restore()

    def _paint_titles(self, painter: QPainter, picture: ChartPicture) -> None:
        """Write what is on the axes: over the one that goes up, under the one that goes across."""
        theme = current_theme()
        font = text_font(theme)
        metrics = QFontMetricsF(font)
        area, whole = self.plot_area(), self.sceneRect()
        painter.setFont(font)
        painter.setPen(QColor(theme.text))
        left, right = whole.left() + 8, whole.right() - 8
        for record, top, flag in (
            (picture.y_axis, whole.top() + 4, Qt.AlignmentFlag.AlignLeft),
            (picture.x_axis, whole.bottom() - metrics.height() - 4, Qt.AlignmentFlag.AlignRight),
        ):
            text = metrics.elidedText(record.label, Qt.TextElideMode.ElideRight, right - left)
            end = area.right() if flag == Qt.AlignmentFlag.AlignRight else right
            painter.drawText(QRectF(left, top, end - left, metrics.height()), int(flag), text)

    def _paint_pointed_line(self, painter: QPainter, picture: ChartPicture) -> None:
        """Draw the line that is pointed at once more, bold: it stands out among many."""
        for series in picture.series:
            if series.key == self._pointed:
                painter.setPen(QPen(QColor(series_color(series.number)), 3.5))
                painter.save()
                painter.setClipRect(self.plot_area())
                self.paint_line(painter, series)
                painter.restore()

    def _paint_rings(self, painter: QPainter, picture: ChartPicture) -> None:
        """Ring what is pointed at and chosen, and twice what stands out: of a line its best or last point."""
        theme = current_theme()
        reach = 0.9 * self.mark_size()
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for series in picture.series:
            at = self.place_of(series.key, self._index if series.key == self._pointed else -1)
            stands_out = at if series.key in picture.ringed else None
            if series.best >= 0:
                stands_out = self.place_of(series.key, series.best)
            if stands_out is not None:
                painter.setPen(QPen(QColor(theme.text), 2.0))
                for share in (1.0, 1.4):
                    painter.drawEllipse(stands_out, share * reach, share * reach)
            if at is not None and (series.key in self._marks or series.key == self._pointed):
                painter.setPen(QPen(QColor(theme.text), 2.0 if series.key in self._marks else 1.4))
                painter.drawEllipse(at, reach, reach)

    def _paint_names(self, painter: QPainter, picture: ChartPicture) -> None:
        """Write the names of series beside their last points, where there is room."""
        theme = current_theme()
        font = text_font(theme, theme.small_px)
        metrics = QFontMetricsF(font)
        painter.setFont(font)
        reach = 0.6 * self.mark_size()
        area = self.plot_area()
        places = LabelPlaces(area.adjusted(2, 2, -2, -2))
        for _, at in self.places():
            places.take(QRectF(at.x() - reach, at.y() - reach, 2 * reach, 2 * reach))
        if len(picture.series) <= MOST_NAMED:  # Of more, a name on a bar is better than none.
            for bar in self.bars():
                places.take(bar)
            for line in self.front_lines():
                places.avoid(line)
        for series in self.named_series():
            end = self.place_of(series.key, self._index if series.key == self._pointed else -1)
            letter = self._marks.get(series.key, "")
            if end is None:
                continue
            text = f"{letter}: {series.title}" if letter else series.title
            size = QSizeF(metrics.horizontalAdvance(text) + 4, metrics.height())
            found = places.find(end, size, reach, _FURTHER)
            if found is None:
                continue
            is_strong = series.key == self._pointed or bool(letter) or series.key in picture.ringed
            self._paint_leader(painter, end, found, reach)
            painter.fillRect(found, faded(theme.panel, 0.75))
            painter.setPen(QColor(theme.text if is_strong else series_color(series.number)))
            painter.drawText(found, int(Qt.AlignmentFlag.AlignCenter), text)

    def named_series(self) -> list[ChartSeries]:
        """Return the series whose names are written, `MOST_NAMED` at most; the list beside the chart has the others.

        What is pointed at comes first, then what was chosen or stands out, then the front.
        """
        picture = self.picture
        if picture is None:
            return []
        first = ({self._pointed}, self._marks.keys(), set(picture.ringed), set(picture.front))
        wanted = sorted(picture.series, key=lambda s: [s.key not in keys for keys in first])
        if not picture.is_named:
            wanted = [series for series in wanted if series.key == self._pointed or series.key in self._marks]
        return wanted[:MOST_NAMED]

    def _paint_leader(self, painter: QPainter, at: QPointF, label: QRectF, reach: float) -> None:
        """Draw a thin line from a point to a name that found its place further off."""
        end = QPointF(
            min(max(at.x(), label.left()), label.right()), min(max(at.y(), label.top()), label.bottom())
        )
        if hypot(end.x() - at.x(), end.y() - at.y()) > 2.2 * reach:
            painter.setPen(QPen(QColor(current_theme().outline), 1.0))
            painter.drawLine(at, end)
