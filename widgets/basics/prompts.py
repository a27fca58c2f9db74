"""What is typed over the page: a question with one field, and a list that a field narrows."""

from collections.abc import Mapping, Sequence

from PySide6.QtCore import QEvent, QObject, Qt, Signal, Slot
from PySide6.QtGui import QFont, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QLineEdit, QListWidget, QListWidgetItem, QPushButton, QWidget

from widgets.basics.accessibility import announce
from widgets.basics.controls import (
    button_with_tip,
    column_layout,
    flat_button,
    row_layout,
    set_role,
    text_label,
)
from widgets.basics.theme import theme_notifier

# A question with one field, in the window rather than in front of it: go to a pixel, type a condition.


class AskBar(QWidget):
    """Asks for a text; Enter hands it on, Escape closes. Errors appear under the field."""

    text_entered = Signal(str, str)
    """The user has typed an answer: name of the question and text."""
    closed = Signal()
    """The user has closed the bar without an answer."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._name = ""
        self.label = QLabel(self)
        self.field = QLineEdit(self)
        self.field.returnPressed.connect(self._enter)
        self.field.textEdited.connect(self._forget_problem)
        self.enter_button = button_with_tip("OK", "Accept (Enter)", self)
        self.enter_button.clicked.connect(self._enter)
        self.close_button = QPushButton("Close", self)
        self.close_button.setProperty("flat", True)
        self.close_button.setToolTip("Cancel (Escape)")
        self.close_button.clicked.connect(self._close)
        self.hint = text_label("", self, wraps=True)
        self._hint = ""
        row = row_layout(spacing=8)
        row.addWidget(self.label)
        row.addWidget(self.field, 1)
        row.addWidget(self.enter_button)
        row.addWidget(self.close_button)
        layout = column_layout(self, 4, margins=(12, 8, 12, 8))
        layout.addLayout(row)
        layout.addWidget(self.hint)
        self.hide()

    def ask(self, name: str, label: str, hint: str, text: str = "") -> None:
        """Ask for a text and take the keyboard; ``hint`` describes the expected text."""
        self._name, self._hint = name, hint
        self.label.setText(label)
        self.field.setAccessibleName(label)
        self.field.setAccessibleDescription(hint)
        self.field.setText(text)
        self.field.selectAll()
        self._forget_problem()
        self.show()
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def show_problem(self, text: str) -> None:
        """Say what is wrong with the answer; the question stays open."""
        self.hint.setText(text)
        set_role(self.hint, "bad")
        announce(self, text, is_urgent=True)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close on Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self._close()
        else:
            super().keyPressEvent(event)

    @Slot()
    def _enter(self) -> None:
        self.text_entered.emit(self._name, self.field.text())

    @Slot()
    def _close(self) -> None:
        self.hide()
        self.closed.emit()

    @Slot()
    def _forget_problem(self) -> None:
        self.hint.setText(self._hint)
        set_role(self.hint, "muted")


# A list that lies over the page, with a field that narrows it: keys, clicks and a clicker choose an entry.


Entry = tuple[str, str]
"""A name that is handed on, and the title that is read."""
MOVES = {Qt.Key.Key_Down: 1, Qt.Key.Key_PageDown: 1, Qt.Key.Key_Up: -1, Qt.Key.Key_PageUp: -1}
"""Entries that a key goes on: a clicker sends Page Down and Page Up for one."""
CHOOSES = (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_F5)
"""Keys that choose: a clicker sends F5."""
CLOSES = Qt.Key.Key_Period
"""Closes while nothing is typed: a clicker has no Escape, and no name begins with it."""


class QuickChooser(QWidget):
    """Entries under headings. Typing narrows them, Return or a click chooses one, Escape or a first period closes."""

    chosen = Signal(str)
    """Name of the chosen entry; the list has closed."""
    other_wanted = Signal()
    """The user wants what is not in the list; it has closed."""

    def __init__(self, title: str, other: str, other_tip: str, parent: QWidget) -> None:
        """``other``: text of the button for what is not in the list."""
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.setAccessibleName(title)
        self._groups: Mapping[str, Sequence[Entry]] = {}
        self._about: Mapping[str, str] = {}
        self.field = QLineEdit(self)
        self.field.setPlaceholderText("Type a part of the name")
        self.field.setAccessibleName(title)
        self.field.textChanged.connect(self._narrow)
        self.field.installEventFilter(self)
        self.list = QListWidget(self)
        self.list.setAccessibleName(title)
        self.list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.list.setVerticalScrollMode(QListWidget.ScrollMode.ScrollPerPixel)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # The keyboard stays in the field.
        self.list.itemClicked.connect(self._choose)
        self._other = button_with_tip(other, other_tip, self)
        self._other.clicked.connect(self._want_other)
        close = flat_button("✕", f"Close: {title}", "Close (Escape)", self)
        close.clicked.connect(self.hide)
        row = row_layout(spacing=8)
        row.addWidget(text_label(title, self, role="title"))
        row.addWidget(self.field, 1)
        row.addWidget(self._other)
        row.addWidget(close)
        self._layout = layout = column_layout(self, 8, margins=(12, 8, 12, 12))
        layout.addLayout(row)
        layout.addWidget(self.list, 1)
        theme_notifier().theme_changed.connect(self._narrow)
        self.hide()

    def ask(self, groups: Mapping[str, Sequence[Entry]], first: str, about: Mapping[str, str]) -> None:
        """Show entries by their headings, take the keyboard, and begin at the entry named ``first``.

        ``about``: what an entry is about, by its name; typed words find it there, too.
        """
        self._groups, self._about = groups, about
        self.field.clear()
        self._fill()
        self.show()
        self.raise_()
        rows = [k for k in range(self.list.count()) if self._name(k) == first]
        self._go_to(rows[0] if rows else self._next_row(-1, 1))
        self.field.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def current(self) -> str:
        """Return the name of the entry that Return chooses; empty: none is left."""
        return self._name(self.list.currentRow())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the entry in sight."""
        super().resizeEvent(event)
        self._layout.activate()  # The list has its height now.
        self._go_to(self.list.currentRow())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Move and choose from the field; the window's keys wait."""
        if not isinstance(event, QKeyEvent) or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            return False
        key = Qt.Key(event.key())
        closes = key == CLOSES and not self.field.text()
        if key not in MOVES and key not in CHOOSES and not closes:
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
            return True
        if event.type() == QEvent.Type.KeyPress:
            if closes:
                self.hide()
            elif key in MOVES:
                self._go_to(self._next_row(self.list.currentRow(), MOVES[key]))
                self._announce()
            else:
                self._choose()
            return True
        return False

    def _announce(self) -> None:
        """Read the entry that was gone to aloud; the keyboard stays in the field."""
        item = self.list.currentItem()
        if item is not None:
            announce(self.list, item.text())

    def _name(self, row: int) -> str:
        """Return the name of the entry in a row; empty: a heading, or no row."""
        item = self.list.item(row)
        return "" if item is None else str(item.data(Qt.ItemDataRole.UserRole) or "")

    def _next_row(self, row: int, direction: int) -> int:
        """Return the next row that has an entry, or the present one where there is none."""
        end = self.list.count() if direction > 0 else -1
        return next((k for k in range(row + direction, end, direction) if self._name(k)), row)

    def _go_to(self, row: int) -> None:
        self.list.setCurrentRow(row)
        self.list.scrollToItem(self.list.item(row), QListWidget.ScrollHint.PositionAtCenter)

    @Slot()
    def _narrow(self) -> None:
        """Leave the entries that have all typed words in their title, name, heading or what they are about."""
        if self.isVisible():
            self._go_to(max(self._fill(), self._next_row(-1, 1)))

    def _fill(self) -> int:
        """Show the entries that are left; return the row of the first that is named by the words, or -1."""
        named = -1
        words = self.field.text().casefold().split()
        self.list.clear()
        for heading, entries in self._groups.items():
            left = [e for e in entries if all(word in self._said(heading, *e) for word in words)]
            if left:
                self._add(heading, "")
            for name, title in left:
                self._add(title, name)
                is_named = all(word in f"{heading} {name} {title}".casefold() for word in words)
                if named < 0 and is_named:
                    named = self.list.count() - 1
        if not self.list.count():
            self._add(f"Nothing here is about “{self.field.text()}”.", "")
            announce(self.list, self.list.item(0).text())
        return named

    def _said(self, heading: str, name: str, title: str) -> str:
        """Return what typed words are sought in."""
        return f"{heading} {name} {title} {self._about.get(name, '')}".casefold()

    def _add(self, text: str, name: str) -> None:
        item = QListWidgetItem(text, self.list)
        item.setData(Qt.ItemDataRole.UserRole, name)
        if not name:
            font = QFont(self.list.font())
            font.setBold(True)
            item.setFont(font)
            item.setFlags(Qt.ItemFlag.NoItemFlags)
            item.setForeground(self.palette().text())

    @Slot()
    def _choose(self) -> None:
        name = self.current()
        if name:
            self.hide()
            self.chosen.emit(name)

    @Slot()
    def _want_other(self) -> None:
        self.hide()
        self.other_wanted.emit()
