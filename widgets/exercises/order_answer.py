"""Things put in order: dragged, or moved by buttons and keys."""

from typing import Any

from PySide6.QtCore import QSize, Qt, Slot
from PySide6.QtGui import QIcon, QKeyEvent
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QSizePolicy, QWidget

from widgets.basics.accessible import announce
from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.labels import text_label
from widgets.basics.marks import Mark, mark_pixmap
from widgets.basics.theme import current_theme
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.records import AnswerMarks, ItemMarks, OrderForm

HOW = "First to last, from the top. Drag an item, or choose it and move it with Alt+Up and Alt+Down."


class OrderAnswerView(AnswerView):
    """A list whose items change places."""

    def __init__(self, form: OrderForm, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._form = form
        self.list = _MovingList(self)
        self.list.setAccessibleName("Your order, first to last")
        self.list.model().rowsMoved.connect(self._moved)
        self.earlier_button = button_with_tip("Earlier", "Move the chosen item up (Alt+Up)", self)
        self.later_button = button_with_tip("Later", "Move the chosen item down (Alt+Down)", self)
        self.earlier_button.clicked.connect(self.list.move_up)
        self.later_button.clicked.connect(self.list.move_down)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(HOW, self, role="muted", wraps=True))
        layout.addWidget(self.list)
        buttons = row_layout(spacing=8)
        for button in (self.earlier_button, self.later_button):
            buttons.addWidget(button)
        buttons.addStretch(1)
        layout.addLayout(buttons)
        self.show_given(None)

    def given(self) -> list[str]:
        """Return the items in order."""
        return [self.list.item(row).text() for row in range(self.list.count())]

    def show_given(self, given: Any) -> None:
        """List the items in an order."""
        self.list.clear()
        for item in given or self._form.items:
            self.list.addItem(QListWidgetItem(item))
        self.list.setCurrentRow(0)
        self.list.updateGeometry()

    def show_marks(self, marks: AnswerMarks | None) -> None:
        """Mark the items that are in the longest right run."""
        assert marks is None or isinstance(marks, ItemMarks)
        side = current_theme().text_px
        self.list.setIconSize(QSize(side, side))
        for row in range(self.list.count()):
            item = self.list.item(row)
            if marks is None:
                item.setIcon(QIcon())
                item.setToolTip("")
            else:
                mark = Mark.RIGHT if row in marks.right else Mark.WRONG
                item.setIcon(QIcon(mark_pixmap(mark, side, self.devicePixelRatioF())))
                item.setToolTip("in the longest right run" if row in marks.right else "not in it")

    def set_open(self, is_open: bool) -> None:
        """Let items move, or only show them."""
        self.list.setDragEnabled(is_open)
        self.list.is_open = is_open
        self.earlier_button.setEnabled(is_open)
        self.later_button.setEnabled(is_open)

    @Slot()
    def _moved(self) -> None:
        self.answer_changed.emit()


class _MovingList(QListWidget):
    """A list as high as its items, which can be dragged and moved by keys."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.is_open = True
        self.setDragDropMode(QListWidget.DragDropMode.InternalMove)
        self.setDefaultDropAction(Qt.DropAction.MoveAction)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Return the height of all items."""
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        return QSize(super().sizeHint().width(), rows + 2 * self.frameWidth() + 4)

    @Slot()
    def move_up(self) -> None:
        """Move the chosen item up."""
        self._move(-1)

    @Slot()
    def move_down(self) -> None:
        """Move the chosen item down."""
        self._move(1)

    def _move(self, direction: int) -> None:
        row = self.currentRow()
        there = row + direction
        if not self.is_open or row < 0 or not 0 <= there < self.count():
            return
        model, root = self.model(), self.rootIndex()
        model.moveRow(root, row, root, there + (direction > 0))
        self.setCurrentRow(there)
        announce(self, f"{self.item(there).text()}: place {there + 1} of {self.count()}")

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the chosen item with Alt and an arrow."""
        moves = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
        key = Qt.Key(event.key())
        if event.modifiers() == Qt.KeyboardModifier.AltModifier and key in moves:
            self._move(moves[key])
        else:
            super().keyPressEvent(event)
