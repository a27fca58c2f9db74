"""Ticks and crosses: beside the items of a list, and on a label."""

from PySide6.QtCore import QSize
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QLabel, QListWidget, QSizePolicy

from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.theme import current_theme


class ItemList(QListWidget):
    """Items with marks."""

    def fit_height(self, spare: int) -> None:
        """Be as high as all items and ``spare`` pixels."""
        self._spare = spare
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Return the height of all items, where it is to be that."""
        hint = super().sizeHint()
        if self.sizePolicy().verticalPolicy() != QSizePolicy.Policy.Fixed:
            return hint
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        return QSize(hint.width(), rows + 2 * self.frameWidth() + self._spare)

    def show_mark(self, row: int, mark: Mark | None, tip: str = "") -> None:
        """Mark an item; ``None`` takes the mark away."""
        side = current_theme().text_px
        self.setIconSize(QSize(side, side))
        icon = QIcon() if mark is None else QIcon(mark_pixmap(mark, side, self.devicePixelRatioF()))
        self.item(row).setIcon(icon)
        self.item(row).setToolTip(tip if mark is not None else "")
        self.updateGeometry()  # In large type a mark makes its item higher.


def show_mark(label: QLabel, is_right: bool | None) -> None:
    """Show a tick, a cross, or nothing, with its word for who does not see it."""
    mark = {True: Mark.RIGHT, False: Mark.WRONG}.get(is_right)  # type: ignore[arg-type]
    label.clear()
    label.setAccessibleName(mark.value if mark else "")
    label.setToolTip(mark.value if mark else "")
    if mark is not None:
        label.setPixmap(mark_pixmap(mark, current_theme().text_px, label.devicePixelRatioF()))
