"""The algorithm as code: the line of the step just done is marked, a click runs to a line."""

import io
import keyword
import math
import re
import tokenize
from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import lru_cache

from PySide6.QtCore import QPoint, QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontDatabase,
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

_VERTEX_NAME = re.compile(r"^[A-Za-z]+_?([012])$")
_EDGE_NAMES = {"alpha": 0, "beta": 1, "gamma": 2}
_COMMANDS = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Return, Qt.Key.Key_Enter)

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


@lru_cache(maxsize=64)
def token_formats(source: str) -> tuple[tuple[int, int, int, int, str], ...]:
    """Return where each token that has a look of its own begins and ends.

    Returns
    -------
    tuple of (int, int, int, int, str)
        First line (from 1), first column, last line, last column, and one of ``keyword``, ``comment``,
        ``string``, ``number``, ``vertex0``, ``vertex1``, ``vertex2``.
    """
    try:
        tokens = list(tokenize.generate_tokens(io.StringIO(source).readline))
    except (tokenize.TokenError, SyntaxError):
        return ()
    kinds = [_token_kind(token) for token in tokens]
    return tuple((*token.start, *token.end, kind) for token, kind in zip(tokens, kinds, strict=True) if kind)


def _token_kind(token: tokenize.TokenInfo) -> str:
    if token.type == tokenize.NAME:
        if keyword.iskeyword(token.string):
            return "keyword"
        if token.string in _EDGE_NAMES:
            return f"vertex{_EDGE_NAMES[token.string]}"
        found = _VERTEX_NAME.match(token.string)
        return f"vertex{found[1]}" if found else ""
    return {tokenize.COMMENT: "comment", tokenize.STRING: "string", tokenize.NUMBER: "number"}.get(
        token.type, ""
    )


class _Margin(QWidget):
    """Line numbers, breakpoints and the arrow of the present line."""

    def __init__(self, view: "ListingView") -> None:
        super().__init__(view)
        self._view = view
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setToolTip("Click: set or clear a breakpoint on this line")
        self.setAccessibleName("Breakpoint margin")

    def sizeHint(self) -> QSize:
        return QSize(self._view.margin_width(), 0)

    def paintEvent(self, event: QPaintEvent) -> None:
        self._view.paint_margin(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        line = self._view.line_at(event.position().toPoint().y())
        if event.button() == Qt.MouseButton.LeftButton and line is not None:
            self._view.breakpoint_toggled.emit(line)


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
        self._margin = _Margin(self)
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
        self._color_tokens()
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
        if block.isValid():
            # Its last row first, then its first one: a line that is wrapped is seen whole where there is room.
            cursor = QTextCursor(block)
            for part in (QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveOperation.StartOfBlock):
                cursor.movePosition(part)
                self.setTextCursor(cursor)
                self.ensureCursorVisible()

    @Slot(object)
    def show_breakpoints(self, lines: Collection[int]) -> None:
        """Mark the lines that have a breakpoint."""
        self._breakpoints = frozenset(lines)
        self._margin.update()

    def line_at(self, y: int) -> int | None:
        """Return the line (from 1) drawn at height `y` of the viewport; None below the last."""
        block = self.firstVisibleBlock()
        while block.isValid():
            box = self.blockBoundingGeometry(block).translated(self.contentOffset())
            if box.top() <= y < box.bottom():
                return block.blockNumber() + 1 if self.toPlainText() else None
            block = block.next()
        return None

    def height_of(self, lines: int, is_wrapped: bool = True) -> int:
        """Return the height of the first lines of every listing shown in turn, wrapped, or of so many rows."""
        row, rows = self.fontMetrics().lineSpacing(), lines
        if is_wrapped:
            # Beside a scroll bar.
            bar = self.verticalScrollBar().sizeHint().width()
            width = self.width() - self.margin_width() - bar - 2 * self.document().documentMargin()
            font, option = self.font(), self.document().defaultTextOption()
            sources = {self.toPlainText(), *self._in_turn}
            rows = max(_rows(source, lines, width, font, option.wrapMode()) for source in sources)
        # Half a row more: Qt scrolls by whole ones.
        return math.ceil(min(rows, MOST_ROWS) * row + row / 2 + 2 * self.document().documentMargin())

    def margin_width(self) -> int:
        """Room for a mark and the largest line number."""
        digits = max(2, len(str(self.blockCount())))
        return self.fontMetrics().horizontalAdvance("0") * digits + self._mark_size() + 18

    def paint_margin(self, event: QPaintEvent) -> None:
        """Draw the margin: breakpoint as a disc, the present line as an arrow with the accent bar."""
        theme = current_theme()
        painter = QPainter(self._margin)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.fillRect(event.rect(), QColor(theme.panel))
        if not self.toPlainText():
            return
        painter.setFont(self.font())
        block = self.firstVisibleBlock()
        size, line_height = float(self._mark_size()), self.fontMetrics().lineSpacing()
        while block.isValid():
            box = self.blockBoundingGeometry(block).translated(self.contentOffset())
            if box.top() > event.rect().bottom():
                break
            line = block.blockNumber() + 1
            row = QRect(0, round(box.top()), self._margin.width(), round(box.height()))
            # A line that is wrapped has its number and marks beside its beginning.
            middle = row.top() + line_height / 2
            is_current = line == self._line
            if is_current:
                painter.fillRect(row, blended(theme.accent, theme.panel, 0.14))
                painter.fillRect(QRect(0, row.top(), 4, row.height()), QColor(theme.accent))
            if line in self._breakpoints:
                draw_mark(painter, Mark.BREAKPOINT, QRectF(7.0, middle - size / 2, size, size))
            if is_current:
                arrow = [
                    QPointF(8, middle - size / 2 + 1),
                    QPointF(8 + size, middle),
                    QPointF(8, middle + size / 2 - 1),
                ]
                painter.setPen(QColor(theme.panel))
                painter.setBrush(QColor(theme.accent))
                painter.drawPolygon(QPolygonF(arrow))
            if self.hasFocus() and not is_current and block == self.textCursor().block():
                painter.setPen(QColor(theme.focus))
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.drawRect(row.adjusted(2, 0, -3, -1))
            painter.setPen(QColor(theme.text if is_current else theme.muted_text))
            flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
            first = QRect(row.left(), row.top(), row.width() - 8, line_height)
            painter.drawText(first, flags, str(line))
            block = block.next()

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
            cursor.movePosition(way)
            self.setTextCursor(cursor)
            self._mark_line()
            return
        super().keyPressEvent(event)

    def _mark_size(self) -> int:
        return max(9, round(self.fontMetrics().height() * 0.62))

    def _place_margin(self) -> None:
        width = self.margin_width()
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
        if self.hasFocus() and self._title and self.textCursor().blockNumber() + 1 != self._line:
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

    def _color_tokens(self) -> None:
        """Give tokens their looks; vertices 0, 1 and 2 have their colours here too."""
        theme = current_theme()
        looks = {f"vertex{k}": _look(theme.vertex_text[k]) for k in range(3)}
        looks |= {
            "keyword": _look(theme.text, is_bold=True),
            "comment": _look(theme.muted_text, is_italic=True),
        }
        looks |= {"string": _look(theme.muted_text), "number": _look(theme.text)}
        everything = QTextCursor(self.document())
        everything.beginEditBlock()  # The text is laid out once, at its end.
        everything.select(QTextCursor.SelectionType.Document)
        everything.setCharFormat(_look(theme.text))
        for first_line, first_column, last_line, last_column, kind in token_formats(self.toPlainText()):
            cursor = QTextCursor(self.document())
            cursor.setPosition(self.document().findBlockByNumber(first_line - 1).position() + first_column)
            end = self.document().findBlockByNumber(last_line - 1).position() + last_column
            cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
            cursor.setCharFormat(looks[kind])
        everything.endEditBlock()

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
        self._color_tokens()
        self._mark_line()
        self._place_margin()
        self.room_changed.emit()


@lru_cache(maxsize=1024)
def _rows(source: str, lines: int, width: float, font: QFont, wrap: QTextOption.WrapMode) -> int:
    """Return how many rows the first lines of a source take in a width; at least one for each."""
    option = QTextOption()
    option.setWrapMode(wrap)
    rows = lines
    for text in source.split("\n")[:lines]:
        layout = QTextLayout(text, font)
        layout.setTextOption(option)
        layout.beginLayout()
        while (line := layout.createLine()).isValid():
            line.setLineWidth(width)
        layout.endLayout()
        rows += max(layout.lineCount() - 1, 0)
    return rows


def _look(color: str, *, is_bold: bool = False, is_italic: bool = False) -> QTextCharFormat:
    look = QTextCharFormat()
    look.setForeground(QColor(color))
    look.setFontItalic(is_italic)
    if is_bold:
        look.setFontWeight(QFont.Weight.Bold)
    return look
