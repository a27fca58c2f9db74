"""The history of a pixel as records, and as the list model that a view shows."""

from dataclasses import dataclass

from PySide6.QtCore import QAbstractListModel, QModelIndex, QPersistentModelIndex, QSortFilterProxyModel, Qt
from PySide6.QtWidgets import QWidget

from core.explain.number_text import full_text
from widgets.basics.marks import Mark

ENTRY_ROLE = Qt.ItemDataRole.UserRole
"""Role of the `HistoryEntry` itself."""


@dataclass(frozen=True)
class PixelValue:
    """A colour with the depth that goes with it."""

    rgba: tuple[int, int, int, int]
    """Display (sRGB) bytes with straight alpha."""
    depth: float | None = None
    """As the depth method stores it; None where there is none."""


@dataclass(frozen=True)
class HistoryEntry:
    """One event at the pixel."""

    title: str
    """``Initial value``, ``Clear``, ``Triangle 12`` ..."""
    before: PixelValue | None = None
    out: PixelValue | None = None
    """What the fragment offers."""
    after: PixelValue | None = None
    mark: Mark | None = None
    """Kept (`Mark.RIGHT` or `Mark.COVERED`), or how it was rejected; None where it is no fragment."""
    reason: str = ""
    """Why it was kept or rejected, in words."""
    is_rejected: bool = False


@dataclass(frozen=True)
class PixelStory:
    """The history of one pixel."""

    column: int
    row: int
    verdict: str
    """One sentence: what became of the pixel and why."""
    mark: Mark | None = None
    entries: tuple[HistoryEntry, ...] = ()


class StoryModel(QAbstractListModel):
    """The entries as a list model; a role tells the row in the story."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.entries: tuple[HistoryEntry, ...] = ()

    def show_entries(self, entries: tuple[HistoryEntry, ...]) -> None:
        """Take other entries."""
        self.beginResetModel()
        self.entries = entries
        self.endResetModel()

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        """Count the entries."""
        return 0 if parent.isValid() else len(self.entries)

    def data(
        self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return the entry itself, its line, or its full text."""
        entry = self.entries[index.row()]
        if role == ENTRY_ROLE:
            return entry
        if role == Qt.ItemDataRole.DisplayRole:
            return f"{entry.title}: {entry.reason}" if entry.reason else entry.title
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole):
            return entry_text(entry)
        return None


class StoryFilter(QSortFilterProxyModel):
    """Leaves out rejected fragments on request."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.shows_rejected = True

    def show_rejected(self, is_shown: bool) -> None:
        """Let rejected fragments through or leave them out."""
        self.shows_rejected = is_shown
        self.invalidate()

    def filterAcceptsRow(self, source_row: int, source_parent: QModelIndex | QPersistentModelIndex) -> bool:
        """Let an entry through unless it is rejected and left out."""
        entry: HistoryEntry = self.sourceModel().index(source_row, 0, source_parent).data(ENTRY_ROLE)
        return self.shows_rejected or not entry.is_rejected


def entry_text(entry: HistoryEntry) -> str:
    """Return an entry as text with full precision, for tooltips, screen readers and the clipboard."""
    lines = [entry.title]
    for name, value in (("before", entry.before), ("out", entry.out), ("after", entry.after)):
        if value is not None:
            depth = "" if value.depth is None else f", depth {full_text(value.depth)}"
            lines.append(
                f"{name}: sRGB ({', '.join(map(str, value.rgba[:3]))}), alpha {value.rgba[3]}{depth}"
            )
    if entry.mark is not None or entry.reason:
        lines.append(
            ": ".join(part for part in ("rejected" if entry.is_rejected else "", entry.reason) if part)
        )
    return "\n".join(line for line in lines if line)
