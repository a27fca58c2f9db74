"""The left column of a page beside the rest; it grows with the size of the type."""

from math import isclose

from PySide6.QtCore import QByteArray, Qt, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from widgets.basics.pane_splitter import PaneSplitter
from widgets.basics.theme import LIGHT, current_theme, theme_notifier

WIDTH = 264
"""Pixels of the left column at the usual size of the type."""
NARROWEST = 12
"""Least width of the left column, in heights of the text."""
WIDEST = 0.45
"""Largest part of the page that growing takes."""


class SideColumns(PaneSplitter):
    """Two columns; what is saved of them is for the usual size of the type, whatever the present one is."""

    def __init__(self, left: QWidget, rest: QWidget, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self.left = left
        self.addWidget(self.left)
        self.addWidget(rest)
        self.setStretchFactor(1, 1)
        self.setSizes([WIDTH, 1000])
        self._text_px = LIGHT.text_px
        """Size of the type that the left column's width was chosen for."""
        self._owed = 1.0
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    @Slot()
    def _follow_theme(self) -> None:
        """Owe the left column as much growth as its text has had."""
        before, self._text_px = self._text_px, current_theme().text_px
        self._owed *= self._text_px / before
        self.left.setMinimumWidth(NARROWEST * self._text_px)
        self._grow()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give what there was no room for: large type comes before the full screen."""
        super().resizeEvent(event)
        self._grow()

    def _grow(self) -> None:
        left, rest = self.sizes()
        wanted = round(left * self._owed)
        if not isclose(self._owed, 1.0) and 0 < wanted < WIDEST * (left + rest):
            self._owed = 1.0
            self.setSizes([wanted, left + rest - wanted])

    def saveState(self) -> QByteArray:
        """Return the widths that the columns have at the usual size of the type."""
        sizes = self.sizes()
        usual = round(sizes[0] * self._owed * LIGHT.text_px / self._text_px)
        self.left.setMinimumWidth(0)
        self.setSizes([usual, sum(sizes) - usual])
        state = super().saveState()
        self.setSizes(sizes)
        self.left.setMinimumWidth(NARROWEST * self._text_px)
        return state

    def restoreState(self, state: QByteArray | bytes | bytearray | memoryview) -> bool:
        """Take widths of the usual size of the type, and let them grow to the present one."""
        is_restored = super().restoreState(state)
        self._owed = self._text_px / LIGHT.text_px
        self._grow()
        return is_restored
