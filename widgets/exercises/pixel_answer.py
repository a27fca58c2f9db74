"""Pixels marked on the picture; the same as a list of rows, with the same marks."""

import re
from collections.abc import Collection
from typing import Any

from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from core.records.cells import Form, Marks
from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.labels import text_label
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.entry_grid import EntryGrid
from widgets.exercises.mark_grid import NOTHING, MarkGrid
from widgets.exercises.records import Pixel

HOW = (
    "Click or drag on the picture. By keyboard: the arrows go to a pixel, Space marks it, and Shift with an arrow "
    "gives the next pixel the same mark."
)

LEGEND = "Tick: right. Square: missing. Cross: extra."
DOUBLE = " Two bars: double, another triangle or line has the pixel."

_RUN = re.compile(r"\s*(\d{1,3})(?:\s*[-–]\s*(\d{1,3}))?\s*", re.ASCII)


class PixelAnswerView(AnswerView):
    """How many are marked, and the rows as text on request."""

    uses_grid = True

    def __init__(self, form: Form, grid: MarkGrid, parent: QWidget | None = None) -> None:
        super().__init__(form, grid, parent)
        self._marks: Marks | None = None
        self._is_open = True
        self._unread: dict[int, str] = {}
        """Why the text of a row means nothing, by the field's number."""
        self.how = text_label(HOW, self, role="muted", wraps=True)
        self.count = text_label("", self)
        self.clear_button = button_with_tip("Clear", f"Mark no {form.noun}", self)
        self.clear_button.clicked.connect(self._clear)
        self.rows_button = button_with_tip("Rows", "Show and type the marks row by row (Ctrl+L)", self)
        self.rows_button.setCheckable(True)
        self.rows_button.toggled.connect(self._show_rows)
        labels = tuple(str(row) for row in reversed(range(form.size[1])))
        self.rows = EntryGrid(("marked columns, as 3-7, 9", "found"), labels, self, read_only=(1,))
        self.rows.setAccessibleName(f"Marked {form.noun}, row by row")
        self.rows.hide()
        self.rows.field_edited.connect(self._type)
        layout = column_layout(self, 8)
        layout.addWidget(self.how)
        row = row_layout(spacing=8)
        for widget in (self.count, self.clear_button, self.rows_button):
            row.addWidget(widget)
        row.insertStretch(1)
        layout.addLayout(row)
        layout.addWidget(self.rows)
        grid.pixels_painted.connect(self._painted)
        grid.set_paintable(True)
        self._show()

    def given(self) -> list[list[int]]:
        """Return the marked pixels as [column, row]."""
        return [list(pixel) for pixel in sorted(self._grid.marked())]

    def unread(self) -> str:
        """Say which row means nothing."""
        return next(iter(self._unread.values()), "")

    def show_given(self, given: Any) -> None:
        """Mark pixels."""
        self._unread.clear()
        self._grid.show_marked(frozenset((column, row) for column, row in given or ()))
        self._show()

    def show_marks(self, marks: Marks | None) -> None:
        """Mark what is right on the picture and in the rows."""
        self._marks = marks
        self._grid.show_marks(marks)
        double = DOUBLE if marks is not None and marks.get("double") else ""
        self.how.setText(HOW if marks is None else LEGEND + double)
        self._show()

    def set_open(self, is_open: bool) -> None:
        """Take marks, or only show them."""
        self._is_open = is_open
        self._grid.set_paintable(is_open)
        self.clear_button.setEnabled(is_open)
        self._show()
        self.rows.set_open(is_open)

    def release(self) -> None:
        """Leave the picture to the next form."""
        self._grid.pixels_painted.disconnect(self._painted)
        self._grid.set_paintable(False)

    def toggle_rows(self) -> None:
        """Show the rows, or fold them away."""
        self.rows_button.toggle()

    @Slot(object, bool)
    def _painted(self) -> None:
        self._forget_unread()
        self._show()
        self.answer_changed.emit()

    @Slot()
    def _clear(self) -> None:
        if self._grid.marked():
            self._grid.show_marked(NOTHING)
            self._painted()

    @Slot(bool)
    def _show_rows(self, is_shown: bool) -> None:
        self._forget_unread()
        self.rows.setVisible(is_shown)
        self._show()

    @Slot(int, int)
    def _type(self, number: int, column: int) -> None:
        """Mark the columns that are typed for a row."""
        row = self._form.size[1] - 1 - number
        try:
            columns = read_columns(self._form.size[0], self.rows.text(number, column))
        except ValueError as problem:
            self._unread[number] = f"row {row}: {problem}"
            self._tell_unread()
            return
        self._unread.pop(number, None)
        self._tell_unread()
        others = frozenset(pixel for pixel in self._grid.marked() if pixel[1] != row)
        self._grid.show_marked(others | frozenset((place, row) for place in columns))
        self._show(typed=number)
        self.answer_changed.emit()

    def _forget_unread(self) -> None:
        """Let the rows show what is marked, whatever was typed there."""
        if self._unread:
            self._unread.clear()
            self._tell_unread()

    def _tell_unread(self) -> None:
        unread = self.unread()
        self.note_changed.emit(f"{unread[:1].upper()}{unread[1:]}." if unread else "")

    def _show(self, typed: int = -1) -> None:
        """Show the count and the rows; the one that is being ``typed`` and those that mean nothing are left alone."""
        marked, noun = self._grid.marked(), self._form.noun
        said = f"{len(marked)} {noun[:-1] if len(marked) == 1 else noun}"
        self.count.setText(f"{said} marked" if self._is_open else said)
        if self.rows.isHidden():
            return
        for number in range(self._form.size[1]):
            row = self._form.size[1] - 1 - number
            if number != typed and number not in self._unread:
                self.rows.show_text(number, 0, columns_text(marked, row))
            self.rows.show_text(number, 1, "" if self._marks is None else found_text(self._marks, row))


def read_columns(columns: int, text: str) -> frozenset[int]:
    """Return the columns of a text such as ``3-7, 9``; ValueError where it means nothing."""
    found: set[int] = set()
    for part in text.split(",") if text.strip() else ():
        run = _RUN.fullmatch(part)
        if run is None:
            raise ValueError(f"expected columns such as 3-7, 9; got {part.strip()[:20]!a}")
        first, last = int(run[1]), int(run[2] or run[1])
        if first > last:
            raise ValueError(f"expected the smaller column first, got {part.strip()}")
        if last >= columns:
            raise ValueError(f"expected columns from 0 to {columns - 1}, got {part.strip()}")
        found.update(range(first, last + 1))
    return frozenset(found)


def columns_text(pixels: Collection[Pixel], row: int) -> str:
    """Return the columns of the pixels in a row, as ``3-7, 9``."""
    columns = sorted(column for column, its in pixels if its == row)
    runs: list[list[int]] = []
    for column in columns:
        if runs and column == runs[-1][1] + 1:
            runs[-1][1] = column
        else:
            runs.append([column, column])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def found_text(marks: Marks, row: int) -> str:
    """Return what a check found in a row, as ``right 3-7; missing 8``."""
    found = (
        (name, columns_text(marks.get(name, ()), row)) for name in ("right", "missing", "extra", "double")
    )
    return "; ".join(f"{name} {columns}" for name, columns in found if columns)
