"""The variables of a step: value now, value before, and which of them the step has changed."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt, Signal, Slot
from PySide6.QtGui import QAction, QColor, QFont, QGuiApplication, QKeySequence, QPainter, QPaintEvent
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
        return QSize(super().sizeHint(option, index).width(), option.fontMetrics.height() + 6)

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

    values_copied = Signal(str)
    """The user has copied the selected variables; the argument is the text."""
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
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
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
            lines.append(f"{f'{owner.text(0)}.{name}' if owner else name} = {value}")
        if lines:
            text = "\n".join(lines)
            QGuiApplication.clipboard().setText(text)
            self.values_copied.emit(text)

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

    def _fill(self) -> None:
        for row, variable in enumerate(self._variables):
            item = self.topLevelItem(row)
            if item is None:
                continue
            self._fill_item(item, variable)
            if isinstance(variable.now, tuple):
                was = variable.before if isinstance(variable.before, tuple) else ()
                for k, part in enumerate(variable.now):
                    before = was[k] if k < len(was) else None
                    child = item.child(k)
                    if child is not None:
                        self._fill_item(
                            child, Variable(child.text(0), part, before, "", variable.vertex, variable.digits)
                        )

    def _fill_item(self, item: QTreeWidgetItem, variable: Variable) -> None:
        theme = current_theme()
        is_changed = variable.is_changed()
        name_color = theme.text if variable.vertex is None else theme.vertex_text[variable.vertex]
        item.setForeground(0, QColor(name_color))
        item.setForeground(1, QColor(theme.accent_text if is_changed else theme.text))
        item.setForeground(2, QColor(theme.muted_text))
        for column, value in ((1, variable.now), (2, variable.before)):
            font = tabular_font(self.font())
            font.setBold(is_changed and column == 1)
            item.setFont(column, font)
            item.setText(column, value_text(value, is_fraction=self._is_fraction, digits=variable.digits))
            item.setTextAlignment(column, _RIGHT)
            item.setToolTip(column, f"{variable.name} = {value_text(value, is_full=True)}")
        item.setToolTip(1, f"{item.toolTip(1)}\nClick: go to the step that made it. Ctrl+[ comes back.")
        name_font = QFont(self.font())
        name_font.setBold(is_changed)
        item.setFont(0, name_font)
        item.setToolTip(0, variable.meaning or variable.name)
        item.setData(1, _CHANGED, is_changed)
        item.setData(1, Qt.ItemDataRole.UserRole, value_text(variable.now, is_full=True).replace("−", "-"))
        state = "changed" if is_changed else "unchanged"
        spoken = f"{variable.name} {value_text(variable.now, digits=variable.digits)}, {state}"
        item.setData(1, Qt.ItemDataRole.AccessibleTextRole, spoken)

    @Slot()
    def _follow_theme(self) -> None:
        self._fill()
        self.viewport().update()


_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


def _shape(variable: Variable) -> tuple[str, int]:
    return variable.name, len(variable.now) if isinstance(variable.now, tuple) else 0


def _new_item(variable: Variable) -> QTreeWidgetItem:
    item = QTreeWidgetItem([variable.name])
    if isinstance(variable.now, tuple):
        named = len(variable.now) <= len(_COMPONENTS)
        for k in range(len(variable.now)):
            item.addChild(QTreeWidgetItem([_COMPONENTS[k] if named else f"[{k}]"]))
    return item
