"""Panes: side by side with borders that can be moved, unfolded by upright tabs."""

from typing import Any

from PySide6.QtCore import QEvent, QPoint, QRect, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QAccessible,
    QColor,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QRegion,
    QResizeEvent,
)
from PySide6.QtWidgets import (
    QSizePolicy,
    QSplitter,
    QSplitterHandle,
    QStyle,
    QStyleOptionToolButton,
    QStylePainter,
    QToolButton,
    QWidget,
)

from widgets.basics.accessibility import ArrowGroup, FocusRing
from widgets.basics.controls import column_layout
from widgets.basics.theme import current_theme

# Panes side by side with borders that can be seen, and moved by mouse and keyboard.


KEY_STEP = 16
"""Pixels by which an arrow key moves a border."""
_GRIP = 36
"""Length of the line that shows where to take hold."""
_REACH = 10
"""Pixels that the grip reaches over each of the panes: the border alone is too thin to be hit."""


class _Border(QSplitterHandle):
    """One border: a short line in its middle; arrows move it while it has the keyboard, Home and End all the way."""

    spoken_role = QAccessible.Role.Splitter

    def __init__(self, direction: Qt.Orientation, splitter: QSplitter) -> None:
        super().__init__(direction, splitter)
        self._ring = FocusRing(self)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setAccessibleName("Border between panes")
        self.setToolTip("Drag, or use the arrow keys after Tab: move the border")

        is_upright = direction == Qt.Orientation.Horizontal
        # The splitter lays the handle over both panes by these margins.
        self.setContentsMargins(*((_REACH, 0, _REACH, 0) if is_upright else (0, _REACH, 0, _REACH)))
        self._grabbed_at = 0

    def _place(self) -> int:
        return _REACH + (self.x() if self.orientation() == Qt.Orientation.Horizontal else self.y())

    def _along(self, point: QPoint) -> int:
        return point.x() if self.orientation() == Qt.Orientation.Horizontal else point.y()

    def _grip(self) -> QRect:
        """Return the part in the middle that reaches over both panes: large enough to be hit."""
        grip = QRect(0, 0, self.width(), _GRIP)
        if self.orientation() == Qt.Orientation.Vertical:
            grip = QRect(0, 0, _GRIP, self.height())
        grip.moveCenter(self.rect().center())
        return grip

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Leave the panes all but the grip."""
        # Not Qt's own: that one takes the margins away.
        del event
        self.setMask(QRegion(self.contentsRect()) | QRegion(self._grip()))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Take hold of the border."""
        super().mousePressEvent(event)
        self._grabbed_at = self._along(event.position().toPoint()) - _REACH

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Move the border along, by the place where it was taken."""
        if event.buttons() & Qt.MouseButton.LeftButton:
            there = self.splitter().mapFromGlobal(event.globalPosition().toPoint())
            self.moveSplitter(self._along(there) - self._grabbed_at)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the border."""
        less, more = (
            (Qt.Key.Key_Left, Qt.Key.Key_Right)
            if self.orientation() == Qt.Orientation.Horizontal
            else (Qt.Key.Key_Up, Qt.Key.Key_Down)
        )
        bounds: Any = self.splitter().getRange(self.splitter().indexOf(self))
        low, high = bounds
        targets: dict[int, int] = {
            less: self._place() - KEY_STEP,
            more: self._place() + KEY_STEP,
            Qt.Key.Key_Home: low,
            Qt.Key.Key_End: high,
        }
        if event.key() in targets:
            self.moveSplitter(min(max(targets[event.key()], low), high))
        else:
            event.ignore()

    def event(self, event: QEvent) -> bool:
        """Paint anew when the pointer comes and goes."""
        if event.type() in (QEvent.Type.HoverEnter, QEvent.Type.HoverLeave):
            self.update()
        return super().event(event)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line, longer under the pointer, and the focus ring close around its middle."""
        del event
        theme = current_theme()
        with QPainter(self) as painter:
            painter.fillRect(self.contentsRect(), QColor(theme.window))
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            if self.underMouse():
                # Else what the grip reaches over stays legible.
                painter.setBrush(QColor(theme.window))
                painter.drawRoundedRect(self._grip(), 4, 4)
            is_upright = self.orientation() == Qt.Orientation.Horizontal
            room = self.height() if is_upright else self.width()
            length = room if self.underMouse() else min(_GRIP, room)
            middle = self.rect().center()
            line = QRect(middle.x(), middle.y() - length // 2, 2, length)
            if not is_upright:
                line = QRect(middle.x() - length // 2, middle.y(), length, 2)
            painter.fillRect(line, QColor(theme.muted_text))
            across = (6, 0, -6, 0) if is_upright else (0, 6, 0, -6)
            self._ring.paint(painter, self._grip().adjusted(*across))


class PaneSplitter(QSplitter):
    """A splitter with such borders."""

    def createHandle(self) -> QSplitterHandle:
        """Make a border."""
        return _Border(self.orientation(), self)


# A narrow strip of upright tabs: a click unfolds the pane of a tab beside it, a second one folds it away.


class UprightButton(QToolButton):
    """A flat button whose text reads upwards."""

    def __init__(self, name: str, title: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.name = name
        self.setText(title)
        self.setCheckable(True)
        self.setProperty("flat", True)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """As high as the text is wide."""
        return super().sizeHint().transposed()

    def minimumSizeHint(self) -> QSize:
        """Never less than the text."""
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the button turned to the left."""
        del event
        option = QStyleOptionToolButton()
        self.initStyleOption(option)
        option.rect = QRect(0, 0, self.height(), self.width())
        painter = QStylePainter(self)
        painter.translate(0, self.height())
        painter.rotate(-90)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ToolButton, option)


class SideTabs(QWidget):
    """Upright tabs, at most one of them open; set by code, it emits nothing."""

    pane_chosen = Signal(str)
    """Name of the pane whose tab was clicked: open now, or folded away if it was open."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.buttons: dict[str, UprightButton] = {}
        self._arrows = ArrowGroup((), self, is_upright=True)
        self._column = column_layout(self, 4)
        self._column.addStretch(1)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)

    def add_tab(self, name: str, title: str, tip: str) -> None:
        """Put another tab below the others."""
        button = UprightButton(name, title, self)
        button.setToolTip(tip)
        button.clicked.connect(self._choose)
        self._column.insertWidget(len(self.buttons), button)
        self.buttons[name] = button
        self._arrows.show_buttons(list(self.buttons.values()))

    def show_open(self, name: str) -> None:
        """Mark the tab of the pane that is open; empty: none is."""
        for button in self.buttons.values():
            button.setChecked(button.name == name)

    @Slot()
    def _choose(self) -> None:
        button = self.sender()
        assert isinstance(button, UprightButton)
        self.pane_chosen.emit(button.name)
