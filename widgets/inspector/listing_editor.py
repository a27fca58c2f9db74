"""The editor of a listing: what is typed, where it cannot be read, and which lines are changed."""

from PySide6.QtCore import QEvent, Qt, QTimer, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QKeyEvent,
    QResizeEvent,
    QSyntaxHighlighter,
    QTextCharFormat,
    QTextCursor,
    QTextDocument,
)
from PySide6.QtWidgets import QTextEdit, QWidget

from core.records.listing import kept_line
from widgets.basics.theme import current_theme
from widgets.inspector.code_view import CodeView, token_formats, token_looks

PAUSE_MS = 150
"""Time after the last key, in milliseconds, from which a text is taken to be typed."""
INDENT = "  "
"""What Tab writes: listings are indented by two blanks."""
MAKES_NO_TEXT = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.AltModifier
LEAVES = (Qt.Key.Key_F1, Qt.Key.Key_F2, Qt.Key.Key_F6)
"""Keys that go to the window all the same."""


class ListingEditor(CodeView):
    """A listing that is typed. Tab indents, Shift+Tab the other way, Escape leaves; it has an undo of its own."""

    text_typed = Signal(str)
    """The user has typed, and pauses."""
    left = Signal()
    """The user has pressed Escape."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._problem: tuple[int, int] | None = None
        self._step: tuple[int | None, str] = None, ""
        """Line of the step just done, in the text that ran, and that text."""
        self._is_set = False
        """Whether the text is being set by the program."""
        self._is_new = True
        """Whether a pause came before what is typed next."""
        self._highlighter = TokenHighlighter(self.document())
        self._pause = QTimer(self, singleShot=True, interval=PAUSE_MS)
        self._pause.timeout.connect(self._type)
        self.textChanged.connect(self._await_pause)
        self.textChanged.connect(self._follow_text)
        self.cursorPositionChanged.connect(self.mark_line)
        self.blockCountChanged.connect(self.place_margin)
        self.setAccessibleName("Edited listing")
        self.follow_theme()

    @property
    def text(self) -> str:
        """What is typed."""
        return self.toPlainText()

    @property
    def has_problem(self) -> bool:
        """Whether a place is marked."""
        return self._problem is not None

    @property
    def is_pausing(self) -> bool:
        """Whether something is typed that has not been told yet."""
        return self._pause.isActive()

    def show_text(self, text: str) -> None:
        """Show another text; the editor's undo leads back only where the text is the same but for an edit."""
        text = text.rstrip("\n")
        if text == self.toPlainText():
            return
        at = self.textCursor().position()
        self._is_set = True
        if self.toPlainText():
            # As an edit: what was typed before can still be undone here.
            everything = QTextCursor(self.document())
            everything.select(QTextCursor.SelectionType.Document)
            everything.insertText(text)
        else:
            self.setPlainText(text)
        self._is_set = False
        self._pause.stop()
        cursor = self.textCursor()
        cursor.setPosition(min(at, len(text)))
        self.setTextCursor(cursor)

    def begin(self, text: str, line: int) -> None:
        """Edit a text, from a line (from 1) on; its undo begins anew."""
        self._is_set = True
        self.setPlainText(text.rstrip("\n"))
        self._is_set = False
        self._pause.stop()
        self.show_problem(None)
        block = self.document().findBlockByNumber(line - 1)
        cursor = QTextCursor(block if block.isValid() else self.document().firstBlock())
        cursor.movePosition(QTextCursor.MoveOperation.EndOfBlock)
        self.setTextCursor(cursor)
        self.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def show_step(self, line: int | None, source: str) -> None:
        """Mark the line of the step just done, which stands in the text that ran, and bring it into sight.

        While something is typed, that stays in sight instead. The mark follows its line while lines are typed above it,
        and goes where the line is taken out.
        """
        before, self._step = self._step, (line, source)
        self._follow_text()
        # A text that has just run shows its step anew, where it is being typed.
        is_stepped = line != before[0] and (before[0] is None or source == before[1])
        if is_stepped and not self.is_pausing and self._line is not None:
            self._show_line(self._line)

    def _show_line(self, line: int) -> None:
        """Scroll as little as brings a line into sight; the cursor stays where it is."""
        in_sight = [
            number for number, box in self.visible_lines() if box.bottom() <= self.viewport().height()
        ]
        if not in_sight or line in in_sight:
            return
        bar = self.verticalScrollBar()
        # In lines: the bar of a plain text counts them.
        bar.setValue(bar.value() + (line - (in_sight[0] if line < in_sight[0] else in_sight[-1])))

    @Slot()
    def _follow_text(self) -> None:
        line, source = self._step
        now = None if line is None else kept_line(source, self.toPlainText(), line)
        if now != self._line:
            self._line = now
            self.mark_line()

    def show_problem(self, place: tuple[int, int] | None) -> None:
        """Draw a wave under a place, line and column from 1; ``None``: the text can be read."""
        self._problem = place
        self.mark_line()

    def mark_line(self) -> None:
        """Mark the present line and the chosen one, and the place of the problem."""
        self.setExtraSelections([*self.line_marks(), *self._wave()])
        self.margin.update()

    def _wave(self) -> list[QTextEdit.ExtraSelection]:
        if self._problem is None:
            return []
        line, column = self._problem
        block = self.document().findBlockByNumber(line - 1)
        if not block.isValid():
            return []
        text = block.text()
        start = min(column - 1, len(text))
        end = start
        while end < len(text) and (text[end].isalnum() or text[end] == "_"):
            end += 1
        if end == start:
            end = min(start + 1, len(text))
        if end == start:
            start = len(text.rstrip()) - 1  # Behind the end of the line: under its last sign.
        cursor = QTextCursor(block)
        cursor.setPosition(block.position() + max(start, 0))
        cursor.setPosition(block.position() + end, QTextCursor.MoveMode.KeepAnchor)
        wave = QTextEdit.ExtraSelection()
        wave.format.setUnderlineStyle(QTextCharFormat.UnderlineStyle.WaveUnderline)
        wave.format.setUnderlineColor(QColor(current_theme().bad))
        wave.cursor = cursor
        return [wave]

    @Slot()
    def _await_pause(self) -> None:
        if not self._is_set:
            self._pause.start()

    @Slot()
    def _type(self) -> None:
        self._is_new = True
        self.text_typed.emit(self.toPlainText())

    def event(self, event: QEvent) -> bool:
        """Keep the keys of the editor, its undo and Escape too, from the shortcuts of the window."""
        if event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent):
            is_own = not event.modifiers() & MAKES_NO_TEXT and event.key() not in LEAVES
            if is_own:
                event.accept()
                return True
        return super().event(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Take what was typed as typed."""
        super().focusOutEvent(event)
        self.settle()

    def settle(self) -> None:
        """Take what was typed as typed, without a pause."""
        if self._pause.isActive():
            self._pause.stop()
            self._type()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Tab indents, Shift+Tab takes it back, Enter goes on at the same depth, Escape leaves."""
        key = event.key()
        if key == Qt.Key.Key_Escape:
            self.left.emit()
        elif key == Qt.Key.Key_Tab:
            self._indent(1)
        elif key == Qt.Key.Key_Backtab:
            self._indent(-1)
        elif key in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            cursor = self.textCursor()
            before = cursor.block().text()[: cursor.positionInBlock()]
            depth = before[: len(before) - len(before.lstrip())] + (
                INDENT if before.rstrip().endswith(":") else ""
            )
            cursor.insertText("\n" + depth)
            self.ensureCursorVisible()
        elif self._is_new and event.text():
            # What is typed after a pause is undone by itself: Qt joins keys that follow each other.
            self._is_new = False
            cursor = self.textCursor()
            cursor.beginEditBlock()
            super().keyPressEvent(event)
            cursor.endEditBlock()
        else:
            super().keyPressEvent(event)

    def focusNextPrevChild(self, is_next: bool) -> bool:
        """Keep Tab here."""
        return False

    def _indent(self, direction: int) -> None:
        """Move the chosen lines to the right (1) or to the left (-1); Tab within a line writes blanks."""
        cursor = self.textCursor()
        if direction > 0 and not cursor.hasSelection():
            cursor.insertText(INDENT)
            return
        first = self.document().findBlock(cursor.selectionStart()).blockNumber()
        last = self.document().findBlock(cursor.selectionEnd()).blockNumber()
        cursor.beginEditBlock()
        for number in range(first, last + 1):
            line = QTextCursor(self.document().findBlockByNumber(number))
            if direction > 0:
                line.insertText(INDENT)
                continue
            text = line.block().text()
            for _ in range(min(len(INDENT), len(text) - len(text.lstrip(" ")))):
                line.deleteChar()
        cursor.endEditBlock()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep what is typed in sight."""
        super().resizeEvent(event)
        self.ensureCursorVisible()

    def follow_theme(self) -> None:
        """Take over type and colours."""
        super().follow_theme()
        self._highlighter.rehighlight()


class TokenHighlighter(QSyntaxHighlighter):
    """Colours the tokens of what is typed; the editor's undo knows nothing of it."""

    def __init__(self, document: QTextDocument) -> None:
        super().__init__(document)
        document.contentsChanged.connect(self._color_later)
        self._source = ""

    @Slot()
    def _color_later(self) -> None:
        """Colour all lines anew where an edit has changed what others are, as an open bracket does."""
        source = self.document().toPlainText()
        if source != self._source:
            self._source = source
            self.rehighlight()

    def highlightBlock(self, text: str) -> None:
        """Colour the tokens of a line."""
        line, looks = self.currentBlock().blockNumber() + 1, token_looks()
        self.setFormat(0, len(text), looks[""])
        for first, column, last, end, kind in token_formats(self.document().toPlainText()):
            if first <= line <= last:
                start = column if first == line else 0
                self.setFormat(start, (end if last == line else len(text)) - start, looks[kind])
