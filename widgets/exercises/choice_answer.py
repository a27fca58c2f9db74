"""One of several options, or several of them."""

from typing import Any

from PySide6.QtCore import Qt, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QAbstractButton, QButtonGroup, QCheckBox, QLabel, QRadioButton, QWidget

from core.records.cells import Form, Marks
from widgets.basics.controls import column_layout, row_layout, wrap_text
from widgets.basics.labels import text_label
from widgets.basics.theme import current_theme
from widgets.exercises.answer_view import AnswerView, show_mark
from widgets.exercises.mark_grid import MarkGrid


class ChoiceAnswerView(AnswerView):
    """A button for every option."""

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        make = QCheckBox if form.is_several else QRadioButton
        self.buttons: list[QAbstractButton] = [make(option, self) for option in form.items]
        self._marks = [QLabel(self) for _ in form.items]
        # Qt lets Tab stop at one button of a group only, whether it is exclusive or not.
        self._group = None if form.is_several else QButtonGroup(self)
        layout = column_layout(self, 4)
        how = "Choose all that are right." if form.is_several else "Choose one."
        layout.addWidget(text_label(how, self, role="muted"))
        for button, mark in zip(self.buttons, self._marks, strict=True):
            if self._group is not None:
                self._group.addButton(button)
            button.clicked.connect(self._chosen)
            row = row_layout(spacing=8)
            row.addWidget(button)
            row.addWidget(mark)
            row.addStretch(1)
            layout.addLayout(row)

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
