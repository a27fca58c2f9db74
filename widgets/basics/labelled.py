"""A control with its name before it."""

from PySide6.QtWidgets import QHBoxLayout, QLabel, QWidget


def labelled(text: str, control: QWidget) -> QWidget:
    """Return a widget that holds a label and the control that it names."""
    pair = QWidget()
    row = QHBoxLayout(pair)
    row.setContentsMargins(0, 0, 0, 0)
    row.setSpacing(4)
    label = QLabel(text, pair)
    label.setBuddy(control)
    row.addWidget(label)
    row.addWidget(control)
    return pair
