"""The families that can be compared; those that have been measured have a tick."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QPainter, QResizeEvent
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier

Index = QModelIndex | QPersistentModelIndex
_ENDS_GROUP = int(Qt.ItemDataRole.UserRole)
_GROUP_GAP = 9
"""Pixels below a group, with a line in their middle."""


@dataclass(frozen=True)
class FamilyEntry:
    """One family."""

    name: str
    title: str
    note: str = ""
    """Tooltip: what is compared, and what has been measured."""
    is_measured: bool = False
    ends_group: bool = False
    """Whether a line below it sets it off from what follows."""


class _GroupLines(QStyledItemDelegate):
    """Draws a line below every row that ends a group."""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """Leave room for the line."""
        size = super().sizeHint(option, index)
        return size + QSize(0, _GROUP_GAP) if index.data(_ENDS_GROUP) else size

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Draw the row above the line."""
        if not index.data(_ENDS_GROUP):
            super().paint(painter, option, index)
            return
        row, middle = QStyleOptionViewItem(option), option.rect.bottom() - _GROUP_GAP // 2
        row.rect = option.rect.adjusted(0, 0, 0, -_GROUP_GAP)
        super().paint(painter, row, index)
        painter.save()
        painter.setPen(QColor(current_theme().outline))
        painter.drawLine(row.rect.left() + 4, middle, row.rect.right() - 4, middle)
        painter.restore()


class FamilyList(QListWidget):
    """One row for each family."""

    family_chosen = Signal(str)
    """The user has gone to another family."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._entries: tuple[FamilyEntry, ...] = ()
        self.setAccessibleName("Families of methods")
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWordWrap(True)
        self.setResizeMode(QListWidget.ResizeMode.Adjust)
        self.setItemDelegate(_GroupLines(self))
        self.currentRowChanged.connect(self._choose)
        theme_notifier().theme_changed.connect(self._refresh)

    def show_families(self, entries: Sequence[FamilyEntry], current: str) -> None:
        """Show families, and which of them the page is about."""
        self.blockSignals(True)
        if [entry.name for entry in entries] != [entry.name for entry in self._entries]:
            self.clear()
            for _ in entries:
                self.addItem(QListWidgetItem())
        self._entries = tuple(entries)
        self._refresh()
        self.setCurrentRow([entry.name for entry in entries].index(current))
        self.blockSignals(False)

    @Slot()
    def _refresh(self) -> None:
        side = current_theme().text_px
        for row, entry in enumerate(self._entries):
            item = self.item(row)
            item.setText(entry.title)
            item.setToolTip(f"{entry.title}\n{entry.note}")
            mark = mark_pixmap(Mark.RIGHT, side, self.devicePixelRatioF())
            if not entry.is_measured:
                mark.fill("transparent")
            item.setIcon(mark)
            item.setData(_ENDS_GROUP, entry.ends_group)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap long titles again."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Take no more height than the rows need."""
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        self.setMaximumHeight(max(rows + 2 * self.frameWidth(), self.minimumSizeHint().height()))

    @Slot(int)
    def _choose(self, row: int) -> None:
        if 0 <= row < len(self._entries):
            self.family_chosen.emit(self._entries[row].name)
