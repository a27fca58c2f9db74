"""Code with line numbers: what a listing that is read, and one that is edited, have in common."""

from collections.abc import Iterator, Mapping

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QFontDatabase,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPolygonF,
    QResizeEvent,
    QTextCharFormat,
    QTextCursor,
    QTextOption,
)
from PySide6.QtWidgets import QFrame, QPlainTextEdit, QTextEdit, QWidget

from widgets.basics.marks import Mark, blended, draw_mark, paint_share
from widgets.basics.theme import current_theme, theme_notifier


class CodeView(QPlainTextEdit):
    """Code in the type of listings, with a margin; the present line has bar, arrow and tint, changed ones a star."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._line: int | None = None
        self._breakpoints: frozenset[int] = frozenset()
        self._changed_lines: frozenset[int] = frozenset()
        self._shares: Mapping[int, float] = {}
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWordWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setCornerWidget(QWidget(self))
        self.margin = CodeMargin(self)
        self.updateRequest.connect(self._follow_scroll)
        theme_notifier().theme_changed.connect(self._follow_theme)

    @property
    def line(self) -> int | None:
        """The line of the step just done."""
        return self._line

    @property
    def chosen_line(self) -> int | None:
        """The line that the keys are on, if the listing has the focus."""
        return self.textCursor().blockNumber() + 1 if self.hasFocus() else None

    @property
    def breakpoints(self) -> frozenset[int]:
        """The lines that have a breakpoint."""
        return self._breakpoints

    @property
    def changed_lines(self) -> frozenset[int]:
        """The lines, from 1, that differ from those of the other version."""
        return self._changed_lines

    def show_changed_lines(self, lines: frozenset[int]) -> None:
        """Mark the lines that differ from those of the other version."""
        if lines != self._changed_lines:
            self._changed_lines = lines
            self.place_margin()
            self.margin.update()

    @property
    def shares(self) -> Mapping[int, float]:
        """The lines, from 1, of a shader, each with the share of vertices or fragments that run it."""
        return self._shares

    def show_shares(self, shares: Mapping[int, float]) -> None:
        """Draw a bar beside each of these lines."""
        if shares != self._shares:
            self._shares = shares
            self.margin.update()

    def visible_lines(self) -> Iterator[tuple[int, QRectF]]:
        """Return the lines (from 1) that are in sight, and where each stands in the viewport."""
        block = self.firstVisibleBlock()
        while block.isValid() and not self.document().isEmpty():
            if block.isVisible():
                box = self.blockBoundingGeometry(block).translated(self.contentOffset())
                yield block.blockNumber() + 1, box
            block = block.next()

    def line_at(self, y: int) -> int | None:
        """Return the line (from 1) drawn at height `y` of the viewport; None below the last."""
        return next((line for line, box in self.visible_lines() if box.top() <= y < box.bottom()), None)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the margin beside the text."""
        super().resizeEvent(event)
        self.place_margin()

    def place_margin(self) -> None:
        """Put the margin beside the text."""
        width = self.margin.wanted_width()
        self.setViewportMargins(width, 0, 0, 0)
        inside = self.contentsRect()
        self.margin.setGeometry(inside.left(), inside.top(), width, inside.height())

    @Slot(QRect, int)
    def _follow_scroll(self, area: QRect, dy: int) -> None:
        if dy:
            self.margin.scroll(0, dy)
        else:
            self.margin.update(0, area.y(), self.margin.width(), area.height())

    def line_marks(self) -> list[QTextEdit.ExtraSelection]:
        """Return the tints of the present line, and of the one that the keys are on."""
        theme = current_theme()
        marks = []
        if self.chosen_line not in (None, self._line):
            marks.append(self._line_mark(self.textCursor(), QColor(theme.selection)))
        if self._line is not None:
            block = self.document().findBlockByNumber(self._line - 1)
            if block.isValid():
                marks.append(self._line_mark(QTextCursor(block), blended(theme.accent, theme.panel, 0.14)))
        return marks

    def mark_line(self) -> None:
        """Mark the present line and the chosen one."""
        self.setExtraSelections(self.line_marks())
        self.margin.update()

    @staticmethod
    def _line_mark(cursor: QTextCursor, color: QColor) -> QTextEdit.ExtraSelection:
        cursor.movePosition(QTextCursor.MoveOperation.StartOfBlock)
        cursor.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
        mark = QTextEdit.ExtraSelection()
        mark.format.setBackground(color)
        mark.format.setProperty(int(QTextCharFormat.Property.FullWidthSelection), True)
        mark.cursor = cursor
        return mark

    @Slot()
    def _follow_theme(self) -> None:
        self.follow_theme()

    def follow_theme(self) -> None:
        """Take over type and colours."""
        theme = current_theme()
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPixelSize(theme.code_px)
        self.setFont(font)
        self.viewport().setFont(font)  # of the hint
        palette = self.palette()
        palette.setColor(QPalette.ColorRole.Base, QColor(theme.panel))
        palette.setColor(QPalette.ColorRole.PlaceholderText, QColor(theme.muted_text))
        self.setPalette(palette)
        self.mark_line()
        self.place_margin()


class CodeMargin(QWidget):
    """Paints itself beside the lines of its view, which places it."""

    line_clicked = Signal(int)
    """The line (from 1) that was clicked."""

    def __init__(self, view: CodeView) -> None:
        super().__init__(view)
        self._view = view
        self.setAccessibleName("Line numbers")

    def wanted_width(self) -> int:
        """Return the room for a mark, a star and the largest line number."""
        digits = max(2, len(str(self._view.blockCount()))) + bool(self._view.changed_lines)
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
        """Draw breakpoints as discs, the present line as an arrow with the accent bar, changed lines with a star."""
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
        is_changed = line in view.changed_lines
        painter.setPen(QColor(theme.text if is_current or is_changed else theme.muted_text))
        first = QRect(row.left(), row.top(), row.width() - 3, line_height)
        number = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(first, number, f"*{line}" if is_changed else str(line))
        if line in view.shares:
            room = QRect(7, first.bottom() - 2, row.width() - 10, 3)
            paint_share(painter, room, view.shares[line])
        if is_changed:
            painter.fillRect(QRect(row.right() - 1, row.top(), 2, row.height()), QColor(theme.text))

    def _mark_size(self) -> int:
        return max(9, round(self._view.fontMetrics().height() * 0.62))
