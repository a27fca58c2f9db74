"""The columns of pages: one at the left beside the rest, and the three of the Step page."""

from math import isclose, isfinite

from PySide6.QtCore import QByteArray, Qt, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from widgets.basics.panes import PaneSplitter
from widgets.basics.theme import LIGHT, current_theme, theme_notifier

# The left column of a page beside the rest; it grows with the size of the type.


WIDTH = 264
"""Pixels of the left column at the usual size of the type."""
NARROWEST_LEFT = 12
"""Least width of the left column, in heights of the text."""
WIDEST_LEFT = 0.45
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
        self.left.setMinimumWidth(NARROWEST_LEFT * self._text_px)
        self._grow()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give what there was no room for: large type comes before the full screen."""
        super().resizeEvent(event)
        self._grow()

    def _grow(self) -> None:
        left, rest = self.sizes()
        wanted = round(left * self._owed)
        if not isclose(self._owed, 1.0) and 0 < wanted < WIDEST_LEFT * (left + rest):
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
        self.left.setMinimumWidth(NARROWEST_LEFT * self._text_px)
        return state

    def restoreState(self, state: QByteArray | bytes | bytearray | memoryview) -> bool:
        """Take widths of the usual size of the type, and let them grow to the present one."""
        is_restored = super().restoreState(state)
        self._owed = self._text_px / LIGHT.text_px
        self._grow()
        return is_restored


# The three columns of the Step page: the open side pane, the main view, the inspector.


WIDTHS = (28.0, 32.0)
"""Widths of the side pane and of the inspector at first, in heights of the text."""
NARROWEST_SIDES = (15, 18)
"""Least widths of both, in heights of the text."""
WIDEST_SIDE = 60.0
PRESENTED = 0.39
"""Part of the page that the inspector takes while presenting; the picture has 55 % of the screen."""
GIVES_WAY_TO = 28
"""Width down to which the inspector gives way to an open side pane, in heights of the text; then both get narrower."""
INSPECTOR_AT_MOST, SIDES_AT_MOST = 0.5, 0.6
"""Largest part of the page that the inspector takes, and both together."""


class StepColumns(PaneSplitter):
    """Columns whose sides keep their widths in heights of the text: larger type makes them wider."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._sides: tuple[QWidget, QWidget]
        self._widths = list(WIDTHS)
        self._is_presenting = False

    def show_columns(self, side: QWidget, main: QWidget, inspector: QWidget) -> None:
        """Show these, which are its children already: to give them another parent would take 20 ms."""
        self._sides = (side, inspector)
        for widget in (side, main, inspector):
            self.addWidget(widget)
        self.setStretchFactor(1, 1)
        self.setChildrenCollapsible(False)
        self.splitterMoved.connect(self._remember)
        theme_notifier().theme_changed.connect(self.spread)
        self.spread()

    def set_presenting(self, is_presenting: bool) -> None:
        """Give the inspector a fixed part of the page, or its own width again."""
        self._is_presenting = is_presenting
        self.spread()

    def show_side(self, is_shown: bool) -> None:
        """Show the side pane or fold it away; what it shows is laid out in its width at once, not first in another."""
        side, inspector = self._sides
        if is_shown and side.isHidden():
            side.resize(self._widths_of(True, not inspector.isHidden())[0], self.height())
        side.setVisible(is_shown)

    @Slot()
    def spread(self) -> None:
        """Give the sides that are shown their widths, and the main view the rest: at least a third."""
        text = current_theme().text_px
        for widget, least in zip(self._sides, NARROWEST_SIDES, strict=True):
            widget.setMinimumWidth(least * text)
        left, right = self._widths_of(*(not widget.isHidden() for widget in self._sides))
        if not self._is_presenting and not self._sides[0].isHidden():
            # Qt does so later, and divides once more.
            self.handle(1).show()
        self.setSizes([left, max(self.width() - left - right, 1), right])

    def _widths_of(self, *are_shown: bool) -> list[int]:
        """Return the widths of the side pane and of the inspector, by which of them are shown."""
        text = current_theme().text_px
        wanted = [is_shown * width * text for is_shown, width in zip(are_shown, self._widths, strict=True)]
        wanted[1] = min(wanted[1], INSPECTOR_AT_MOST * self.width())
        if self._is_presenting and wanted[1]:
            wanted[1] = PRESENTED * self.width()
        room = SIDES_AT_MOST * self.width()
        wanted[1] -= min(max(sum(wanted) - room, 0.0), max(wanted[1] - GIVES_WAY_TO * text, 0.0))
        scale = min(1.0, room / max(sum(wanted), 1.0))
        return [round(width * scale) for width in wanted]

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give the main view what the window has gained or lost."""
        super().resizeEvent(event)
        self.spread()

    @Slot()
    def _remember(self) -> None:
        """Keep the widths that the user has dragged the columns to."""
        for place, widget in enumerate(self._sides):
            if not (widget.isHidden() or self._is_presenting):
                self._widths[place] = widget.width() / current_theme().text_px

    def saveState(self) -> QByteArray:
        """Return the widths in heights of the text."""
        return QByteArray(" ".join(f"{width:.3f}" for width in self._widths).encode("ascii"))

    def restoreState(self, state: QByteArray | bytes | bytearray | memoryview) -> bool:
        """Take widths that were saved; what does not look like two widths changes nothing."""
        try:
            widths = [float(part) for part in QByteArray(state).toStdString().split()]
        except ValueError:
            return False
        if len(widths) != 2 or not all(isfinite(width) and 0 < width <= WIDEST_SIDE for width in widths):
            return False
        self._widths = widths
        self.spread()
        return True
