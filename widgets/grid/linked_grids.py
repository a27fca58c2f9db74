"""Three pixel grids side by side that move, point and pin as one."""

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal, Slot
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QGridLayout, QWidget

from widgets.basics.accessibility import announce
from widgets.basics.controls import CutLabel, closing_button, text_label
from widgets.basics.theme import current_theme
from widgets.grid.layers import GridBuffer
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView

NOTHING_YET = "Nothing to show yet"
SPACING = 8
"""Between grids, in logical pixels."""
SHARES = 100
"""Parts into which the height of two rows is divided."""
LEAST_HEIGHT = 9
"""Of the pictures with their titles, in heights of the text."""


class LinkedGrids(QWidget):
    """Grids with a title above each; zooming one zooms all."""

    pixel_hovered = Signal(int, int)
    pixel_left = Signal()
    pixel_clicked = Signal(int, int)

    def __init__(self, names: Sequence[str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._names = tuple(names)
        self.grids = tuple(PixelGrid(self) for _ in names)
        self.titles = tuple(CutLabel(self) for _ in names)
        self._rest: QWidget | None = None
        self._layout = layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(SPACING)
        for name, title, grid in zip(names, self.titles, self.grids, strict=True):
            grid.setAccessibleName(f"Pixel grid {name}")
            grid.pixel_hovered.connect(self.pixel_hovered)
            grid.pixel_left.connect(self.pixel_left)
            grid.pixel_clicked.connect(self.pixel_clicked)
            grid.view_changed.connect(self._link_views)
            title.setAlignment(Qt.AlignmentFlag.AlignBottom)
            title.setProperty("role", "muted")
            # Else Qt would show and paint them once more, a moment after they are placed otherwise.
            title.show()
            grid.show()
        self._place(len(self.grids))

    def _place(self, columns: int) -> None:
        """Put each title above its grid, a number of them beside each other."""
        layout = self._layout
        for number, (title, grid) in enumerate(zip(self.titles, self.grids, strict=True)):
            row, column = divmod(number, columns)
            layout.addWidget(title, 2 * row, column)
            layout.addWidget(grid, 2 * row + 1, column)
        for column in range(len(self.grids)):
            layout.setColumnStretch(column, column < columns)
        self.share_height(1.0)

    @property
    def is_folded(self) -> bool:
        """Whether the last grid stands below the others."""
        return self._rest is not None

    def fold(self, rest: QWidget | None) -> None:
        """Put the last of three grids below the others, and beside it the ``rest``; ``None``: all in one row."""
        if self._rest is not None:
            self._layout.removeWidget(self._rest)
        self._rest = rest
        self._place(len(self.grids) - (rest is not None))
        if rest is not None:
            self._layout.addWidget(rest, 2, 1, 2, 1)

    def share_height(self, upper: float) -> None:
        """Give the grids above a part of the height, and the one below the others the rest."""
        self._layout.setRowStretch(1, round(SHARES * upper))
        self._layout.setRowStretch(3, SHARES - round(SHARES * upper))

    def show_last(self, is_shown: bool) -> None:
        """Show the last of the grids, or leave its room to the others."""
        for widget in (self.titles[-1], self.grids[-1]):
            widget.setVisible(is_shown)
        if not self.is_folded:
            self._place(len(self.grids) - (not is_shown))

    def minimumSizeHint(self) -> QSize:
        """Return a size in which the pictures can be seen below their titles."""
        return super().minimumSizeHint().expandedTo(QSize(0, LEAST_HEIGHT * current_theme().text_px))

    def show_buffers(self, buffers: Sequence[GridBuffer], titles: Sequence[str]) -> None:
        """Show a picture in every grid."""
        for grid, buffer in zip(self.grids, buffers, strict=True):
            grid.show_buffer(buffer)
        for label, title in zip(self.titles, titles, strict=True):
            label.setText(title)

    def show_nothing(self, texts: Sequence[str] = ()) -> None:
        """Show no pictures, and in their places ``texts`` that say what comes there."""
        for place, (label, name, grid) in enumerate(zip(self.titles, self._names, self.grids, strict=True)):
            grid.empty_text = texts[place] if texts else NOTHING_YET
            grid.show_buffer(None)
            grid.show_overlays(())
            label.setText(name)

    def show_pointing(self, pin: tuple[int, int] | None, hover: tuple[int, int] | None) -> None:
        """Mark pin and hover in all grids."""
        for grid in self.grids:
            grid.show_pin(pin)
            grid.show_hover(hover)

    @Slot(object)
    def _link_views(self, view: GridView) -> None:
        for grid in self.grids:
            grid.set_view(view)


Pixel = tuple[int, int]
FURTHER = 8
"""Pixels that an arrow key goes with Shift."""
_ARROWS = {
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}
"""Columns to the right and rows up."""


def reading_at(pixel: Pixel, buffers: Sequence[GridBuffer]) -> str:
    """Return the values of buffers at a pixel."""
    read = ", ".join(f"{buffer.label} {buffer.text_at(*pixel)}" for buffer in buffers)
    return f"pixel ({pixel[0]}, {pixel[1]}): {read}"


class PinnedPictures(QWidget):
    """Linked grids with the values of the pixel that is pointed at, else of the one that is pinned."""

    step_requested = Signal()
    closing_requested = Signal()
    hint = "Point at a pixel to read its values, or go to it with the arrow keys."
    """What stands there while no pixel is chosen."""

    def __init__(self, names: Sequence[str], closes: str, parent: QWidget | None = None) -> None:
        """Make empty grids, and a cross that ``closes`` what is shown, as ``the case``."""
        super().__init__(parent)
        self._buffers: Sequence[GridBuffer] | None = None
        self._pin: Pixel | None = None
        self._hover: Pixel | None = None
        self.linked = LinkedGrids(names, self)
        self.values = text_label("", self, role="muted")
        self.close_button = closing_button(closes, self)
        self.close_button.clicked.connect(self.closing_requested)
        self.linked.pixel_hovered.connect(self._hover_pixel)
        self.linked.pixel_left.connect(self._leave)
        self.linked.pixel_clicked.connect(self._pin_pixel)

    @property
    def pin(self) -> Pixel | None:
        """The pinned pixel, column and row: one that the user has clicked, or that came with what is shown."""
        return self._pin

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Pin the neighbouring pixel with an arrow, with Shift one further off; the first arrow pins the middle."""
        across, up = _ARROWS.get(Qt.Key(event.key()), (0, 0))
        if self._buffers is None or not (across or up):
            super().keyPressEvent(event)
            return
        columns, rows = self._buffers[0].columns, self._buffers[0].rows
        if self._pin is None:
            self._pin = columns // 2, rows // 2
        else:
            length = FURTHER if event.modifiers() & Qt.KeyboardModifier.ShiftModifier else 1
            column, row = self._pin[0] + length * across, self._pin[1] + length * up
            self._pin = min(max(column, 0), columns - 1), min(max(row, 0), rows - 1)
        self._hover = None
        self._show_pointing()
        announce(self, self.values.text())

    def _show_pointing(self) -> None:
        self.linked.show_pointing(self._pin, self._hover)
        pixel = self._hover or self._pin
        if self._buffers is None:
            self.values.setText("")
        else:
            self.values.setText(self.hint if pixel is None else reading_at(pixel, self._buffers))

    @Slot(int, int)
    def _hover_pixel(self, column: int, row: int) -> None:
        self._hover = (column, row)
        self._show_pointing()

    @Slot()
    def _leave(self) -> None:
        self._hover = None
        self._show_pointing()

    @Slot(int, int)
    def _pin_pixel(self, column: int, row: int) -> None:
        self._pin = (column, row)
        self._show_pointing()
