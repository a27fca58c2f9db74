"""What stands for a page that would show what is asked about, with the ways back to the question."""

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import button_with_tip, column_layout, row_layout, text_label

COVERED = {
    "exercise": "Hidden while an exercise asks about this scene.",
    "lesson": "Hidden while a lesson asks about this scene.",
}
"""What is said of a hidden page, by who asks."""


class Cover(QWidget):
    """Says why a page is hidden, and offers the question, or to leave the lesson that asks it."""

    back_requested = Signal()
    leave_requested = Signal()

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.said = text_label("", self, role="muted")
        self.back_button = button_with_tip("Go back to the question", "Show what is asked", self)
        self.leave_button = button_with_tip(
            "Leave the lesson", "Close the lesson; what you have done of it is kept", self
        )
        self.back_button.clicked.connect(self.back_requested)
        self.leave_button.clicked.connect(self.leave_requested)
        self.setFocusProxy(self.back_button)
        buttons = row_layout(spacing=8)
        buttons.addStretch(1)
        buttons.addWidget(self.back_button)
        buttons.addWidget(self.leave_button)
        buttons.addStretch(1)
        column = column_layout(self, 12)
        column.addStretch(1)
        column.addWidget(self.said, 0, Qt.AlignmentFlag.AlignHCenter)
        column.addLayout(buttons)
        column.addStretch(1)

    def show_asker(self, asker: str) -> None:
        """Name who asks."""
        self.said.setText(COVERED[asker])
        self.leave_button.setVisible(asker == "lesson")
