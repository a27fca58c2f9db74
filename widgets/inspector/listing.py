"""The algorithm as code: the line of the step just done is marked, a click runs to a line."""

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontDatabase,
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPolygonF,
    QResizeEvent,
    QShowEvent,
    QTextCharFormat,
    QTextCursor,
    QTextLayout,
    QTextOption,
)
from PySide6.QtWidgets import QApplication, QFrame, QPlainTextEdit, QTextEdit, QWidget

from widgets.basics.key_claim import KeyClaim
from widgets.basics.marks import Mark, blended, draw_mark
from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.listing_looks import color_tokens

_COMMANDS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Enter)

SEEN_LINES = 10
"""Lines of which the present one is in sight, whole."""
MOST_ROWS = 19
"""Rows that the pane is made high for: beyond them a listing is scrolled."""
HINT = "The algorithm of the stage appears here, with the line of each step marked."
"""What an empty pane is for."""


@dataclass(frozen=True)
class ListingText:
    """The source of one short function."""

    title: str
    """Name of the method, for the accessible name."""
    source: str
    """Python text; line numbers count from 1."""
    purpose: str = ""
    """What it is for, for the tooltip."""


class ListingView(QPlainTextEdit):
    """Read-only code with the present line marked by bar, arrow and tint.

    Keys, when it has the focus: Up and Down choose a line, Enter runs to it, Shift+Enter breaks there.
    """

    line_clicked = Signal(int)
    """The user wants the next step of this line (from 1)."""
    breakpoint_toggled = Signal(int)
    """The user wants a breakpoint set on, or removed from, this line (from 1)."""
    room_changed = Signal()
    """`height_of` is another: for other listings, in another width or type."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._line: int | None = None
        self._breakpoints: frozenset[int] = frozenset()
        self._pressed_at = QPoint()
        self._title = ""
        self._in_turn: frozenset[str] = frozenset()
        self._rows_for: object = None
        """Width and type that the kept rows are for."""
        self._kept_rows: dict[str, int] = {}
        self.setReadOnly(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWordWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
        )
        self.show_hint(HINT)
        self.setCornerWidget(QWidget(self))
        self.setAccessibleName("Listing")
        self.viewport().setCursor(Qt.CursorShape.ArrowCursor)
        KeyClaim(self, _COMMANDS)
        self._margin = ListingMargin(self)
        self._margin.line_clicked.connect(self.breakpoint_toggled)
        self.updateRequest.connect(self._follow_scroll)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    @Slot(str)
    def show_hint(self, text: str) -> None:
        """Say this where there is no listing."""
        self.setPlaceholderText(text)

    @Slot(object)
    def show_listing(self, listing: ListingText | None) -> None:
        """Show a function; the present line and the breakpoints are cleared."""
        self.show_line(None)
        self._breakpoints = frozenset()
        self._title = listing.title if listing else ""
        self.setPlainText(listing.source.rstrip("\n") if listing else "")
        self.setAccessibleName(f"Listing of {self._title}" if self._title else "Listing")
        self.setToolTip(listing.purpose if listing else "")
        color_tokens(self.document())
        self._place_margin()
        if self.toPlainText() not in self._in_turn:
            self.room_changed.emit()

    def keep_room_for(self, sources: Iterable[str]) -> None:
        """Be high enough for each of these listings, which are shown in turn: then none of them moves anything."""
        in_turn = frozenset(source.rstrip("\n") for source in sources)
        if in_turn != self._in_turn:
            self._in_turn = in_turn
            self.room_changed.emit()

    @Slot(object)
    def show_line(self, line: int | None) -> None:
        """Mark the line of the step just done and bring it into view; None unmarks."""
        if line == self._line:
            return
        self._line = line
        self._mark_line()
        code = self.document().findBlockByNumber(line - 1).text().strip() if line else ""
        self.setAccessibleDescription(f"Line {line} has just run: {code}" if line else "")
        self._bring_line_into_view()

    def _bring_line_into_view(self) -> None:
        """Scroll to the marked line, unless text is being selected."""
        if self._line is None or self.textCursor().hasSelection():
            return
        block = self.document().findBlockByNumber(self._line - 1)
        if not block.isValid():
            return
        self.setTextCursor(QTextCursor(block))
        rows, at = {}, self.document().firstBlock()
        while at.isValid():
            if at.isVisible():
                self.blockBoundingRect(at)  # It is laid out at the latest now.
                rows[at.blockNumber()] = range(at.firstLineNumber(), at.firstLineNumber() + at.lineCount())
            at = at.next()
        height = self.viewport().height() - self.document().documentMargin()
        page, bar = int(height / self.fontMetrics().lineSpacing()), self.verticalScrollBar()
        bar.setValue(best_first_row([*rows.values()], rows[self._line - 1], page, bar.value()))

    @Slot(object)
    def show_breakpoints(self, lines: Collection[int]) -> None:
        """Mark the lines that have a breakpoint."""
        self._breakpoints = frozenset(lines)
        self._margin.update()

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

    @property
    def line(self) -> int | None:
        """The line of the step just done."""
        return self._line

    @property
    def chosen_line(self) -> int | None:
        """The line that the keys are on, if the listing has the focus."""
        return self.textCursor().blockNumber() + 1 if self.hasFocus() and self._title else None

    @property
    def breakpoints(self) -> frozenset[int]:
        """The lines that have a breakpoint."""
        return self._breakpoints

    def height_of(self, lines: int, is_wrapped: bool = True) -> int:
        """Return the height of any so many lines of every listing shown in turn, wrapped, or of so many rows."""
        row, rows = math.ceil(QFontMetricsF(self.font()).lineSpacing()), lines
        if is_wrapped:
            # Beside a scroll bar.
            bar = self.verticalScrollBar().sizeHint().width()
            width = (
                self.contentsRect().width()
                - self._margin.wanted_width()
                - bar
                - 2 * self.document().documentMargin()
            )
            font, option = self.font(), self.document().defaultTextOption()
            sources = {self.toPlainText(), *self._in_turn}
            rows = max(self._rows_of(source, lines, width, font, option.wrapMode()) for source in sources)
        # Half a row more: Qt scrolls by whole ones.
        return math.ceil(min(rows, MOST_ROWS) * row + row / 2 + 2 * self.document().documentMargin())

    def _rows_of(self, source: str, lines: int, width: float, font: QFont, wrap: QTextOption.WrapMode) -> int:
        """Return what `_rows` does, found once for each source as long as width and type stay."""
        now = lines, width, font.key(), wrap
        if now != self._rows_for:
            self._rows_for, self._kept_rows = now, {}
        if source not in self._kept_rows:
            self._kept_rows[source] = _rows(source, lines, width, font, wrap)
        return self._kept_rows[source]

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the margin beside the text, and the line of the step in view."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.room_changed.emit()
        # After whoever gives it more room, which may be at once.
        self._place_margin()
        self._bring_line_into_view()

    def showEvent(self, event: QShowEvent) -> None:
        """Bring the line into view that was marked while nobody saw it."""
        super().showEvent(event)
        self._bring_line_into_view()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Remember where a click began."""
        self._pressed_at = event.position().toPoint()
        super().mousePressEvent(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Ask to run to a line that was clicked without selecting text."""
        super().mouseReleaseEvent(event)
        place = event.position().toPoint()
        moved = (place - self._pressed_at).manhattanLength()
        line = self.line_at(place.y())
        is_click = event.button() == Qt.MouseButton.LeftButton and moved < QApplication.startDragDistance()
        if is_click and line is not None and not self.textCursor().hasSelection():
            self.line_clicked.emit(line)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter runs to the chosen line, Shift+Enter toggles its breakpoint."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            line = self.textCursor().blockNumber() + 1
            is_break = bool(event.modifiers() & Qt.KeyboardModifier.ShiftModifier)
            if self.toPlainText():
                (self.breakpoint_toggled if is_break else self.line_clicked).emit(line)
            return
        if event.key() in (Qt.Key.Key_Up, Qt.Key.Key_Down):
            cursor = self.textCursor()
            is_up = event.key() == Qt.Key.Key_Up
            way = QTextCursor.MoveOperation.PreviousBlock if is_up else QTextCursor.MoveOperation.NextBlock
            while cursor.movePosition(way) and not cursor.block().isVisible():
                pass
            self.setTextCursor(cursor)
            self._mark_line()
            return
        super().keyPressEvent(event)

    def _place_margin(self) -> None:
        width = self._margin.wanted_width()
        self.setViewportMargins(width, 0, 0, 0)
        inside = self.contentsRect()
        self._margin.setGeometry(inside.left(), inside.top(), width, inside.height())

    @Slot(QRect, int)
    def _follow_scroll(self, area: QRect, dy: int) -> None:
        if dy:
            self._margin.scroll(0, dy)
        else:
            self._margin.update(0, area.y(), self._margin.width(), area.height())

    def _mark_line(self) -> None:
        theme = current_theme()
        marks = []
        if self.chosen_line not in (None, self._line):
            chosen = self.textCursor()
            chosen.movePosition(QTextCursor.MoveOperation.StartOfBlock)
            chosen.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
            marks.append(self._line_mark(chosen, QColor(theme.selection)))
        if self._line is not None:
            block = self.document().findBlockByNumber(self._line - 1)
            if block.isValid():
                whole = QTextCursor(block)
                whole.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
                marks.append(self._line_mark(whole, blended(theme.accent, theme.panel, 0.14)))
        self.setExtraSelections(marks)
        self._margin.update()

    @staticmethod
    def _line_mark(cursor: QTextCursor, color: QColor) -> QTextEdit.ExtraSelection:
        mark = QTextEdit.ExtraSelection()
        mark.format.setBackground(color)
        mark.format.setProperty(int(QTextCharFormat.Property.FullWidthSelection), True)
        mark.cursor = cursor
        return mark

    @Slot()
    def _follow_theme(self) -> None:
        theme = current_theme()
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPixelSize(theme.code_px)
        self.setFont(font)
        self.viewport().setFont(font)  # of the hint
        palette = self.palette()
        palette.setColor(QPalette.ColorRole.Base, QColor(theme.panel))
        palette.setColor(QPalette.ColorRole.PlaceholderText, QColor(theme.muted_text))
        self.setPalette(palette)
        color_tokens(self.document())
        self._mark_line()
        self._place_margin()
        self.room_changed.emit()


@lru_cache(maxsize=1024)
class ListingMargin(QWidget):
    """Paints itself beside the lines of its view, which places it."""

    line_clicked = Signal(int)
    """The line (from 1) that was clicked."""

    def __init__(self, view: ListingView) -> None:
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


def _rows(source: str, lines: int, width: float, font: QFont, wrap: QTextOption.WrapMode) -> int:
    """Return how many rows so many successive lines of a source take at most in a width; at least one for each."""
    option = QTextOption()
    option.setWrapMode(wrap)
    bold = QFont(font)
    bold.setBold(True)  # As the keywords of a line: no row is wider.
    rows = []
    for text in source.split("\n"):
        layout = QTextLayout(text, bold)
        layout.setTextOption(option)
        layout.beginLayout()
        while (line := layout.createLine()).isValid():
            line.setLineWidth(width)
        layout.endLayout()
        rows.append(max(layout.lineCount(), 1))
    successive = [sum(rows[first : first + lines]) for first in range(max(len(rows) - lines, 0) + 1)]
    return max(*successive, lines)


def best_first_row(lines: Sequence[range], marked: range, page: int, present: int) -> int:
    """Return which row to scroll to, the nearest that shows the marked line whole and ten lines, or the most that go.

    Each line is given by its rows; `page` rows are seen, now from row `present` on.
    """

    def worth(first: int) -> tuple[bool, int, int]:
        seen = range(first, first + page)
        whole = sum(line[0] in seen and line[-1] in seen for line in lines)
        return marked[0] in seen and marked[-1] in seen, min(whole, SEEN_LINES), -abs(first - present)

    return max(range(max(lines[-1].stop - page, 0) + 1), key=worth)
