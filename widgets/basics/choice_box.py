"""A combo box for panels that scroll and rows that are full: text that does not fit ends in an ellipsis."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QPaintEvent, QWheelEvent
from PySide6.QtWidgets import QComboBox, QStyle, QStyleOptionComboBox, QStylePainter

MOST_SEEN = 16
"""Choices in a list that does not scroll."""


class ChoiceBox(QComboBox):
    """A combo box that a wheel over it does not change and that shortens its text with an ellipsis, not its choices."""

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the box, and as much of the text as fits."""
        painter = QStylePainter(self)
        option = QStyleOptionComboBox()
        self.initStyleOption(option)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        part = QStyle.SubControl.SC_ComboBoxEditField
        room = self.style().subControlRect(QStyle.ComplexControl.CC_ComboBox, option, part, self).width()
        text = self.fontMetrics().elidedText(self.currentText(), Qt.TextElideMode.ElideRight, room - 4)
        option.currentText = text
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
