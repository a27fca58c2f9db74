"""The margin of a listing: line numbers, breakpoints, and the arrow of the line that has just run."""

from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPolygonF
from PySide6.QtWidgets import QWidget

from widgets.basics.marks import Mark, blended, draw_mark
from widgets.basics.theme import current_theme

if TYPE_CHECKING:
    from widgets.inspector.listing import ListingView


class ListingMargin(QWidget):
    """Paints itself beside the lines of its view, which places it."""

    line_clicked = Signal(int)
    """The line (from 1) that was clicked."""

    def __init__(self, view: "ListingView") -> None:
        super().__init__(view)
        self._view = view
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setToolTip("Click: set or clear a breakpoint on this line")
        self.setAccessibleName("Breakpoint margin")

    def wanted_width(self) -> int:
        """Return the room for a mark and the largest line number."""
        digits = max(2, len(str(self._view.blockCount())))
        return self._view.fontMetrics().horizontalAdvance("0") * digits + self._mark_size() + 13

    def sizeHint(self) -> QSize:
        """Be as wide as that."""
        return QSize(self.wanted_width(), 0)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Pass a click on."""
        line = self._view.line_at(event.position().toPoint().y())
        if event.button() == Qt.MouseButton.LeftButton and line is not None:
            self.line_clicked.emit(line)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw breakpoints as discs, the present line as an arrow with the accent bar."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(event.rect(), QColor(current_theme().panel))
        painter.setFont(self._view.font())
        for line, box in self._view.visible_lines():
            if box.top() > event.rect().bottom():
                break
            self._paint_line(painter, line, QRect(0, round(box.top()), self.width(), round(box.height())))

    def _paint_line(self, painter: QPainter, line: int, row: QRect) -> None:
        theme, view = current_theme(), self._view
        size, line_height = float(self._mark_size()), view.fontMetrics().lineSpacing()
        # A line that is wrapped has its number and marks beside its beginning.
        middle = row.top() + line_height / 2
        is_current = line == view.line
        if is_current:
            painter.fillRect(row, blended(theme.accent, theme.panel, 0.14))
            painter.fillRect(QRect(0, row.top(), 4, row.height()), QColor(theme.accent))
        if line in view.breakpoints:
            draw_mark(painter, Mark.BREAKPOINT, QRectF(7.0, middle - size / 2, size, size))
        if is_current:
            ends = (8, middle - size / 2 + 1), (8 + size, middle), (8, middle + size / 2 - 1)
            painter.setPen(QColor(theme.panel))
            painter.setBrush(QColor(theme.accent))
            painter.drawPolygon(QPolygonF([QPointF(*end) for end in ends]))
        elif line == view.chosen_line:
            painter.setPen(QColor(theme.focus))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(row.adjusted(2, 0, -3, -1))
        painter.setPen(QColor(theme.text if is_current else theme.muted_text))
        first = QRect(row.left(), row.top(), row.width() - 3, line_height)
        painter.drawText(first, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter, str(line))

    def _mark_size(self) -> int:
        return max(9, round(self._view.fontMetrics().height() * 0.62))
