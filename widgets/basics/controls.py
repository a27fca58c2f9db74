"""Rows and columns of widgets with their gaps, and buttons that say what they do."""

from typing import TypeVar

from PySide6.QtWidgets import QAbstractButton, QHBoxLayout, QPushButton, QToolButton, QVBoxLayout, QWidget

Margins = tuple[int, int, int, int]
"""Logical pixels at the left, top, right and bottom."""
Box = TypeVar("Box", QHBoxLayout, QVBoxLayout)
LEAST_TARGET = 24
"""Least width and height of what is clicked, in logical pixels (WCAG 2.2, 2.5.8)."""
NO_MARGINS: Margins = (0, 0, 0, 0)


def row_layout(
    parent: QWidget | None = None, spacing: int | None = None, margins: Margins = NO_MARGINS
) -> QHBoxLayout:
    """Return an empty row, the layout of ``parent`` if there is one; ``spacing``: between two widgets."""
    return _with_gaps(QHBoxLayout() if parent is None else QHBoxLayout(parent), spacing, margins)


def column_layout(
    parent: QWidget | None = None, spacing: int | None = None, margins: Margins = NO_MARGINS
) -> QVBoxLayout:
    """Return an empty column, as `row_layout`."""
    return _with_gaps(QVBoxLayout() if parent is None else QVBoxLayout(parent), spacing, margins)


def _with_gaps(box: Box, spacing: int | None, margins: Margins) -> Box:
    box.setContentsMargins(*margins)
    if spacing is not None:
        box.setSpacing(spacing)
    return box


def button_with_tip(text: str, tip: str, parent: QWidget) -> QPushButton:
    """Return a button that says what it does when it is pointed at."""
    button = QPushButton(text, parent)
    button.setToolTip(tip)
    return button


def flat_button(text: str, name: str, tip: str, parent: QWidget) -> QToolButton:
    """Return a button without a frame: one sign, with a name for who does not see it, and a tip."""
    button = QToolButton(parent)
    button.setText(text)
    button.setProperty("flat", True)
    button.setAccessibleName(name)
    button.setToolTip(tip)
    return button


def closing_button(what: str, parent: QWidget) -> QToolButton:
    """Return the cross that closes ``what``, as ``the case``; Escape does the same."""
    return flat_button("✕", f"Close {what}", f"Close {what} (Escape)", parent)


def wrap_text(button: QAbstractButton, text: str, width: int) -> None:
    """Write a text on a button in as many lines as it takes in a width; a screen reader hears one."""
    metrics = button.fontMetrics()
    room = width - (button.sizeHint().width() - metrics.size(0, button.text()).width())
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and metrics.horizontalAdvance(longer) > room:
            lines.append(word)
        else:
            lines[-1] = longer
    button.setMinimumWidth(1)
    button.setAccessibleName(text)
    button.setText("\n".join(lines))
