"""Code with line numbers: what a listing that is read and one that is edited have in common, and how tokens look."""

import io
import keyword
import re
import tokenize
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontDatabase,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPalette,
    QPolygonF,
    QResizeEvent,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
    QTextOption,
)
from PySide6.QtWidgets import QFrame, QPlainTextEdit, QTextEdit, QWidget

from widgets.basics.drawing import Mark, blended, draw_mark, paint_share
from widgets.basics.theme import current_theme, theme_notifier

# The looks of code: what each token of a listing is, and the colours of vertices 0, 1 and 2 in it.


_VERTEX_NAME = re.compile(r"^[A-Za-z]+_?([012])$")
KINDS_OF_VECTORS = ("vec", "ivec", "bvec", "mat")
_GLSL = re.compile(
    r"^\s*#version|^\s*(?:void|float|int|bool|[bi]?vec[2-4]|mat[2-4])\s+\w+\s*\(", re.MULTILINE
)
_GLSL_TOKEN = re.compile(
    r"(?P<comment>//[^\n]*|/\*.*?\*/|#[^\n]*)|(?P<number>\b\d[\w.]*|\.\d\w*)|(?P<word>[A-Za-z_]\w*)",
    re.DOTALL,
)
_GLSL_WORDS = frozenset(
    (
        *(
            *("in", "out", "uniform", "const", "flat", "precision", "highp", "mediump", "lowp", "layout"),
            *("true", "false"),
        ),
        *(
            "void",
            "float",
            "int",
            "bool",
            "sampler2D",
            *(f"{kind}{n}" for kind in KINDS_OF_VECTORS for n in (2, 3, 4)),
        ),
        *("if", "else", "for", "while", "return", "break", "continue", "discard"),
    )
)
_EDGE_NAMES = {"alpha": 0, "beta": 1, "gamma": 2}


@lru_cache(maxsize=64)
def token_formats(source: str) -> tuple[tuple[int, int, int, int, str], ...]:
    """Return where each token that has a look of its own begins and ends.

    Returns
    -------
    tuple of (int, int, int, int, str)
        First line (from 1), first column, last line, last column, and one of ``keyword``, ``comment``,
        ``string``, ``number``, ``vertex0``, ``vertex1``, ``vertex2``.
    """
    if _GLSL.search(source):
        return _glsl_formats(source)
    tokens: list[tokenize.TokenInfo] = []
    with suppress(tokenize.TokenError, SyntaxError):  # What stands before is coloured.
        tokens.extend(tokenize.generate_tokens(io.StringIO(source).readline))
    kinds = [_token_kind(token) for token in tokens]
    return tuple((*token.start, *token.end, kind) for token, kind in zip(tokens, kinds, strict=True) if kind)


def _glsl_formats(source: str) -> tuple[tuple[int, int, int, int, str], ...]:
    """Return the same of a shader."""
    begins = [0, *(found.end() for found in re.finditer("\n", source))]
    found = []
    for token in _GLSL_TOKEN.finditer(source):
        kind = token.lastgroup or ""
        if kind == "word":
            kind = "keyword" if token[0] in _GLSL_WORDS else ""
        if kind:
            first, last = (bisect_right(begins, at) for at in (token.start(), token.end()))
            found.append(
                (first, token.start() - begins[first - 1], last, token.end() - begins[last - 1], kind)
            )
    return tuple(found)


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


def token_looks() -> dict[str, QTextCharFormat]:
    """Return the look of each kind of token; of all others that of the empty kind."""
    theme = current_theme()
    looks = {f"vertex{k}": _look(theme.vertex_text[k]) for k in range(3)}
    looks |= {"keyword": _look(theme.text, is_bold=True), "comment": _look(theme.muted_text, is_italic=True)}
    return looks | {"string": _look(theme.muted_text), "number": _look(theme.text), "": _look(theme.text)}


def color_tokens(document: QTextDocument) -> None:
    """Give the tokens of a document their looks."""
    looks = token_looks()
    everything = QTextCursor(document)
    everything.beginEditBlock()  # The text is laid out once, at its end.
    everything.select(QTextCursor.SelectionType.Document)
    everything.setCharFormat(looks[""])
    for first_line, first_column, last_line, last_column, kind in token_formats(document.toPlainText()):
        cursor = QTextCursor(document)
        cursor.setPosition(document.findBlockByNumber(first_line - 1).position() + first_column)
        end = document.findBlockByNumber(last_line - 1).position() + last_column
        cursor.setPosition(end, QTextCursor.MoveMode.KeepAnchor)
        cursor.setCharFormat(looks[kind])
    everything.endEditBlock()


def _look(color: str, *, is_bold: bool = False, is_italic: bool = False) -> QTextCharFormat:
    look = QTextCharFormat()
    look.setForeground(QColor(color))
    look.setFontItalic(is_italic)
    if is_bold:
        look.setFontWeight(QFont.Weight.Bold)
    return look


# Code with line numbers: what a listing that is read, and one that is edited, have in common.


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
