"""The variables of a step: value now, value before, and which of them the step has changed."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import NamedTuple

from PySide6.QtCore import (
    QEvent,
    QModelIndex,
    QPersistentModelIndex,
    QRect,
    QSignalBlocker,
    QSize,
    Qt,
    Signal,
    Slot,
)
from PySide6.QtGui import (
    QAction,
    QColor,
    QFont,
    QFontMetrics,
    QGuiApplication,
    QHelpEvent,
    QKeySequence,
    QPainter,
    QPaintEvent,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolTip,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)
from shiboken6 import delete

from core.explain.number_text import DIGITS, exact_text, fraction_text, full_text
from core.explain.records import Value, Variable
from widgets.basics.accessibility import KeyClaim
from widgets.basics.controls import LEAST_TARGET
from widgets.basics.drawing import paint_share
from widgets.basics.theme import Theme, current_theme, theme_notifier
from widgets.basics.typed_value import tabular_font

EVERY_DEFAULT: Mapping[float, int] = MappingProxyType({})
"""No number has other digits than usual."""
_COMPONENTS = ("x", "y", "z", "w")


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


class _CellDelegate(QStyledItemDelegate):
    """Gives each cell its height, and writes the tooltip of one that is pointed at."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(
            super().sizeHint(option, index).width(), max(option.fontMetrics.height() + 6, LEAST_TARGET)
        )

    def helpEvent(
        self,
        event: QHelpEvent,
        view: QAbstractItemView,
        option: QStyleOptionViewItem,
        index: QModelIndex | QPersistentModelIndex,
    ) -> bool:
        item = view.itemFromIndex(index) if isinstance(view, QTreeWidget) else None
        if event.type() != QEvent.Type.ToolTip or not isinstance(item, _VariableItem):
            return super().helpEvent(event, view, option, index)
        QToolTip.showText(event.globalPos(), item.tip(index.column()), view.viewport(), option.rect)
        return True


class VariablesView(QTreeWidget):
    """A table of name, now and before; vectors open into their components."""

    origin_requested = Signal(object)
    """The user asks where the value of this `Variable` comes from."""
    picture_requested = Signal(str)
    """The user wants to see the variable of this name in every pixel."""
    meaning_requested = Signal(str, str)
    """The user asks what a variable is: its name, and its meaning in a sentence."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._variables: tuple[Variable, ...] = ()
        self._owed: tuple[Variable, ...] | None = None
        """What is shown once the pane is no longer folded away."""
        self._is_fraction = False
        self._kept_look: _Look | None = None
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
        self.setItemDelegate(_CellDelegate(self))
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
        self._fraction_action = QAction("Exact 1/256ths", self, checkable=True)
        self._fraction_action.toggled.connect(self.show_fractions)
        origin = QAction("Go to the step that made it", self)
        origin.setShortcut(QKeySequence(Qt.Key.Key_Return))
        origin.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        origin.triggered.connect(self._ask_for_current)
        picture = QAction("Show it in every pixel", self)
        picture.triggered.connect(self._ask_for_picture)
        meaning = QAction("What is this?", self)
        meaning.triggered.connect(self._ask_for_meaning)
        self.itemClicked.connect(self._click)
        self.itemExpanded.connect(self._fill)
        self.addActions([picture, meaning, origin, copy, self._fraction_action])
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    @Slot(object)
    def show_variables(self, variables: Sequence[Variable]) -> None:
        """Show the variables of a step; open vectors and the selection stay while the names stay."""
        variables = tuple(variables)
        if self.isHidden() and self.testAttribute(Qt.WidgetAttribute.WA_WState_ExplicitShowHide):
            self._owed = variables
            return
        self._owed = None
        is_same_rows = [_shape(v) for v in variables] == [_shape(v) for v in self._variables]
        self._variables = variables
        if not is_same_rows:
            self._begin_anew()
        self._fill()

    def setVisible(self, visible: bool) -> None:
        """Show what has come while the pane was folded away."""
        super().setVisible(visible)
        if visible and self._owed is not None:
            self.show_variables(self._owed)

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
            owner = item.parent()
            if not isinstance(item, _VariableItem) or (owner is not None and not owner.isExpanded()):
                continue
            name = f"{owner.text(0)}.{item.text(0)}" if owner else item.text(0)
            lines.append(f"{name} = " + item.in_full().replace("\u2212", "-"))
        if lines:
            QGuiApplication.clipboard().setText("\n".join(lines))

    @Slot()
    def _ask_for_current(self) -> None:
        self._ask_for(self.currentItem())

    @Slot()
    def _ask_for_picture(self) -> None:
        item = self.currentItem()
        if item is not None:
            parent = item.parent()
            name = (parent or item).text(0)
            self.picture_requested.emit(f"{name}.{item.text(0)}" if parent else name)

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
        """Draw a bar before each value that the step has changed; say what the pane is for when it is empty."""
        super().paintEvent(event)
        painter, theme = QPainter(self.viewport()), current_theme()
        if not self._variables:
            painter.setPen(QColor(theme.muted_text))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            box = self.viewport().rect().adjusted(8, 0, -8, 0)
            painter.drawText(
                box, flags, "The variables of each step appear here; changed ones are highlighted."
            )
        left, seen = self.columnViewportPosition(1) + 1, event.rect()
        item = self.itemAt(left, seen.top())
        while isinstance(item, _VariableItem):
            row = self.visualItemRect(item)
            if row.top() > seen.bottom():
                break
            if item.is_changed:
                painter.fillRect(left, row.top() + 3, 4, row.height() - 6, QColor(theme.accent))
            if item.share is not None:
                bar = QRect(left + 6, row.bottom() - 3, self.columnWidth(1) - 10, 3)
                paint_share(painter, bar, item.share)
            item = self.itemBelow(item)

    def _fit_names(self) -> None:
        """Give the names the room that they need in bold, so that what a step has changed moves no column."""
        bold = QFont(self.font())
        bold.setBold(True)
        metrics, names = QFontMetrics(bold), [variable.name for variable in self._variables]
        names += [self.headerItem().text(0)]
        room = self.indentation() + 3 * metrics.horizontalAdvance("0")
        header = self.header()
        # Told of it, the table would paint again a moment later.
        with QSignalBlocker(header):
            header.resizeSection(0, max(map(metrics.horizontalAdvance, names)) + room)
            header.sectionSize(1)  # The other columns follow when they are asked for.
        self.viewport().update()

    def _begin_anew(self) -> None:
        """Have a closed row for each variable; rows that there are stay, for Qt lays out every one that is added."""
        self.selectionModel().clear()
        while self.topLevelItemCount() > len(self._variables):
            self.takeTopLevelItem(self.topLevelItemCount() - 1)
        missing = len(self._variables) - self.topLevelItemCount()
        self.addTopLevelItems([_VariableItem() for _ in range(missing)])
        for row, variable in enumerate(self._variables):
            item = self.topLevelItem(row)
            assert isinstance(item, _VariableItem)
            item.begin_anew(variable)
        self._fit_names()
        self.executeDelayedItemsLayout()

    @Slot()
    def _fill(self) -> None:
        """Write what differs from what is written; the parts of a vector once it is open."""
        look = self._look()
        for row, variable in enumerate(self._variables):
            item = self.topLevelItem(row)
            assert isinstance(item, _VariableItem)
            item.show_variable(variable, look)
            if isinstance(variable.now, tuple) and item.isExpanded():
                was = variable.before if isinstance(variable.before, tuple) else ()
                is_named = len(variable.now) <= len(_COMPONENTS)
                for k, part in enumerate(variable.now):
                    child, before = item.child(k), was[k] if k < len(was) else None
                    name = _COMPONENTS[k] if is_named else f"[{k}]"
                    assert isinstance(child, _VariableItem)
                    child.show_variable(
                        Variable(name, part, before, "", variable.vertex, variable.digits), look
                    )

    def _look(self) -> "_Look":
        """Return how values are written now."""
        font, kept = self.font(), self._kept_look
        if kept is None or kept[:3] != (current_theme(), font, self._is_fraction):
            names, figures = (QFont(font), QFont(font)), (tabular_font(font), tabular_font(font))
            for pair in (names, figures):
                pair[True].setBold(True)
            kept = self._kept_look = _Look(current_theme(), font, self._is_fraction, names, figures)
        return kept

    @Slot()
    def _follow_theme(self) -> None:
        self._fit_names()
        self._fill()
        self.viewport().update()


_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class _Look(NamedTuple):
    """How values are written."""

    theme: Theme
    font: QFont
    is_fraction: bool
    """In exact 1/256ths."""
    names: tuple[QFont, QFont]
    """Fonts of names, in bold the second one."""
    figures: tuple[QFont, QFont]
    """The same of values."""


class _VariableItem(QTreeWidgetItem):
    """A row of the table, which knows what it shows: every setter has the view lay out and paint again."""

    def __init__(self) -> None:
        super().__init__()
        self._variable = Variable("", None)
        self._made_from: tuple[object, ...] = ()
        """What is shown, to the last digit: most variables stay from step to step."""
        self._shown: tuple[str, str, str, bool, int | None, _Look] | None = None
        """Texts now and before, what is spoken, whether the step has changed it, its vertex, and how it is written."""
        self.setTextAlignment(1, _RIGHT)
        self.setTextAlignment(2, _RIGHT)

    def begin_anew(self, variable: Variable) -> None:
        """Be the closed row of another variable."""
        if self.childCount():
            self.setExpanded(False)
            for child in self.takeChildren():
                delete(child)  # Python would keep it.
        if isinstance(variable.now, tuple):
            self.addChildren([_VariableItem() for _ in variable.now])

    @property
    def is_changed(self) -> bool:
        """Whether the step has changed the value."""
        return self._shown is not None and self._shown[3]

    @property
    def share(self) -> float | None:
        """What part of a whole the value is."""
        return self._variable.share

    def in_full(self, *, is_before: bool = False) -> str:
        """Return the value with full precision."""
        value = self._variable.before if is_before else self._variable.now
        return value_text(value, is_full=True)

    def tip(self, column: int) -> str:
        """Return what the tooltip of a cell says."""
        if column == 0:
            return self._variable.meaning or self._variable.name
        where = "\nClick: go to the step that made it. Ctrl+[ comes back." if column == 1 else ""
        return f"{self._variable.name} = {self.in_full(is_before=column == 2)}{where}"

    def show_variable(self, variable: Variable, look: _Look) -> None:
        """Set what differs from what the row shows."""
        before, self._variable = self._variable, variable
        made_from = (variable.name, repr((variable.now, variable.before)), variable.vertex, look)
        if made_from == self._made_from and _own_digits(variable) == _own_digits(before):
            return
        self._made_from, is_changed = made_from, variable.is_changed()
        now, earlier = (
            value_text(value, is_fraction=look.is_fraction, digits=variable.digits)
            for value in (variable.now, variable.before)
        )
        said = value_text(variable.now, digits=variable.digits) if look.is_fraction else now
        spoken = f"{variable.name} {said}, {'changed' if is_changed else 'unchanged'}"
        if variable.name != self.text(0):
            self.setText(0, variable.name)
        shown, self._shown = self._shown, (now, earlier, spoken, is_changed, variable.vertex, look)
        if shown == self._shown:
            return
        if shown is None or now != shown[0]:
            self.setText(1, now)
        if shown is None or earlier != shown[1]:
            self.setText(2, earlier)
        if shown is None or spoken != shown[2]:
            self.setData(1, Qt.ItemDataRole.AccessibleTextRole, spoken)
        if shown is None or shown[3:] != self._shown[3:]:
            self._color(is_changed, look)

    def _color(self, is_changed: bool, look: _Look) -> None:
        """Let what the step has changed stand out by weight and colour; a polygon has more corners than colours."""
        theme, vertex = look.theme, self._variable.vertex
        name_color = theme.text if vertex is None else theme.vertex_text[vertex % 3]
        colors = (name_color, theme.accent_text if is_changed else theme.text, theme.muted_text)
        for column, color in enumerate(colors):
            self.setFont(column, (look.figures if column else look.names)[is_changed and column < 2])
            self.setForeground(column, QColor(color))


def _own_digits(variable: Variable) -> Mapping[float, int]:
    """Return the digits of a variable's numbers, by their size, that are not the usual ones."""
    if not variable.digits:
        return EVERY_DEFAULT
    values = (variable.now, variable.before)
    parts = (part for value in values for part in (value if isinstance(value, tuple) else (value,)))
    sizes = {abs(part) for part in parts if isinstance(part, int | float)}
    return {size: variable.digits[size] for size in sizes if size in variable.digits}


def _shape(variable: Variable) -> tuple[str, int]:
    return variable.name, len(variable.now) if isinstance(variable.now, tuple) else 0
