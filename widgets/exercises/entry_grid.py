"""Text fields in rows and columns with their heads: Tab, arrows and Return go from one to the next."""

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QGridLayout, QLabel, QLineEdit, QWidget

from widgets.basics.focus_order import give_focus
from widgets.basics.labels import text_label
from widgets.basics.typed_value import NumberEdit
from widgets.exercises.answer_view import show_mark

Cell = tuple[int, int]
"""Row and column of a field."""
WIDEST = 240
"""Pixels of a field that stands alone in its row."""
MANY = 12
"""Fields of a table of which is said how to leave it: Tab takes so many presses."""
KEYS = "Tab goes to the next cell, Return down. F6 leaves the table, Ctrl+Tab the page."
_RETURN = Qt.Key.Key_Return, Qt.Key.Key_Enter
_UPRIGHT = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, **dict.fromkeys(_RETURN, 1)}


class EntryGrid(QWidget):
    """The fields; ``row`` and ``column`` count from 0 at the top left."""

    field_edited = Signal(int, int)
    """Row and column of a field in which the user has typed."""
    field_entered = Signal(int, int)
    """Row and column of the field that has the keyboard now."""

    def __init__(
        self,
        columns: Sequence[str],
        labels: Sequence[str],
        parent: QWidget | None = None,
        read_only: Sequence[int] = (),
    ) -> None:
        """Make empty fields; ``read_only`` columns show what the program writes there."""
        super().__init__(parent)
        self._shape = len(labels), len(columns)
        self._fields: dict[Cell, QLineEdit] = {}
        self._marks: dict[Cell, QLabel] = {}
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setHorizontalSpacing(4)
        layout.setVerticalSpacing(4)
        for column, name in enumerate(columns):
            if name:
                layout.addWidget(text_label(name, self, role="muted"), 0, 1 + 2 * column)
            layout.setColumnStretch(1 + 2 * column, 4)
        for row, label in enumerate(labels):
            layout.addWidget(text_label(label, self), 1 + row, 0)
            for column, name in enumerate(columns):
                field = NumberEdit(self)
                field.setAccessibleName(" ".join(text for text in (name, label) if text))
                field.setReadOnly(column in read_only)
                field.setMaximumWidth(WIDEST if len(columns) == 1 else 16_777_215)
                field.setFocusPolicy(
                    Qt.FocusPolicy.NoFocus if column in read_only else Qt.FocusPolicy.StrongFocus
                )
                field.textEdited.connect(self._edited)
                field.installEventFilter(self)
                mark = QLabel(self)
                self._fields[row, column], self._marks[row, column] = field, mark
                layout.addWidget(field, 1 + row, 1 + 2 * column)
                layout.addWidget(mark, 1 + row, 2 + 2 * column)
        self._notes = [text_label("", self, role="muted") for _ in labels]
        for row, note in enumerate(self._notes):
            layout.addWidget(note, 1 + row, 1 + 2 * len(columns))
        layout.setColumnStretch(1 + 2 * len(columns), 4 if len(columns) == 1 else 1)
        if sum(not field.isReadOnly() for field in self._fields.values()) > MANY:
            keys = text_label(KEYS, self, role="muted", wraps=True)
            layout.addWidget(keys, 1 + len(labels), 0, 1, layout.columnCount())

    def text(self, row: int, column: int) -> str:
        """Return what is in a field."""
        return self._fields[row, column].text()

    def texts(self) -> list[list[str]]:
        """Return what is in all fields, row by row."""
        rows, columns = self._shape
        return [[self.text(row, column) for column in range(columns)] for row in range(rows)]

    def show_text(self, row: int, column: int, text: str) -> None:
        """Write into a field."""
        if self.text(row, column) != text:
            self._fields[row, column].setText(text)

    def show_mark(self, row: int, column: int, is_right: bool | None) -> None:
        """Mark a field as right or wrong; ``None`` takes the mark away."""
        show_mark(self._marks[row, column], is_right)
        word = {True: "right", False: "wrong", None: ""}[is_right]
        self._fields[row, column].setAccessibleDescription(word)

    def show_note(self, row: int, text: str) -> None:
        """Write behind a row how it is understood."""
        self._notes[row].setText(text)

    def set_open(self, is_open: bool) -> None:
        """Take text, or only show it."""
        for field in self._fields.values():
            if field.focusPolicy() != Qt.FocusPolicy.NoFocus:
                field.setReadOnly(not is_open)

    def field(self, row: int, column: int) -> QLineEdit:
        """Return a field."""
        return self._fields[row, column]

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Go to a neighbour by the arrows: to the sides only from the end of a text."""
        if event.type() == QEvent.Type.FocusIn:
            self.field_entered.emit(*self._cell(watched))
        if not isinstance(event, QKeyEvent) or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            return False
        move = self._move(watched, Qt.Key(event.key()))
        if move is None:
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        # Return in the last field is not this grid's: it checks the answer.
        return event.type() == QEvent.Type.KeyPress and (
            self._go(self._cell(watched), move) or event.key() not in _RETURN
        )

    def _cell(self, watched: QObject | None) -> Cell:
        return next(cell for cell, field in self._fields.items() if field is watched)

    def _move(self, watched: QObject, key: Qt.Key) -> Cell | None:
        """Return rows and columns to go by; ``None``: the key is the field's own."""
        if key in _UPRIGHT:
            return _UPRIGHT[key], 0
        if not isinstance(watched, QLineEdit) or watched.hasSelectedText():
            return None
        if key == Qt.Key.Key_Left and watched.cursorPosition() == 0:
            return 0, -1
        if key == Qt.Key.Key_Right and watched.cursorPosition() == len(watched.text()):
            return 0, 1
        return None

    def _go(self, cell: Cell, move: Cell) -> bool:
        """Go to a neighbour, from the last row down to the next column's first; return whether there is one."""
        row, column = cell[0] + move[0], cell[1] + move[1]
        if row >= self._shape[0]:
            row, column = 0, column + 1
        there = self._fields.get((row, column))
        has_neighbour = there is not None and there.focusPolicy() != Qt.FocusPolicy.NoFocus
        if there is not None and has_neighbour:
            give_focus(there)
        return has_neighbour

    @Slot()
    def _edited(self) -> None:
        self.field_edited.emit(*self._cell(self.sender()))
