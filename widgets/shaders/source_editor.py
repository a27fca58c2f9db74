"""An editor of a shader's text: it says when typing has paused, and marks the place that is wrong."""

from PySide6.QtCore import QTimer, Signal, Slot
from PySide6.QtGui import QColor, QFontDatabase, QKeyEvent, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import QFrame, QPlainTextEdit, QTextEdit, QWidget

from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.listing_editor import TokenHighlighter

PAUSE_MS = 150
"""After this long without a key what was typed is read."""
INDENT = "   "


class SourceEditor(QPlainTextEdit):
    """One shader. Tab indents; Escape gives the keyboard back to the page."""

    text_settled = Signal(str)
    """The user has typed this, and paused."""
    left = Signal()
    """Escape was pressed."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = name
        self._mark: tuple[int, int] | None = None
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.setAccessibleName(name)
        self._pause = QTimer(self, interval=PAUSE_MS, singleShot=True)
        self._pause.timeout.connect(self._settle)
        self._highlighter = TokenHighlighter(self.document())
        self.document().contentsChange.connect(self._begin_pause)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    def set_source(self, text: str) -> None:
        """Show a text that was not typed here; it is not emitted. Undo leads back to the one before."""
        if text == self.toPlainText():
            return
        is_first = self.document().isEmpty()
        self.blockSignals(True)
        if is_first:
            self.setPlainText(text)
        else:
            cursor = QTextCursor(self.document())
            cursor.select(QTextCursor.SelectionType.Document)
            cursor.insertText(text)
            self.moveCursor(QTextCursor.MoveOperation.Start)
        self.blockSignals(False)
        self._pause.stop()

    def mark(self, line: int, column: int, sentence: str) -> None:
        """Draw a wave under a place, counted from 1, and tell it to screen readers; line 0: nothing is wrong."""
        self._mark = (line, column) if line else None
        self.setAccessibleDescription(f"Line {line}: {sentence}" if line else "")
        self._show_mark()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Indent, or leave."""
        if event.text() == "\t":
            self.insertPlainText(INDENT)
        elif event.text() == "\x1b":
            self.left.emit()
        else:
            super().keyPressEvent(event)

    @Slot(int, int, int)
    def _begin_pause(self, place: int, removed: int, added: int) -> None:
        if not self.signalsBlocked():
            self._pause.start()

    @Slot()
    def _settle(self) -> None:
        self.text_settled.emit(self.toPlainText())

    def _show_mark(self) -> None:
        marks = []
        if self._mark is not None:
            line, column = self._mark
            block = self.document().findBlockByNumber(line - 1)
            cursor = QTextCursor(block)
            begin = min(column - 1, max(block.length() - 2, 0))
            cursor.setPosition(block.position() + begin)
            cursor.movePosition(QTextCursor.MoveOperation.EndOfWord, QTextCursor.MoveMode.KeepAnchor)
            if not cursor.hasSelection():
                cursor.setPosition(block.position())
                cursor.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
            mark = QTextEdit.ExtraSelection()
            mark.cursor = cursor
            look = QTextCharFormat()
            look.setUnderlineStyle(QTextCharFormat.UnderlineStyle.WaveUnderline)
            look.setUnderlineColor(QColor(current_theme().accent))
            mark.format = look
            marks.append(mark)
        self.setExtraSelections(marks)

    @Slot()
    def _follow_theme(self) -> None:
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPixelSize(current_theme().code_px)
        self.setFont(font)
        self._highlighter.rehighlight()
        self._show_mark()
