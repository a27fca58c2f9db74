"""What the views with linked grids and buttons have in common: the buttons, and what is read at a pixel."""

from collections.abc import Sequence

from PySide6.QtWidgets import QPushButton, QToolButton, QWidget

from widgets.grid.buffer import GridBuffer

Pixel = tuple[int, int]


def button_with_tip(text: str, tip: str, parent: QWidget) -> QPushButton:
    """Return a button that says what it does when it is pointed at."""
    button = QPushButton(text, parent)
    button.setToolTip(tip)
    return button


def closing_button(what: str, parent: QWidget) -> QToolButton:
    """Return the cross that closes ``what``, as ``the case``; Escape does the same."""
    button = QToolButton(parent)
    button.setText("✕")
    button.setProperty("flat", True)
    button.setAccessibleName(f"Close {what}")
    button.setToolTip(f"Close {what} (Escape)")
    return button


def reading_at(pixel: Pixel, buffers: Sequence[GridBuffer]) -> str:
    """Return the values of buffers at a pixel."""
    read = ", ".join(f"{buffer.label} {buffer.text_at(*pixel)}" for buffer in buffers)
    return f"pixel ({pixel[0]}, {pixel[1]}): {read}"
