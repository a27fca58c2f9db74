"""The three columns of the Step page: the open side pane, the main view, the inspector."""

from math import isfinite

from PySide6.QtCore import QByteArray, Qt, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QWidget

from widgets.basics.pane_splitter import PaneSplitter
from widgets.basics.theme import current_theme, theme_notifier

WIDTHS = (28.0, 32.0)
"""Widths of the side pane and of the inspector at first, in heights of the text."""
NARROWEST = (15, 18)
"""Least widths of both, in heights of the text."""
WIDEST = 60.0
PRESENTED = 0.39
"""Part of the page that the inspector takes while presenting; the picture has 55 % of the screen."""
GIVES_WAY_TO = 28
"""Width down to which the inspector gives way to an open side pane, in heights of the text; then both get narrower."""
SIDES_AT_MOST = 0.6
"""Largest part of the page that both take together."""


class StepColumns(PaneSplitter):
    """Columns whose sides keep their widths in heights of the text: larger type makes them wider."""

    def __init__(self, side: QWidget, main: QWidget, inspector: QWidget, parent: QWidget) -> None:
        super().__init__(Qt.Orientation.Horizontal, parent)
        self._sides = (side, inspector)
        self._widths = list(WIDTHS)
        self._is_presenting = False
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

    @Slot()
    def spread(self) -> None:
        """Give the sides that are shown their widths, and the main view the rest: at least a third."""
        text = current_theme().text_px
        for widget, least in zip(self._sides, NARROWEST, strict=True):
            widget.setMinimumWidth(least * text)
        wanted = [
            0.0 if widget.isHidden() else width * text
            for widget, width in zip(self._sides, self._widths, strict=True)
        ]
        if self._is_presenting and wanted[1]:
            wanted[1] = PRESENTED * self.width()
        room = SIDES_AT_MOST * self.width()
        wanted[1] -= min(max(sum(wanted) - room, 0.0), max(wanted[1] - GIVES_WAY_TO * text, 0.0))
        scale = min(1.0, room / max(sum(wanted), 1.0))
        left, right = (round(width * scale) for width in wanted)
        self.setSizes([left, max(self.width() - left - right, 1), right])

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
        if len(widths) != 2 or not all(isfinite(width) and 0 < width <= WIDEST for width in widths):
            return False
        self._widths = widths
        self.spread()
        return True
