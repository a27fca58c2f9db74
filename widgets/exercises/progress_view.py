"""What a learner has reached: points by stage, and how often each mistake was made of the times it could show."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize, Qt, Signal, Slot
from PySide6.QtWidgets import QComboBox, QTreeWidget, QTreeWidgetItem, QWidget

from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import text_label
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.catalogue import ROW_ROOM

EMPTY = "Nothing has been checked yet. Points and mistakes appear here."
HOW = "Behind each mistake: how often it was made, of the answers in which it could show."


@dataclass(frozen=True)
class MistakeRecord:
    """One mistake."""

    title: str
    sentence: str
    counts: str
    """As ``3 of 9``."""


@dataclass(frozen=True)
class StageProgress:
    """What was reached in one stage."""

    title: str
    points: str
    mistakes: tuple[MistakeRecord, ...]


class ProgressView(QWidget):
    """Stages with their mistakes, and whose progress it is."""

    closed = Signal()
    user_chosen = Signal(str)
    export_requested = Signal()
    import_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._items: list[QTreeWidgetItem] = []
        self.setAccessibleName("Progress")
        self.points = text_label("", self, role="strong")
        self.users = QComboBox(self)
        self.users.setEditable(True)
        self.users.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.users.setMinimumContentsLength(12)
        self.users.setAccessibleName("Learner")
        self.users.setToolTip("Whose answers these are; type a name and press Return for somebody new")
        self.users.activated.connect(self._choose_user)
        edit = self.users.lineEdit()
        assert edit is not None
        edit.returnPressed.connect(self._choose_user)
        self.tree = QTreeWidget(self)
        self.tree.setAccessibleName("Points and mistakes by stage")
        self.tree.setColumnCount(2)
        self.tree.setHeaderHidden(True)
        self.tree.header().setStretchLastSection(False)
        self.tree.header().setSectionResizeMode(0, self.tree.header().ResizeMode.Stretch)
        self.tree.header().setSectionResizeMode(1, self.tree.header().ResizeMode.ResizeToContents)
        self.note = text_label("", self, role="muted", wraps=True)
        self.close_button = button_with_tip("Back to the question", "Close the progress (Escape)", self)
        self.close_button.clicked.connect(self.closed)
        self.export_button = button_with_tip(
            "Export answers…", "Write all answers of this learner to a file, or to a table", self
        )
        self.export_button.clicked.connect(self.export_requested)
        self.import_button = button_with_tip("Import answers…", "Add the answers of an exported file", self)
        self.import_button.clicked.connect(self.import_requested)
        head = row_layout(spacing=8)
        head.addWidget(text_label("Progress of", self, role="title"))
        head.addWidget(self.users)
        head.addStretch(1)
        head.addWidget(self.points)
        buttons = FlowLayout(spacing=8)
        for button in (self.close_button, self.export_button, self.import_button):
            buttons.addWidget(button)
        layout = column_layout(self, 8, margins=(4, 4, 4, 4))
        layout.addLayout(head)
        layout.addWidget(self.note)
        layout.addWidget(self.tree, 1)
        layout.addLayout(buttons)
        theme_notifier().theme_changed.connect(self._set_heights)

    def show_users(self, users: Sequence[str], current: str) -> None:
        """Offer the learners that have answered, with the present one chosen."""
        self.users.clear()
        self.users.addItems(list(dict.fromkeys((current, *users))))
        self.users.setCurrentIndex(0)

    def show_progress(self, points: str, stages: Sequence[StageProgress]) -> None:
        """Show points and mistakes."""
        self.points.setText(points)
        self.note.setText(HOW if stages else EMPTY)
        self.tree.clear()
        self._items = []
        for stage in stages:
            parent = QTreeWidgetItem(self.tree, [stage.title, stage.points])
            self._items.append(parent)
            for mistake in stage.mistakes:
                item = QTreeWidgetItem(parent, [mistake.title, mistake.counts])
                item.setToolTip(0, mistake.sentence)
                self._items.append(item)
            parent.setExpanded(True)
        self._set_heights()

    @Slot()
    def _set_heights(self) -> None:
        size = QSize(0, current_theme().text_px + ROW_ROOM)
        for item in self._items:
            item.setSizeHint(0, size)
            item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)

    @Slot()
    def _choose_user(self) -> None:
        self.user_chosen.emit(self.users.currentText().strip())
