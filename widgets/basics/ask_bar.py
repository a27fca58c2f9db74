"""A question with one field, in the window rather than in front of it: go to a pixel, type a condition."""

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLabel, QLineEdit, QPushButton, QWidget

from widgets.basics.accessible import announce
from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.labels import set_role, text_label


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
