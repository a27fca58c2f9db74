"""A narrow strip of upright tabs: a click unfolds the pane of a tab beside it, a second one folds it away."""

from PySide6.QtCore import QRect, QSize, Qt, Signal, Slot
from PySide6.QtGui import QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QStyle, QStyleOptionToolButton, QStylePainter, QToolButton, QWidget

from widgets.basics.controls import column_layout
from widgets.basics.focus_order import ArrowGroup


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
