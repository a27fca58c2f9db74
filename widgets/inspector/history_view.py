"""Everything that happened to one pixel: the verdict, then each event with before, out, after and reason."""

from PySide6.QtCore import QModelIndex, Qt, Signal, Slot
from PySide6.QtGui import QAction, QGuiApplication, QKeySequence, QShowEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QListView,
    QVBoxLayout,
    QWidget,
)

from widgets.basics.key_claim import KeyClaim
from widgets.basics.labels import set_role, text_label
from widgets.basics.marks import mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.history_row import EntryDelegate, ValueHeader
from widgets.inspector.pixel_story import (
    ENTRY_ROLE,
    HistoryEntry,
    PixelStory,
    PixelValue,
    StoryFilter,
    StoryModel,
    entry_text,
)

__all__ = ["HistoryEntry", "PixelHistory", "PixelStory", "PixelValue"]

HINT = "Point at a pixel, or click one, to see its history."
"""What an empty pane is for."""


class PixelHistory(QWidget):
    """Verdict, filter and rows; double click or Enter jumps to the row's step."""

    row_activated = Signal(int)
    """The user wants to go to an entry, by its number in the story (also when rejected ones are left out)."""
    rejected_toggled = Signal(bool)
    """The user shows (True) or leaves out (False) rejected fragments."""
    history_shown = Signal()
    """The pane has become visible, by its tab or with its page: it may be out of date."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._story: PixelStory | None = None
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._model = StoryModel(self)
        self._filter = StoryFilter(self)
        self._filter.setSourceModel(self._model)
        self._icon = QLabel(self)
        self.verdict = text_label("", self, role="strong", name="Verdict", wraps=True, is_selectable=True)
        self.place = text_label("", self, role="muted", wraps=True)
        self.rejected_box = QCheckBox("Show rejected", self)
        self.rejected_box.setChecked(True)
        self.rejected_box.setToolTip("Also show rejected fragments")
        self.rejected_box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.rejected_box.toggled.connect(self._filter.show_rejected)
        self.rejected_box.clicked.connect(self.rejected_toggled)
        self.view = QListView(self)
        self.view.setModel(self._filter)
        self.view.setItemDelegate(EntryDelegate(self.view))
        self.view.setAccessibleName("Pixel history")
        self.view.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.view.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.view.setResizeMode(QListView.ResizeMode.Adjust)
        self.view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        KeyClaim(self.view, (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home, Qt.Key.Key_End))
        self.view.activated.connect(self._activate)
        self.view.clicked.connect(self._activate)
        copy = QAction("Copy with full precision", self.view)
        copy.setShortcut(QKeySequence(QKeySequence.StandardKey.Copy))
        copy.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        copy.triggered.connect(self._copy)
        self.view.addAction(copy)
        self.view.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self._header = ValueHeader(self.view, self)
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignTop)
        top.addWidget(self.verdict, 1)
        second = QHBoxLayout()
        second.addWidget(self.place, 1)
        second.addWidget(self.rejected_box)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 4)
        layout.setSpacing(4)
        layout.addLayout(top)
        layout.addLayout(second)
        layout.addWidget(self._header)
        layout.addWidget(self.view, 1)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self.show_story(None)

    @Slot(object)
    def show_story(self, story: PixelStory | None, hint: str = HINT) -> None:
        """Show the history of a pixel, or the hint why the pane is empty."""
        self._story = story
        entries = story.entries if story else ()
        self._model.show_entries(entries)
        self.verdict.setText(story.verdict if story else hint)
        is_hint = story is None
        set_role(self.verdict, "muted" if is_hint else "strong")
        for part in (self.view, self._header):
            part.setVisible(bool(entries))
        rejected = sum(entry.is_rejected for entry in entries)
        self.rejected_box.setVisible(rejected > 0)
        self.rejected_box.setText(f"Show rejected ({rejected})")
        self.place.setVisible(not is_hint)
        if story:
            self.place.setText(f"Pixel column {story.column}, row {story.row}")
        self._follow_theme()

    def showEvent(self, event: QShowEvent) -> None:
        """Tell that the pane is in sight."""
        super().showEvent(event)
        self.history_shown.emit()

    @Slot(bool)
    def show_rejected(self, is_shown: bool) -> None:
        """Show or leave out rejected fragments."""
        self.rejected_box.setChecked(is_shown)

    @Slot(QModelIndex)
    def _activate(self, index: QModelIndex) -> None:
        self.row_activated.emit(self._filter.mapToSource(index).row())

    @Slot()
    def _copy(self) -> None:
        indexes = self.view.selectionModel().selectedIndexes()
        if indexes:
            QGuiApplication.clipboard().setText(
                "\n".join(entry_text(index.data(ENTRY_ROLE)) for index in indexes)
            )

    @Slot()
    def _follow_theme(self) -> None:
        mark = self._story.mark if self._story else None
        self._icon.setVisible(mark is not None)
        if mark is not None:
            side = current_theme().text_px + 3
            self._icon.setPixmap(mark_pixmap(mark, side, self.devicePixelRatioF()))
            self._icon.setToolTip(mark.value)
        self.view.viewport().update()
        self._header.update()
