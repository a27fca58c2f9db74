"""Answers that are chosen: options, an order, a line of a listing, one method of each family."""

from typing import Any

from PySide6.QtCore import QEvent, QObject, Qt, Slot
from PySide6.QtGui import QFontDatabase, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractButton,
    QButtonGroup,
    QCheckBox,
    QComboBox,
    QGridLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QRadioButton,
    QWidget,
)

from core.records.cells import Form, Marks
from widgets.basics.accessibility import announce, give_focus
from widgets.basics.choice_box import ChoiceBox
from widgets.basics.controls import button_with_tip, column_layout, row_layout, text_label, wrap_text
from widgets.basics.drawing import Mark
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.mark_grid import AnswerView, MarkGrid
from widgets.exercises.marked_items import ItemList, show_mark

# One of several options, or several of them.


class ChoiceAnswerView(AnswerView):
    """A button for every option."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        make = QCheckBox if form.is_several else QRadioButton
        self.buttons: list[QAbstractButton] = [make(option, self) for option in form.items]
        self._marks = [QLabel(self) for _ in form.items]
        self._has_numbers = len(form.items) < 10 and not any(option[:1].isdigit() for option in form.items)
        """Whether a digit chooses an option: not where it might be read as what an option says."""
        # Qt lets Tab stop at one button of a group only, whether it is exclusive or not.
        self._group = None if form.is_several else QButtonGroup(self)
        layout = column_layout(self, 4)
        how = "Choose all that are right" if form.is_several else "Choose one"
        self._keys = f"keys 1 {'and' if len(form.items) == 2 else 'to'} {len(form.items)}"
        how += f" ({self._keys})." if self._has_numbers else "."
        layout.addWidget(text_label(how, self, role="muted"))
        for button, mark in zip(self.buttons, self._marks, strict=True):
            if self._group is not None:
                self._group.addButton(button)
            button.clicked.connect(self._chosen)
            button.installEventFilter(self)
            row = row_layout(spacing=8)
            row.addWidget(button)
            row.addWidget(mark)
            row.addStretch(1)
            layout.addLayout(row)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Choose an option by its number: in the window a digit goes to a stage, which would give the answer away."""
        if not isinstance(event, QKeyEvent) or not Qt.Key.Key_0 <= event.key() <= Qt.Key.Key_9:
            return False
        if event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
            return False
        if event.type() == QEvent.Type.ShortcutOverride:
            event.accept()
        number = event.key() - Qt.Key.Key_0
        if event.type() == QEvent.Type.KeyPress:
            if self._has_numbers and 0 < number <= len(self.buttons):
                give_focus(self.buttons[number - 1])
                self.buttons[number - 1].click()
            else:
                others = f"The {self._keys} choose." if self._has_numbers else "Use the arrows or the mouse."
                self.note_changed.emit(f"{event.text()} chooses nothing here. {others}")
        return True

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Write long options in several lines."""
        super().resizeEvent(event)
        room = current_theme().text_px + 8  # of a mark
        for option, button in zip(self._form.items, self.buttons, strict=True):
            wrap_text(button, option, self.width() - room)

    def given(self) -> list[str]:
        """Return the options chosen."""
        options = zip(self._form.items, self.buttons, strict=True)
        return [option for option, button in options if button.isChecked()]

    def show_given(self, given: Any) -> None:
        """Choose options."""
        if self._group is not None:
            self._group.setExclusive(False)  # Else the last chosen one stays.
        for option, button in zip(self._form.items, self.buttons, strict=True):
            button.setChecked(option in (given or ()))
        if self._group is not None:
            self._group.setExclusive(True)

    def set_open(self, is_open: bool) -> None:
        """Take an answer, or only show it: the option that was chosen stays as clear as it was."""
        for button in self.buttons:
            is_clear = button.isChecked() and self._group is not None
            button.setEnabled(is_open or is_clear)
            button.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents, not is_open)
            button.setFocusPolicy(Qt.FocusPolicy.StrongFocus if is_open else Qt.FocusPolicy.NoFocus)

    def show_marks(self, marks: Marks | None) -> None:
        """Mark the options that are chosen rightly or wrongly, and those that are missing."""
        for place, (label, button) in enumerate(zip(self._marks, self.buttons, strict=True)):
            words = {"right": "right", "wrong": "wrong", "missing": "missing: it is right"}
            kinds = [name for name in words if marks is not None and place in marks.get(name, ())]
            show_mark(label, {"right": True, "wrong": False}.get(kinds[0]) if kinds else None)
            if kinds == ["missing"]:
                label.setText(words["missing"])
            button.setAccessibleDescription(words[kinds[0]] if kinds else "")

    @Slot()
    def _chosen(self) -> None:
        self.answer_changed.emit()


# Answers in lists: things put in order, dragged or moved by buttons and keys, and the line of a listing.


MOVE = "First to last, from the top. Drag an item, or choose it and move it with Alt+Up and Alt+Down."

POINT = "Choose the line: click it, or go to it with the arrows."


class OrderAnswerView(AnswerView):
    """A list whose items change places."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.list = _MovingList(self)
        self.list.setAccessibleName("Your order, first to last")
        self.list.model().rowsMoved.connect(self._moved)
        self.earlier_button = button_with_tip("Earlier", "Move the chosen item up (Alt+Up)", self)
        self.later_button = button_with_tip("Later", "Move the chosen item down (Alt+Down)", self)
        self.earlier_button.clicked.connect(self.list.move_up)
        self.later_button.clicked.connect(self.list.move_down)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(MOVE, self, role="muted", wraps=True))
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

    def show_marks(self, marks: Marks | None) -> None:
        """Mark the items that are in the longest right run."""
        for row in range(self.list.count()):
            if marks is None:
                self.list.show_mark(row, None)
            elif row in marks["right"]:
                self.list.show_mark(row, Mark.RIGHT, "in the longest right run")
            else:
                self.list.show_mark(row, Mark.WRONG, "not in it")

    def set_open(self, is_open: bool) -> None:
        """Let items move, or only show them."""
        self.list.setDragEnabled(is_open)
        self.list.is_open = is_open
        self.earlier_button.setEnabled(is_open)
        self.later_button.setEnabled(is_open)

    @Slot()
    def _moved(self) -> None:
        self.answer_changed.emit()


class _MovingList(ItemList):
    """A list as high as its items, which can be dragged and moved by keys."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.is_open = True
        self.setDragDropMode(QListWidget.DragDropMode.InternalMove)
        self.setDefaultDropAction(Qt.DropAction.MoveAction)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.fit_height(4)

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

    def event(self, event: QEvent) -> bool:
        """Move the chosen item with Alt and an arrow: in the window these keys move the pin."""
        moves = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}
        if isinstance(event, QKeyEvent) and event.key() in moves:
            is_alt = (
                event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier == Qt.KeyboardModifier.AltModifier
            )
            if is_alt and event.type() in (QEvent.Type.ShortcutOverride, QEvent.Type.KeyPress):
                if event.type() == QEvent.Type.KeyPress:
                    self._move(moves[Qt.Key(event.key())])
                event.accept()
                return True
        return super().event(event)


class ListingAnswerView(AnswerView):
    """Numbered lines, of which one is chosen."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.list = _Lines(self)
        self.list.setAccessibleName("Lines of the listing")
        for number, line in enumerate(form.items, 1):
            self.list.addItem(f"{number:>2}  {line}")
            self.list.item(number - 1).setData(
                Qt.ItemDataRole.AccessibleTextRole, f"line {number}: {line.strip()}"
            )
        # Not the current line: Qt makes the first one that as soon as the list has the keyboard.
        self.list.itemSelectionChanged.connect(self._chosen)
        layout = column_layout(self, 8)
        layout.addWidget(text_label(POINT, self, role="muted", wraps=True))
        layout.addWidget(self.list)

    def given(self) -> str:
        """Return the number of the line, from 1; empty: none is chosen."""
        rows = [self.list.row(item) for item in self.list.selectedItems()]
        return str(rows[0] + 1) if rows else ""

    def show_given(self, given: Any) -> None:
        """Choose a line."""
        self.list.blockSignals(True)
        self.list.clearSelection()
        if given:
            self.list.setCurrentRow(int(given) - 1)
        self.list.blockSignals(False)

    def show_marks(self, marks: Marks | None) -> None:
        """Mark the chosen line."""
        found = {name: (marks or {}).get(name, ()) for name in ("right", "wrong")}
        for row in range(self.list.count()):
            if row in found["right"]:
                self.list.show_mark(row, Mark.RIGHT, "the wrong line")
            else:
                self.list.show_mark(row, Mark.WRONG if row in found["wrong"] else None, "as it should be")

    @Slot()
    def _chosen(self) -> None:
        self.answer_changed.emit()


class _Lines(ItemList):
    """Lines in the type of listings, with the bar below long ones."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.fit_height(16)
        self.setTextElideMode(Qt.TextElideMode.ElideNone)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    @Slot()
    def _follow_theme(self) -> None:
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPixelSize(current_theme().code_px)
        self.setFont(font)


# No more than needed: one method of each family, with what they cost together.


class MethodAnswerView(AnswerView):
    """A list of methods for every family."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self.boxes: list[QComboBox] = []
        self.cost = text_label("", self, role="muted", wraps=True)
        rows = QGridLayout()
        rows.setHorizontalSpacing(8)
        for row, ((family,), names) in enumerate(zip(form.cells, form.names, strict=True)):
            box = ChoiceBox(self)
            box.setAccessibleName(family.label)
            # The longest method must not make the question wider than its column.
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
            box.setMinimumContentsLength(10)
            box.addItem("choose", "")
            for name, text in zip(names, family.options, strict=True):
                box.addItem(text, name)
            box.activated.connect(self._chosen)
            rows.addWidget(text_label(family.label, self), row, 0)
            rows.addWidget(box, row, 1)
            self.boxes.append(box)
        rows.setColumnStretch(1, 1)
        layout = column_layout(self, 8)
        layout.addLayout(rows)
        layout.addWidget(self.cost)
        self._show_cost()

    def given(self) -> dict[str, str]:
        """Return the methods by family; empty: none is chosen yet."""
        return {family: box.currentData() for family, box in zip(self._form.labels, self.boxes, strict=True)}

    def show_given(self, given: Any) -> None:
        """Choose methods."""
        for family, box in zip(self._form.labels, self.boxes, strict=True):
            box.setCurrentIndex(max(box.findData((given or {}).get(family, "")), 0))
        self._show_cost()

    def _show_cost(self) -> None:
        for box in self.boxes:
            box.setToolTip(box.currentText())  # The box may be too narrow for it.
        assert self._form.told is not None
        self.cost.setText(self._form.told(self.given()) if all(self.given().values()) else "")

    @Slot()
    def _chosen(self) -> None:
        self._show_cost()
        self.answer_changed.emit()
