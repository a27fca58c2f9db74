"""What to try next, the stages with how much of each is solved, and which mistakes were made how often."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QRect, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QIcon, QResizeEvent
from PySide6.QtWidgets import QAbstractItemView, QComboBox, QLineEdit, QTreeWidget, QTreeWidgetItem, QWidget

from widgets.basics.controls import FlowLayout, button_with_tip, column_layout, row_layout, text_label
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.records import ExerciseGroup, ExerciseStanding

# The catalogue: what to try next, the stages with how much of each is solved, and the exercises of the open
# one.


ROW_ROOM = 11
"""Pixels of a row above and below its text together."""
TITLE_MARGINS = 6
"""Pixels left and right of a title, and of its mark, together."""
_NAME = int(Qt.ItemDataRole.UserRole)
_MARKS = {
    ExerciseStanding.BEGUN: Mark.BOOKMARK,
    ExerciseStanding.MISSED: Mark.WRONG,
    ExerciseStanding.SOLVED: Mark.RIGHT,
}


class Catalogue(QWidget):
    """Stages that open one at a time."""

    exercise_chosen = Signal(str)
    """Name of an exercise."""
    next_requested = Signal()
    """What to try next is wanted."""
    progress_requested = Signal()
    picture_requested = Signal()
    """A picture of the open scene is to be compared."""
    line_entered = Signal(str)
    """A line that gives a question, as it is handed out."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._groups: tuple[ExerciseGroup, ...] = ()
        self._parents: list[QTreeWidgetItem] = []
        self._headings: list[QTreeWidgetItem] = []
        self._items: dict[str, QTreeWidgetItem] = {}
        self.setAccessibleName("Exercises by stage")
        self.next_button = button_with_tip("Try next", "Open the exercise that suits you now", self)
        self.next_button.clicked.connect(self.next_requested)
        self.progress_button = button_with_tip("Progress", "Points, mistakes, and who answers (Ctrl+I)", self)
        self.progress_button.clicked.connect(self.progress_requested)
        self.picture_button = button_with_tip(
            "Which mistake makes a picture?",
            "Compare a picture that your own program drew of the open scene: an image, npz or CSV",
            self,
        )
        self.picture_button.clicked.connect(self.picture_requested)
        self.next_label = text_label("", self, role="muted", wraps=True)
        self.tree = QTreeWidget(self, columnCount=2)
        self.tree.setAccessibleName("Exercises")
        self.tree.setHeaderHidden(True)
        self.tree.setExpandsOnDoubleClick(False)
        self.tree.setAnimated(False)
        self.tree.setRootIsDecorated(True)
        self.tree.setIndentation(12)
        self.tree.setWordWrap(True)
        self.tree.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.tree.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.tree.header().setStretchLastSection(False)
        self.tree.header().setSectionResizeMode(0, self.tree.header().ResizeMode.Stretch)
        self.tree.header().setSectionResizeMode(1, self.tree.header().ResizeMode.ResizeToContents)
        self.tree.itemClicked.connect(self._open)
        self.tree.itemActivated.connect(self._open)
        self.tree.itemExpanded.connect(self._fold_others)
        self.line = QLineEdit(self, placeholderText="triangle-coverage 2, seed 7")
        self.line.setAccessibleName("Line of a question")
        self.line.setToolTip("Type or paste a line that was handed out, then press Return")
        self.line.returnPressed.connect(self._enter)
        layout = column_layout(self, 8, margins=(0, 4, 8, 8))
        buttons = row_layout(spacing=8)
        buttons.addWidget(self.next_button, 1)
        buttons.addWidget(self.progress_button)
        layout.addLayout(buttons)
        layout.addWidget(self.next_label)
        layout.addWidget(self.tree, 1)
        layout.addWidget(text_label("Open a question by its line", self, role="muted"))
        layout.addWidget(self.line)
        layout.addWidget(self.picture_button)
        theme_notifier().theme_changed.connect(self._refresh)

    def show_exercises(self, groups: Sequence[ExerciseGroup], current: str, to_try: str) -> None:
        """Show all exercises, the one that is asked, and the title of what to try next."""
        groups = tuple(groups)
        self.next_label.setText(to_try)
        self.next_label.setVisible(bool(to_try))
        if [_names(group) for group in groups] != [_names(group) for group in self._groups]:
            self._groups = groups
            self._make()
        self._groups = groups
        self._refresh()
        item = self._items.get(current)
        if item is not None:
            self.tree.blockSignals(True)
            for group in self._parents:
                group.setExpanded(group is item.parent())
            self.tree.setCurrentItem(item)
            self.tree.blockSignals(False)

    def _make(self) -> None:
        self.tree.clear()
        self._items, self._parents, self._headings = {}, [], []
        for group in self._groups:
            parent = QTreeWidgetItem(self.tree)
            self._parents.append(parent)
            subject = ""
            for entry in group.entries:
                if entry.subject != subject:
                    subject = entry.subject
                    self._add_heading(parent, subject)
                item = QTreeWidgetItem(parent)
                item.setData(0, _NAME, entry.name)
                item.setFirstColumnSpanned(True)
                self._items[entry.name] = item

    def _add_heading(self, parent: QTreeWidgetItem, subject: str) -> None:
        """Divide the exercises of a stage: neither keys nor clicks stop at the heading."""
        heading = QTreeWidgetItem(parent, [subject])
        heading.setFlags(Qt.ItemFlag.NoItemFlags)
        heading.setFirstColumnSpanned(True)
        font = heading.font(0)
        font.setBold(True)
        heading.setFont(0, font)
        self._headings.append(heading)

    @Slot()
    def _refresh(self) -> None:
        side = current_theme().text_px
        self.tree.setIconSize(QSize(side, side))
        for heading in self._headings:
            # Nothing can be done with them, but they are to be read.
            heading.setForeground(0, QColor(current_theme().text))
        for parent, group in zip(self._parents, self._groups, strict=True):
            parent.setText(0, group.title)
            parent.setText(1, f"{group.solved} of {len(group.entries)}")
            parent.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            parent.setSizeHint(0, QSize(0, side + ROW_ROOM))
            said = f"{group.title}: {group.solved} of {len(group.entries)} solved"
            parent.setData(0, Qt.ItemDataRole.AccessibleTextRole, said)
            parent.setToolTip(0, said)
            for entry in group.entries:
                item = self._items[entry.name]
                mark = _MARKS.get(entry.standing)
                item.setIcon(0, QIcon(mark_pixmap(mark, side, self.devicePixelRatioF())) if mark else QIcon())
                item.setText(0, entry.title)
                item.setToolTip(0, f"{entry.title}: {entry.points}, {entry.standing.value}")
                item.setData(0, Qt.ItemDataRole.AccessibleTextRole, f"{entry.title}, {entry.standing.value}")
        self._set_heights()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Give a title as many lines as it takes in this width."""
        super().resizeEvent(event)
        self._set_heights()

    def _set_heights(self) -> None:
        tree, side = self.tree, current_theme().text_px
        width = tree.viewport().width() - 2 * tree.indentation() - TITLE_MARGINS
        line = tree.fontMetrics().lineSpacing()
        for item in self._items.values():
            mark = 0 if item.icon(0).isNull() else side + TITLE_MARGINS
            room = QRect(0, 0, max(width - mark, side), 0)
            text = tree.fontMetrics().boundingRect(room, Qt.TextFlag.TextWordWrap, item.text(0))
            more = text.height() - line
            item.setSizeHint(0, QSize(0, more + side + ROW_ROOM) if more > 0 else QSize())

    @Slot(QTreeWidgetItem)
    def _open(self, item: QTreeWidgetItem) -> None:
        name = item.data(0, _NAME)
        if name is None and item.parent() is None:
            item.setExpanded(not item.isExpanded())
        elif name is not None:
            self.exercise_chosen.emit(name)

    @Slot(QTreeWidgetItem)
    def _fold_others(self, opened: QTreeWidgetItem) -> None:
        for item in self._parents:
            if item is not opened:
                item.setExpanded(False)

    @Slot()
    def _enter(self) -> None:
        self.line_entered.emit(self.line.text())


def _names(group: ExerciseGroup) -> tuple[str, ...]:
    return (group.name, *(entry.name for entry in group.entries))


# What a learner has reached: points by stage, and how often each mistake was made of the times it could
# show.


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
        self.users = QComboBox(
            self, editable=True, insertPolicy=QComboBox.InsertPolicy.NoInsert, minimumContentsLength=12
        )
        self.users.setAccessibleName("Learner")
        self.users.setToolTip("Whose answers these are; type a name and press Return for somebody new")
        self.users.activated.connect(self._choose_user)
        edit = self.users.lineEdit()
        assert edit is not None
        edit.returnPressed.connect(self._choose_user)
        self.tree = QTreeWidget(self, columnCount=2)
        self.tree.setAccessibleName("Points and mistakes by stage")
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
