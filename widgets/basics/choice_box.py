"""A combo box whose list is as wide as its choices, and that writes a long choice in several rows."""

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QPaintEvent, QTextLayout, QWheelEvent
from PySide6.QtWidgets import QComboBox, QSizePolicy, QStyle, QStyleOptionComboBox, QStylePainter, QWidget

MOST_SEEN = 16
"""Choices in a list that does not scroll."""
INSET = 2
"""Room on each side of the text, as the style leaves it."""


class ChoiceBox(QComboBox):
    """A combo box that a wheel over it does not change and that shortens its text with an ellipsis, not its choices.

    Where its text may take several rows it grows with them, in a layout that knows height for width.
    """

    def __init__(self, parent: QWidget | None = None, most_rows: int = 1) -> None:
        super().__init__(parent)
        self._most_rows = most_rows
        if most_rows > 1:
            policy = QSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
            policy.setHeightForWidth(True)
            self.setSizePolicy(policy)
            self.currentTextChanged.connect(self.updateGeometry)

    def shown_rows(self) -> list[str]:
        """Return the text as it is drawn: broken between words, the last row that it may take shortened."""
        return self._rows(self.width())

    def heightForWidth(self, width: int) -> int:
        """Return the height of as many rows as the text takes."""
        return self.sizeHint().height() + (len(self._rows(width)) - 1) * self.fontMetrics().lineSpacing()

    def _rows(self, width: int) -> list[str]:
        option = QStyleOptionComboBox()
        self.initStyleOption(option)
        option.rect = QRect(0, 0, width, self.height())
        room = max(self._text_part(option).width(), 1)
        metrics, rest, rows = self.fontMetrics(), self.currentText(), list[str]()
        if metrics.horizontalAdvance(rest) <= room:
            return [rest]
        layout = QTextLayout(rest, self.font())
        layout.beginLayout()
        while len(rows) < self._most_rows - 1 and metrics.horizontalAdvance(rest) > room:
            line = layout.createLine()
            line.setLineWidth(room)
            row = rest[: line.textLength()].strip()
            rows.append(metrics.elidedText(row, Qt.TextElideMode.ElideRight, room))  # A long word.
            rest = rest[line.textLength() :]
        layout.endLayout()
        return [*rows, metrics.elidedText(rest, Qt.TextElideMode.ElideRight, room)]

    def _text_part(self, option: QStyleOptionComboBox) -> QRect:
        part = QStyle.SubControl.SC_ComboBoxEditField
        room = self.style().subControlRect(QStyle.ComplexControl.CC_ComboBox, option, part, self)
        return room.adjusted(INSET, 0, -INSET, 0)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the box, and as much of the text as fits."""
        painter = QStylePainter(self)
        option = QStyleOptionComboBox()
        self.initStyleOption(option)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        option.currentText = "\n".join(self.shown_rows())
        painter.drawControl(QStyle.ControlElement.CE_ComboBoxLabel, option)

    def showPopup(self) -> None:
        """Show the choices in a list as wide as the longest of them."""
        self.setMaxVisibleItems(MOST_SEEN)
        view = self.view()
        bar = view.verticalScrollBar().sizeHint().width() if self.count() > MOST_SEEN else 0
        view.setMinimumWidth(view.sizeHintForColumn(0) + 2 * view.frameWidth() + bar)
        super().showPopup()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Leave the wheel to what scrolls."""
        event.ignore()
