"""The page on which keys are changed: every action with its keys, and a field that listens to the next key."""

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent, QKeySequence, QShowEvent
from PySide6.QtWidgets import QCheckBox, QKeySequenceEdit, QTreeWidget, QTreeWidgetItem, QWidget

from widgets.basics.accessible import announce
from widgets.basics.controls import button_with_tip, closing_button, column_layout, row_layout
from widgets.basics.key_help import KeyEntry
from widgets.basics.labels import set_role, text_label

_HINT = "Choose an action, press its new key in the field, then Use this key."


class KeyEditor(QWidget):
    """Reports which key the user wants for which action; what came of it is shown."""

    key_wanted = Signal(int, str)
    """Place of the action in the table, and Qt's portable text of its only key; empty: no key."""
    default_wanted = Signal(int)
    """Place of an action that is to have its first keys again."""
    characters_wanted = Signal(bool)
    """Whether letters, digits and signs alone are to be keys."""
    closed = Signal()
    """The user wants to leave the page."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "panel")
        self.setAccessibleName("Change keys")
        self.characters_box = QCheckBox("Letters, digits and signs alone are keys", self)
        self.characters_box.setToolTip("Turn off when speech input or a tremor types keys by mistake")
        self.characters_box.clicked.connect(self.characters_wanted)
        self.table = QTreeWidget(self)
        self.table.setColumnCount(3)
        self.table.setHeaderLabels(["Group", "Action", "Keys"])
        self.table.setRootIsDecorated(False)
        self.table.setUniformRowHeights(True)
        self.table.setAccessibleName("Actions and their keys")
        self.table.currentItemChanged.connect(self._show_hint)
        self.field = QKeySequenceEdit(self)
        self.field.setMaximumSequenceLength(1)
        self.field.setAccessibleName("New key")
        self.use_button = button_with_tip("Use this key", "Make this the key of the chosen action", self)
        self.none_button = button_with_tip("No key", "Leave the chosen action without a key", self)
        self.default_button = button_with_tip("Default", "Give the chosen action its first keys again", self)
        self.use_button.clicked.connect(self._use)
        self.none_button.clicked.connect(self._clear)
        self.default_button.clicked.connect(self._restore)
        self.close_button = closing_button("the keys", self)
        self.close_button.clicked.connect(self.closed)
        self.note = text_label(_HINT, self, role="muted", wraps=True)
        self._lay_out()

    def _lay_out(self) -> None:
        top, row = row_layout(spacing=12), row_layout(spacing=8)
        top.addWidget(text_label("Change keys", self, role="title"))
        top.addWidget(self.characters_box)
        top.addStretch(1)
        top.addWidget(self.close_button)
        for widget in (text_label("New key", self), self.field):
            row.addWidget(widget)
        for button in (self.use_button, self.none_button, self.default_button):
            row.addWidget(button)
        row.addWidget(self.note, 1)
        layout = column_layout(self, 12, margins=(16, 12, 16, 12))
        layout.addLayout(top)
        layout.addWidget(self.table, 1)
        layout.addLayout(row)

    def show_keys(self, entries: Sequence[KeyEntry], has_characters: bool) -> None:
        """Show the actions with their keys; the chosen one stays."""
        chosen = max(self._chosen(), 0)
        self.table.clear()
        self.table.addTopLevelItems([QTreeWidgetItem([e.group, e.what, e.keys]) for e in entries])
        self.table.setCurrentIndex(self.table.model().index(chosen, 0))
        for column in range(2):
            self.table.resizeColumnToContents(column)
        self.characters_box.setChecked(has_characters)
        self.field.clear()

    def show_note(self, text: str, *, is_problem: bool = False) -> None:
        """Say what came of a wish."""
        self.note.setText(text)
        set_role(self.note, "bad" if is_problem else "good")
        announce(self, text, is_urgent=is_problem)

    def showEvent(self, event: QShowEvent) -> None:
        """Begin in the table."""
        super().showEvent(event)
        self.table.setFocus(Qt.FocusReason.OtherFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Close with Escape."""
        if event.key() == Qt.Key.Key_Escape:
            self.closed.emit()
        else:
            super().keyPressEvent(event)

    def _chosen(self) -> int:
        return self.table.currentIndex().row()

    @Slot()
    def _show_hint(self) -> None:
        self.note.setText(_HINT)
        set_role(self.note, "muted")

    @Slot()
    def _use(self) -> None:
        text = self.field.keySequence().toString(QKeySequence.SequenceFormat.PortableText)
        if text:
            self.key_wanted.emit(self._chosen(), text)
        else:
            self.show_note("Press a key in the field first.", is_problem=True)

    @Slot()
    def _clear(self) -> None:
        self.key_wanted.emit(self._chosen(), "")

    @Slot()
    def _restore(self) -> None:
        self.default_wanted.emit(self._chosen())
