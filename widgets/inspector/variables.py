"""The variables of a step: value now, value before, and which of them the step has changed."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QAction,
    QColor,
    QFont,
    QFontMetrics,
    QGuiApplication,
    QKeySequence,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from core.explain.number_text import DIGITS, exact_text, fraction_text, full_text
from core.explain.records import Value, Variable
from widgets.basics.controls import LEAST_TARGET
from widgets.basics.key_claim import KeyClaim
from widgets.basics.theme import current_theme, theme_notifier
from widgets.basics.typed_value import tabular_font

EVERY_DEFAULT: Mapping[float, int] = MappingProxyType({})
"""No number has other digits than usual."""
_COMPONENTS = ("x", "y", "z", "w")
_CHANGED = Qt.ItemDataRole.UserRole + 1


def value_text(
    value: Value,
    *,
    is_full: bool = False,
    is_fraction: bool = False,
    digits: Mapping[float, int] = EVERY_DEFAULT,
) -> str:
    """Return a value as text: as formulas write it, in full, or in exact 1/256ths.

    A vector's numbers stand side by side. ``digits`` are the significant digits of numbers by their size, where the
    formula of the step needs more than four.
    """
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if isinstance(value, tuple):
        parts = (value_text(part, is_full=is_full, is_fraction=is_fraction, digits=digits) for part in value)
        return f"({', '.join(parts)})"
    if is_full:
        return full_text(value)
    return fraction_text(value) if is_fraction else exact_text(value, digits.get(abs(value), DIGITS))


class _ChangeDelegate(QStyledItemDelegate):
    """Draws a bar before each value that the step has changed."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(
            super().sizeHint(option, index).width(), max(option.fontMetrics.height() + 6, LEAST_TARGET)
        )

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        super().paint(painter, option, index)
        if index.column() == 1 and index.data(_CHANGED):
            bar = option.rect.adjusted(1, 3, 0, -3)
            bar.setWidth(4)
            painter.fillRect(bar, QColor(current_theme().accent))


class VariablesView(QTreeWidget):
    """A table of name, now and before; vectors open into their components."""

    origin_requested = Signal(object)
    """The user asks where the value of this `Variable` comes from."""
    meaning_requested = Signal(str, str)
    """The user asks what a variable is: its name, and its meaning in a sentence."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._variables: tuple[Variable, ...] = ()
        self._is_fraction = False
        self.setColumnCount(3)
        self.setHeaderLabels(["Name", "Now", "Before"])
        self.setAlternatingRowColors(True)
        self.setRootIsDecorated(True)
        self.setIndentation(14)
        self.setUniformRowHeights(True)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setTextElideMode(Qt.TextElideMode.ElideRight)
        self.setItemDelegate(_ChangeDelegate(self))
        self.setAccessibleName("Variables")
        KeyClaim(self, (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Left, Qt.Key.Key_Right))
        header = self.header()
        header.setSectionsMovable(False)
        header.setStretchLastSection(False)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.Fixed)
        header.setSectionResizeMode(1, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        for column in (1, 2):
            self.headerItem().setTextAlignment(column, _RIGHT)
        copy = QAction("Copy with full precision", self)
        copy.setShortcut(QKeySequence(QKeySequence.StandardKey.Copy))
        copy.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        copy.triggered.connect(self.copy_values)
        self._fraction_action = QAction("Exact 1/256ths", self)
        self._fraction_action.setCheckable(True)
        self._fraction_action.toggled.connect(self.show_fractions)
        origin = QAction("Go to the step that made it", self)
        origin.setShortcut(QKeySequence(Qt.Key.Key_Return))
        origin.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        origin.triggered.connect(self._ask_for_current)
        meaning = QAction("What is this?", self)
        meaning.triggered.connect(self._ask_for_meaning)
        self.itemClicked.connect(self._click)
        self.itemExpanded.connect(self._fill)
        self.addActions([meaning, origin, copy, self._fraction_action])
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    @Slot(object)
    def show_variables(self, variables: Sequence[Variable]) -> None:
        """Show the variables of a step; open vectors and the selection stay while the names stay."""
        variables = tuple(variables)
        is_same_rows = [_shape(v) for v in variables] == [_shape(v) for v in self._variables]
        self._variables = variables
        if not is_same_rows:
            self.clear()
            self.addTopLevelItems([_new_item(variable) for variable in variables])
            self._fit_names()
        self._fill()

    @Slot(bool)
    def show_fractions(self, is_fraction: bool) -> None:
        """Write numbers as exact multiples of 1/256 where they are."""
        if is_fraction != self._is_fraction:
            self._is_fraction = is_fraction
            self._fraction_action.setChecked(is_fraction)
            self._fill()

    @Slot()
    def copy_values(self) -> None:
        """Put the selected variables on the clipboard, one a line, with full precision."""
        lines = []
        for item in self.selectedItems():
            name, value = item.text(0), item.data(1, Qt.ItemDataRole.UserRole)
            owner = item.parent()
            if owner is not None and not owner.isExpanded():
                continue
            lines.append(f"{f'{owner.text(0)}.{name}' if owner else name} = {value}")
        if lines:
            QGuiApplication.clipboard().setText("\n".join(lines))

    @Slot()
    def _ask_for_current(self) -> None:
        self._ask_for(self.currentItem())

    @Slot()
    def _ask_for_meaning(self) -> None:
        item = self.currentItem()
        if item is not None:
            variable = self._variables[self.indexOfTopLevelItem(item.parent() or item)]
            self.meaning_requested.emit(variable.name, variable.meaning)

    @Slot(QTreeWidgetItem, int)
    def _click(self, item: QTreeWidgetItem, column: int) -> None:
        """Go where a value comes from; a click on its name only selects it."""
        if column == 1:
            self._ask_for(item)

    def _ask_for(self, item: QTreeWidgetItem | None) -> None:
        if item is None:
            return
        parent = item.parent()
        variable = self._variables[self.indexOfTopLevelItem(parent or item)]
        if parent is not None and variable.element is None:
            variable = replace(variable, element=parent.indexOfChild(item))
        self.origin_requested.emit(variable)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Say what the pane is for when it is empty."""
        super().paintEvent(event)
        if not self._variables:
            painter = QPainter(self.viewport())
            painter.setPen(QColor(current_theme().muted_text))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            box = self.viewport().rect().adjusted(8, 0, -8, 0)
            painter.drawText(
                box, flags, "The variables of each step appear here; changed ones are highlighted."
            )

    def _fit_names(self) -> None:
        """Give the names the room that they need in bold, so that what a step has changed moves no column."""
        bold = QFont(self.font())
        bold.setBold(True)
        metrics, names = QFontMetrics(bold), [variable.name for variable in self._variables]
        names += [self.headerItem().text(0)]
        room = self.indentation() + 3 * metrics.horizontalAdvance("0")
        self.header().resizeSection(0, max(map(metrics.horizontalAdvance, names)) + room)

    @Slot()
    def _fill(self) -> None:
        """Write what differs from what is written; the parts of a vector once it is open."""
        for row, variable in enumerate(self._variables):
            item = self.topLevelItem(row)
            assert item is not None
            self._fill_item(item, variable)
            if isinstance(variable.now, tuple) and item.isExpanded():
                was = variable.before if isinstance(variable.before, tuple) else ()
                for k, part in enumerate(variable.now):
                    child, before = item.child(k), was[k] if k < len(was) else None
                    assert child is not None
                    self._fill_item(
                        child, Variable(child.text(0), part, before, "", variable.vertex, variable.digits)
                    )

    def _fill_item(self, item: QTreeWidgetItem, variable: Variable) -> None:
        assert isinstance(item, _VariableItem)
        for column, cell in enumerate(self._cells(variable)):
            item.show_cell(column, cell, self.font())

    def _cells(self, variable: Variable) -> "tuple[_Cell, _Cell, _Cell]":
        theme, font, is_changed = current_theme(), self.font().key(), variable.is_changed()
        # A polygon has more corners than there are colours: they begin anew.
        name_color = theme.text if variable.vertex is None else theme.vertex_text[variable.vertex % 3]
        texts, full = (
            [value_text(value, **how) for value in (variable.now, variable.before)]
            for how in ({"is_fraction": self._is_fraction, "digits": variable.digits}, {"is_full": True})
        )
        tips = [f"{variable.name} = {text}" for text in full]
        state = "changed" if is_changed else "unchanged"
        spoken = f"{variable.name} {value_text(variable.now, digits=variable.digits)}, {state}"
        return (
            _Cell(variable.name, name_color, font, is_changed, variable.meaning or variable.name),
            _Cell(
                texts[0],
                theme.accent_text if is_changed else theme.text,
                font,
                is_changed,
                f"{tips[0]}\nClick: go to the step that made it. Ctrl+[ comes back.",
                full[0].replace("\u2212", "-"),
                spoken,
            ),
            _Cell(texts[1], theme.muted_text, font, False, tips[1]),
        )

    @Slot()
    def _follow_theme(self) -> None:
        self._fit_names()
        self._fill()
        self.viewport().update()


_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class _Cell(NamedTuple):
    """What a cell of the table shows."""

    text: str
    color: str
    font: str
    """Key of the table's font."""
    is_changed: bool
    """Written in bold."""
    tip: str
    copied: str = ""
    """The value in full."""
    spoken: str = ""


class _VariableItem(QTreeWidgetItem):
    """A row of the table, which knows what it shows: every setter has the view lay out and paint again."""

    def __init__(self, name: str) -> None:
        super().__init__([name])
        self._shown: list[_Cell | None] = [None, None, None]
        self.setTextAlignment(1, _RIGHT)
        self.setTextAlignment(2, _RIGHT)

    def show_cell(self, column: int, cell: _Cell, font: QFont) -> None:
        """Set what differs from what the cell shows."""
        shown, self._shown[column] = self._shown[column], cell
        if shown is None or cell.text != shown.text:
            self.setText(column, cell.text)
        if shown is None or cell.color != shown.color:
            self.setForeground(column, QColor(cell.color))
        if shown is None or (cell.font, cell.is_changed) != (shown.font, shown.is_changed):
            written = tabular_font(font) if column else QFont(font)
            written.setBold(cell.is_changed)
            self.setFont(column, written)
            self.setData(column, _CHANGED, cell.is_changed)
        if shown is None or cell.tip != shown.tip:
            self.setToolTip(column, cell.tip)
        if cell.spoken and (shown is None or (cell.copied, cell.spoken) != (shown.copied, shown.spoken)):
            self.setData(column, Qt.ItemDataRole.UserRole, cell.copied)
            self.setData(column, Qt.ItemDataRole.AccessibleTextRole, cell.spoken)


def _shape(variable: Variable) -> tuple[str, int]:
    return variable.name, len(variable.now) if isinstance(variable.now, tuple) else 0


def _new_item(variable: Variable) -> _VariableItem:
    item = _VariableItem(variable.name)
    if isinstance(variable.now, tuple):
        named = len(variable.now) <= len(_COMPONENTS)
        for k in range(len(variable.now)):
            item.addChild(_VariableItem(_COMPONENTS[k] if named else f"[{k}]"))
    return item
