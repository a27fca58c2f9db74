"""The algorithm as code: the line of the step just done is marked, a click runs to a line."""

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from PySide6.QtCore import QPoint, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QContextMenuEvent,
    QFont,
    QFontMetricsF,
    QKeyEvent,
    QMouseEvent,
    QResizeEvent,
    QShowEvent,
    QTextCursor,
    QTextLayout,
    QTextOption,
)
from PySide6.QtWidgets import QApplication, QWidget

from widgets.basics.accessibility import KeyClaim
from widgets.inspector.code_view import CodeView, color_tokens

_COMMANDS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Enter)

SEEN_LINES = 10
"""Lines of which the present one is in sight, whole."""
MOST_ROWS = 19
"""Rows that the pane is made high for: beyond them a listing is scrolled."""
KEPT_ROWS = 256
"""Listings in some width whose rows are kept, at most."""
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


class ListingView(CodeView):
    """Read-only code with the present line marked by bar, arrow and tint.

    Keys, when it has the focus: Up and Down choose a line, Enter runs to it, Shift+Enter breaks there.
    """

    line_clicked = Signal(int)
    """The user wants the next step of this line (from 1)."""
    breakpoint_toggled = Signal(int)
    """The user wants a breakpoint set on, or removed from, this line (from 1)."""
    menu_opened = Signal(object, int)
    """The menu of a right click opens: the ``QMenu``, and the line (from 1) that was clicked, 0: none."""
    room_changed = Signal()
    """`height_of` is another: for other listings, in another width or type."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._pressed_at = QPoint()
        self._title = ""
        self._in_turn: frozenset[str] = frozenset()
        self._kept_rows: dict[tuple[object, ...], int] = {}
        """By source, lines, width and type."""
        self._wrapped_at = -1
        """Width for which the text was wrapped."""
        self.setReadOnly(True)
        self.setTextInteractionFlags(
            Qt.TextInteractionFlag.TextSelectableByMouse | Qt.TextInteractionFlag.TextSelectableByKeyboard
        )
        self.show_hint(HINT)
        self.setAccessibleName("Listing")
        self.viewport().setCursor(Qt.CursorShape.ArrowCursor)
        KeyClaim(self, _COMMANDS)
        self.margin.line_clicked.connect(self.breakpoint_toggled)
        self.margin.setCursor(Qt.CursorShape.PointingHandCursor)
        self.margin.setToolTip("Click: set or clear a breakpoint on this line")
        self.margin.setAccessibleName("Breakpoint margin")
        self.follow_theme()

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
        self.place_margin()
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
        self.mark_line()
        code = self.document().findBlockByNumber(line - 1).text().strip() if line else ""
        self.setAccessibleDescription(f"Line {line} has just run: {code}" if line else "")
        self._bring_line_into_view()

    def _bring_line_into_view(self, *, stays_near: bool = True) -> None:
        """Scroll to the marked line, unless text is being selected: no further than needed, or to the middle.

        In another size it goes to the middle: sizes come and go while a window opens, and must leave no trace.
        """
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
        marked = rows[self._line - 1]
        present = bar.value() if stays_near else marked[0] - page // 2
        bar.setValue(best_first_row([*rows.values()], marked, page, present))

    @Slot(object)
    def show_breakpoints(self, lines: Collection[int]) -> None:
        """Mark the lines that have a breakpoint."""
        self._breakpoints = frozenset(lines)
        self.margin.update()

    def height_of(self, lines: int, is_wrapped: bool = True) -> int:
        """Return the height of any so many lines of every listing shown in turn, wrapped, or of so many rows."""
        row, rows = math.ceil(QFontMetricsF(self.font()).lineSpacing()), lines
        if is_wrapped:
            # Beside a scroll bar.
            bar = self.verticalScrollBar().sizeHint().width()
            width = (
                self.contentsRect().width()
                - self.margin.wanted_width()
                - bar
                - 2 * self.document().documentMargin()
            )
            font, option = self.font(), self.document().defaultTextOption()
            sources = {self.toPlainText(), *self._in_turn}
            rows = max(self._rows_of(source, lines, width, font, option.wrapMode()) for source in sources)
        # Half a row more: Qt scrolls by whole ones.
        return math.ceil(min(rows, MOST_ROWS) * row + row / 2 + 2 * self.document().documentMargin())

    def _rows_of(self, source: str, lines: int, width: float, font: QFont, wrap: QTextOption.WrapMode) -> int:
        """Return what `_rows` does, found once for each width: a bar that comes and goes is beside it or not."""
        key = source, lines, width, font.key(), wrap
        if key not in self._kept_rows:
            if len(self._kept_rows) >= KEPT_ROWS:
                self._kept_rows.clear()
            self._kept_rows[key] = _rows(source, lines, width, font, wrap)
        return self._kept_rows[key]

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the margin beside the text, and the line of the step in view."""
        if event.size().width() != self._wrapped_at:
            # Of a bar that goes while all is being shown, Qt tells nothing, and would wrap nothing.
            event = QResizeEvent(event.size(), QSize(self._wrapped_at, event.oldSize().height()))
            self._wrapped_at = event.size().width()
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.room_changed.emit()
        # After whoever gives it more room, which may be at once.
        self.place_margin()
        self._bring_line_into_view(stays_near=False)

    def showEvent(self, event: QShowEvent) -> None:
        """Bring the line into view that was marked while nobody saw it."""
        super().showEvent(event)
        if self.viewport().width() != self._wrapped_at:
            self.resizeEvent(QResizeEvent(self.viewport().size(), QSize()))
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

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Open the menu of the text, with what else is offered for the line."""
        menu = self.createStandardContextMenu()
        if event.reason() == QContextMenuEvent.Reason.Mouse:
            line = self.line_at(event.pos().y())
        else:
            line = self.textCursor().blockNumber() + 1
        self.menu_opened.emit(menu, line or 0)
        menu.exec(event.globalPos())
        menu.deleteLater()

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
            self.mark_line()
            return
        super().keyPressEvent(event)

    @property
    def chosen_line(self) -> int | None:
        """The line that the keys are on, if the listing has the focus."""
        return super().chosen_line if self._title else None

    def follow_theme(self) -> None:
        """Take over type and colours."""
        super().follow_theme()
        color_tokens(self.document())
        self.room_changed.emit()


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

    rows = range(max(lines[-1].stop - page, 0) + 1)
    showing = rows[max(marked[-1] - page + 1, 0) : marked[0] + 1]
    return max(showing or rows, key=worth)
