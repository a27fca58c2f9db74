"""A part of a pane that is folded away under its title until it is opened."""

from PySide6.QtCore import Qt, Slot
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from widgets.basics.controls import column_layout
from widgets.basics.labels import text_label


class Fold(QWidget):
    """A title that opens and closes the text under it."""

    def __init__(self, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._title = title
        self.button = QToolButton(self)
        self.button.setProperty("flat", True)
        self.button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.button.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        font = self.button.font()
        font.setBold(True)
        self.button.setFont(font)
        self.text = text_label("", self, wraps=True)
        self.text.setTextFormat(Qt.TextFormat.RichText)
        self.text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.text.setContentsMargins(8, 0, 8, 8)
        layout = column_layout(self, 0)
        layout.addWidget(self.button)
        layout.addWidget(self.text)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        self.button.clicked.connect(self._toggle)
        self.set_open(False)

    @property
    def is_open(self) -> bool:
        """Whether the text can be read."""
        return self.text.isVisibleTo(self)

    def show_text(self, text: str, note: str = "") -> None:
        """Put rich text under the title, and a ``note`` behind it."""
        self.button.setText(f"{self._title}  {note}".rstrip())
        self.text.setText(text)

    def set_open(self, is_open: bool) -> None:
        """Open or close it."""
        self.text.setVisible(is_open)
        self.button.setArrowType(Qt.ArrowType.DownArrow if is_open else Qt.ArrowType.RightArrow)

    @Slot()
    def _toggle(self) -> None:
        self.set_open(not self.is_open)
