"""The scene as typed values: camera, lights, meshes and vertices, each number editable."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil

from PySide6.QtCore import QRect, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QFontMetricsF, QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import (
    QApplication,
    QCheckBox,
    QGridLayout,
    QLabel,
    QScrollArea,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from widgets.basics.accessibility import KeyClaim
from widgets.basics.controls import column_layout, text_label
from widgets.basics.theme import current_theme, theme_notifier
from widgets.basics.typed_value import TypedValue


@dataclass(frozen=True)
class OutlineValue:
    """One number of a row."""

    name: str
    """Its name inside the row, such as ``x``; the path of the number is ``row/name``."""
    value: float
    lowest: float = float("-inf")
    highest: float = float("inf")
    is_flag: bool = False
    """Whether it is yes or no, 1 or 0: a box to check instead of a number."""


@dataclass(frozen=True)
class OutlineRow:
    """A named thing with one to four numbers."""

    path: str
    """Unique in the outline, such as ``triangle0/vertex1``."""
    label: str
    values: tuple[OutlineValue, ...] = ()
    vertex: int | None = None
    """0, 1 or 2 where it is a vertex of that colour."""
    note: str = ""
    """Text instead of numbers (``968 triangles``), or the tooltip where there are numbers."""


@dataclass(frozen=True)
class OutlineGroup:
    """Rows under one heading."""

    path: str
    title: str
    rows: tuple[OutlineRow, ...]
    is_open: bool = True


INDENT = 10
"""Of the name of a row, in pixels: a vertex has its bar there."""


class _RowLabel(QLabel):
    """The name of a row; a click selects it. A vertex has its colour as a bar."""

    def __init__(self, row: OutlineRow, outline: "SceneOutline", parent: QWidget) -> None:
        super().__init__(row.label, parent)
        self._row = row
        self._outline = outline
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setIndent(INDENT)
        KeyClaim(self, (Qt.Key.Key_Space, Qt.Key.Key_Return, Qt.Key.Key_Enter))
        self.setAccessibleName(row.label)
        self.setToolTip(row.note or row.label)
        self.setCursor(Qt.CursorShape.PointingHandCursor)

    def sizeHint(self) -> QSize:
        return super().sizeHint() + QSize(6, 0)

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        if event.button() == Qt.MouseButton.LeftButton:
            self._outline.choose_row(self._row.path)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Space):
            self._outline.choose_row(self._row.path)
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        theme, painter = current_theme(), QPainter(self)
        is_selected = self._outline.selected_path() == self._row.path
        if is_selected:
            painter.fillRect(self.rect(), QColor(theme.selection))
            painter.setPen(QColor(theme.text))
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
        if self._row.vertex is not None:
            bar = self.rect().adjusted(0, 3, 0, -3)
            bar.setWidth(4)
            painter.fillRect(bar, QColor(theme.vertex[self._row.vertex]))
        if self.hasFocus():
            painter.setPen(QPen(QColor(theme.focus), 2))
            painter.drawRect(self.rect().adjusted(1, 1, -1, -1))
        # Qt itself would paint a text that can take the focus twice when it is shown.
        height = ceil(QFontMetricsF(self.font()).height())
        place = QRect(INDENT, (self.height() - height) // 2, self.width() - INDENT, height)
        flags = int(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        self.style().drawItemText(
            painter, place, flags, self.palette(), self.isEnabled(), self.text(), self.foregroundRole()
        )


class SceneOutline(QScrollArea):
    """Groups that fold, rows that select, numbers that are typed."""

    value_edited = Signal(str, float)
    """The user has typed another value: the path ``row/name`` and the value."""
    values_edited = Signal(object)
    """The user has typed several numbers of a row in one field: path to value."""
    row_selected = Signal(str)
    """The user has selected a row."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._groups: tuple[OutlineGroup, ...] = ()
        self._fields: dict[str, TypedValue] = {}
        self._flags: dict[str, QCheckBox] = {}
        self._labels: dict[str, _RowLabel] = {}
        self._bodies: dict[str, QWidget] = {}
        self._rows: dict[QWidget, str] = {}
        """Paths of rows, by what takes the focus for their numbers."""
        self._selected = ""
        self.setWidgetResizable(True)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAsNeeded)
        self.setCornerWidget(QWidget(self))
        self.setAccessibleName("Scene outline")
        theme_notifier().theme_changed.connect(self._follow_theme)
        QApplication.instance().focusChanged.connect(self._follow_focus)  # type: ignore[union-attr]
        self._build()

    @Slot(object)
    def show_groups(self, groups: Sequence[OutlineGroup]) -> None:
        """Show the scene; fields, focus and folded groups stay while only numbers differ."""
        groups = tuple(groups)
        is_same = _skeleton(groups) == _skeleton(self._groups)
        self._groups = groups
        if not is_same:
            self._build()
        for group in groups:
            for row in group.rows:
                for value in row.values:
                    path = f"{row.path}/{value.name}"
                    if value.is_flag:
                        self._flags[path].setChecked(bool(value.value))
                    else:
                        self._fields[path].show_value(value.value)

    @Slot(str)
    def show_selection(self, path: str) -> None:
        """Mark a row and bring it into view; an empty path unmarks."""
        self._selected = path
        for label in self._labels.values():
            label.update()
        if path in self._labels:
            self.ensureWidgetVisible(self._labels[path], 0, 24)

    def selected_path(self) -> str:
        """Return the path of the marked row; empty when there is none."""
        return self._selected

    def field(self, path: str) -> TypedValue:
        """Return the field of a number by its path ``row/name``."""
        return self._fields[path]

    def flag(self, path: str) -> QCheckBox:
        """Return the box of a yes or no by its path ``row/name``."""
        return self._flags[path]

    def choose_row(self, path: str) -> None:
        """Select a row as the user."""
        if path != self._selected:
            self.show_selection(path)
            self.row_selected.emit(path)

    def sizeHint(self) -> QSize:
        """Room for a label and four short numbers."""
        return QSize(304, 400)

    @Slot(QWidget, QWidget)
    def _follow_focus(self, before: QWidget | None, now: QWidget | None) -> None:
        """Select the row whose number takes the focus."""
        if now in self._rows:
            self.choose_row(self._rows[now])

    def _build(self) -> None:
        self._fields.clear()
        self._flags.clear()
        self._labels.clear()
        self._bodies.clear()
        self._rows.clear()
        content = QWidget()
        content.setProperty("role", "panel")
        content.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        layout = column_layout(content, 4, margins=(4, 4, 4, 8))
        if not self._groups:
            hint = text_label(
                "The scene appears here: camera, lights, meshes and vertices with their numbers.",
                None,
                role="muted",
                wraps=True,
            )
            hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
            layout.addWidget(hint, 1)
        for group in self._groups:
            layout.addWidget(self._heading(group, content))
            body = self._group_body(group, content)
            body.setVisible(group.is_open)
            self._bodies[group.path] = body
            layout.addWidget(body)
        layout.addStretch(0 if not self._groups else 1)
        self.setWidget(content)

    def _heading(self, group: OutlineGroup, parent: QWidget) -> QToolButton:
        heading = QToolButton(parent)
        heading.setText(group.title)
        heading.setProperty("flat", True)
        heading.setObjectName(group.path)
        heading.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        heading.setArrowType(Qt.ArrowType.DownArrow if group.is_open else Qt.ArrowType.RightArrow)
        # As wide as the panel, not as its text: a long title is shortened, and the numbers stay in sight.
        heading.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        heading.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        heading.setToolTip(f"Show or hide {group.title}")
        heading.clicked.connect(self._fold)
        return heading

    def _group_body(self, group: OutlineGroup, parent: QWidget) -> QWidget:
        body = QWidget(parent)
        grid = QGridLayout(body)
        grid.setContentsMargins(0, 0, 0, 4)
        grid.setHorizontalSpacing(2)
        grid.setVerticalSpacing(3)
        names: tuple[str, ...] = ()
        place = 0
        for row in group.rows:
            row_names = tuple(value.name for value in row.values)
            if len(row_names) > 1 and row_names != names:
                # Name the columns once for all rows that share them.
                for column, name in enumerate(row_names, start=1):
                    head = text_label(name, body, role="muted")
                    head.setAlignment(Qt.AlignmentFlag.AlignRight)
                    head.setContentsMargins(0, 0, 8, 0)
                    grid.addWidget(head, place, column)
                place += 1
                names = row_names
            label = _RowLabel(row, self, body)
            self._labels[row.path] = label
            grid.addWidget(label, place, 0)
            if row.values:
                for column, value in enumerate(row.values, start=1):
                    made = self._flag(row, value, body) if value.is_flag else self._number(row, value, body)
                    grid.addWidget(made, place, column)
            elif row.note:
                note = text_label(row.note, body, role="muted", wraps=True)
                grid.addWidget(note, place, 1, 1, 4)
            place += 1
        for column in range(1, 5):
            grid.setColumnStretch(column, 1)
        return body

    def _number(self, row: OutlineRow, value: OutlineValue, parent: QWidget) -> QWidget:
        path = f"{row.path}/{value.name}"
        field = TypedValue(f"{row.label} {value.name}", parent, is_compact=True)
        field.setObjectName(path)
        field.set_range(value.lowest, value.highest)
        self._rows[field.edit] = row.path
        field.set_most_numbers(len(row.values) - row.values.index(value))
        field.value_committed.connect(self._edit)
        field.values_committed.connect(self._edit_several)
        self._fields[path] = field
        return field

    def _flag(self, row: OutlineRow, value: OutlineValue, parent: QWidget) -> QCheckBox:
        path = f"{row.path}/{value.name}"
        box = QCheckBox(parent)
        box.setObjectName(path)
        box.setAccessibleName(row.label)
        box.setToolTip(row.note or row.label)
        self._rows[box] = row.path
        box.clicked.connect(self._check)
        self._flags[path] = box
        return box

    @Slot(bool)
    def _check(self, is_checked: bool) -> None:
        self.value_edited.emit(self.sender().objectName(), float(is_checked))

    @Slot(float)
    def _edit(self, value: float) -> None:
        field = self.sender()
        if isinstance(field, TypedValue):
            self.value_edited.emit(field.objectName(), value)

    @Slot(object)
    def _edit_several(self, values: list[float]) -> None:
        path = self.sender().objectName()
        paths = [f"{row.path}/{value.name}" for g in self._groups for row in g.rows for value in row.values]
        first = paths.index(path)
        self.values_edited.emit(dict(zip(paths[first : first + len(values)], values, strict=True)))

    @Slot()
    def _fold(self) -> None:
        heading = self.sender()
        if isinstance(heading, QToolButton):
            is_open = self._bodies[heading.objectName()].isHidden()
            heading.setArrowType(Qt.ArrowType.DownArrow if is_open else Qt.ArrowType.RightArrow)
            self._bodies[heading.objectName()].setVisible(is_open)

    @Slot()
    def _follow_theme(self) -> None:
        for label in self._labels.values():
            label.update()


def _skeleton(groups: Sequence[OutlineGroup]) -> list[object]:
    """Return all that makes another set of widgets necessary: everything but the numbers."""
    return [
        (
            group.path,
            group.title,
            [
                (
                    r.path,
                    r.label,
                    r.vertex,
                    r.note,
                    [(v.name, v.lowest, v.highest, v.is_flag) for v in r.values],
                )
                for r in group.rows
            ],
        )
        for group in groups
    ]
