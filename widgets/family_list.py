"""The families that can be compared; those that have been measured have a tick."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from widgets.marks import Mark, mark_pixmap
from widgets.theme import current_theme, theme_notifier


@dataclass(frozen=True)
class FamilyEntry:
    """One family."""

    name: str
    title: str
    note: str = ""
    """Tooltip: what is compared, and what has been measured."""
    is_measured: bool = False


class FamilyList(QListWidget):
    """One row for each family."""

    family_chosen = Signal(str)
    """The user has gone to another family."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._entries: tuple[FamilyEntry, ...] = ()
        self.setAccessibleName("Families of methods")
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
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

    @Slot(int)
    def _choose(self, row: int) -> None:
        if 0 <= row < len(self._entries):
            self.family_chosen.emit(self._entries[row].name)
