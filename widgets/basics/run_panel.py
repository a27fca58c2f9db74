"""The panel above a page that runs something: its choices, starting and cancelling, and how far the work has come."""

from collections.abc import Iterable, Sequence

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QLabel, QProgressBar, QSizePolicy, QSpinBox, QWidget

from widgets.basics.controls import button_with_tip, column_layout, row_layout
from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labels import ElidedLabel, text_label
from widgets.basics.message_bar import Progress

Named = Sequence[tuple[str, str]]
"""Names and titles."""


class RunPanel(QWidget):
    """Rows of controls that wrap; emits nothing when it is set by the program."""

    chosen = Signal(str, object)
    """Name of a control, and the value that the user has chosen there."""
    start_requested = Signal()
    cancel_requested = Signal()

    def __init__(
        self, name: str, intro: str, start: str, start_tip: str, cancel_tip: str, parent: QWidget | None
    ) -> None:
        """Make an empty panel; ``intro`` is what the page shows and how to begin, ``start`` what the button says."""
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName(name)
        self.start_button = button_with_tip(start, start_tip, self)
        self.cancel_button = button_with_tip("Cancel", cancel_tip, self)
        self.progress = QProgressBar(self)
        self.progress.setTextVisible(False)
        self.progress.setFixedSize(160, 8)
        self.doing = ElidedLabel(self)
        self.doing.setProperty("role", "muted")
        self.doing.setFixedWidth(320)
        # An elided label takes any width by itself; here it keeps its own, so that a line that is full wraps.
        self.doing.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.rows = column_layout(self, 8, margins=(8, 8, 8, 8))
        self.intro = text_label(intro, self, name="What this page shows", wraps=True, is_selectable=True)
        self.rows.addWidget(self.intro)
        self._controls: list[QWidget] = []
        """Rows of controls; the last one starts the work."""
        self.start_button.clicked.connect(self.start_requested)
        self.cancel_button.clicked.connect(self.cancel_requested)

    # Making controls.

    def box(self, name: str, title: str, tip: str) -> QComboBox:
        """Return a new list of choices, with its name for `chosen`."""
        box = QComboBox(self)
        box.setObjectName(name)
        box.activated.connect(self._tell_item)
        box.setAccessibleName(title)
        box.setToolTip(tip)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        return box

    def number(self, name: str, title: str, tip: str, lowest: int, highest: int) -> QSpinBox:
        """Return a new field for a whole number, with its name for `chosen`."""
        box = QSpinBox(self)
        box.setObjectName(name)
        box.setRange(lowest, highest)
        box.setAccessibleName(title)
        box.setToolTip(tip)
        box.setKeyboardTracking(False)
        box.valueChanged.connect(self._tell_number)
        return box

    @Slot(int)
    def _tell_item(self, index: int) -> None:
        box = self.sender()
        assert isinstance(box, QComboBox)
        self.chosen.emit(box.objectName(), box.itemData(index))

    @Slot(int)
    def _tell_number(self, value: int) -> None:
        self.chosen.emit(self.sender().objectName(), value)

    def add_row(self, controls: Iterable[QWidget | tuple[str, QWidget]]) -> FlowLayout:
        """Add a row of controls, some with a label before them, and return its layout."""
        row = QWidget(self)
        row.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        flow = FlowLayout(row, 12)
        for control in controls:
            flow.addWidget(_labelled(*control) if isinstance(control, tuple) else control)
        self.rows.addWidget(row)
        self._controls.append(row)
        return flow

    # Showing.

    def set_brief(self, is_brief: bool) -> None:
        """Leave the introduction and all rows but the last out, or bring them back."""
        for widget in (self.intro, *self._controls[:-1]):
            widget.setVisible(not is_brief)
        self.keep_height()

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far the work has come; ``None``: nothing runs."""
        is_running = progress is not None
        had_focus = self.start_button.hasFocus() or self.cancel_button.hasFocus()
        for widget in (self.cancel_button, self.progress, self.doing):
            widget.setVisible(is_running)
        self.start_button.setVisible(not is_running)
        if had_focus:  # One takes the place of the other, for the keyboard too.
            (self.cancel_button if is_running else self.start_button).setFocus()
        if progress is not None:
            self.progress.setRange(0, progress.total)
            self.progress.setValue(progress.done)
            self.progress.setAccessibleName(progress.text)
            self.doing.setText(progress.text)
        self.keep_height()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for all lines of controls."""
        super().resizeEvent(event)
        self.keep_height()

    def keep_height(self) -> None:
        """Ask for the height that this width needs: a splitter does not ask by itself."""
        self.setMinimumHeight(self.heightForWidth(self.width()))


def fill_box(box: QComboBox, named: Named, current: str) -> None:
    """Offer names with titles; what stands there already is left."""
    if [(box.itemData(k), box.itemText(k)) for k in range(box.count())] != list(named):
        box.clear()
        for name, title in named:
            box.addItem(title, name)
    box.setCurrentIndex(max(box.findData(current), 0))


def set_number(box: QSpinBox, value: int) -> None:
    """Show a number without a signal."""
    box.blockSignals(True)
    box.setValue(value)
    box.blockSignals(False)


def _labelled(text: str, control: QWidget) -> QWidget:
    """Return a widget that holds a label and the control that it names."""
    pair = QWidget()
    row = row_layout(pair, 4)
    label = QLabel(text, pair)
    label.setBuddy(control)
    row.addWidget(label)
    row.addWidget(control)
    return pair
