"""What stands above a plan: how much may differ, how often it is timed, and looking."""

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QPushButton,
    QSizePolicy,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labelled import labelled
from widgets.basics.message_bar import Progress
from widgets.basics.run_controls import RunControls

MOST_COLOR = 255
MOST_PIXELS = 999_999
MOST_ROUNDS = 99
EXACT, WITHIN = "exact", "within"


class PlanControls(QWidget):
    """Holds the tolerance; tells when the user wants to look, to stop, or to use what was chosen."""

    looking_requested = Signal()
    cancel_requested = Signal()
    applying_requested = Signal()
    chart_requested = Signal()
    """The user wants to see the plan's point among the others of the scene."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Tolerance and looking")
        self.kind_box = QComboBox(self)
        self.kind_box.setAccessibleName("Tolerance")
        self.kind_box.setToolTip(
            "How much the picture may differ from the one with everything on; exact: no byte of it"
        )
        self.kind_box.addItem("Within", WITHIN)
        self.kind_box.addItem("Exact", EXACT)
        self.color_box = self._number("Colour", "Largest difference of a channel, in 1/255", MOST_COLOR, 2)
        self.color_box.setSuffix("/255")
        self.pixels_box = self._number("Pixels", "How many pixels may differ by more", MOST_PIXELS, 0)
        self.pixels_box.setGroupSeparatorShown(True)
        self.rounds_box = self._number(
            "Rounds", "How often everything is timed, in turns: more take longer", MOST_ROUNDS, 3
        )
        self.rounds_box.setMinimum(1)
        self.running = RunControls(
            "Look",
            "Look at the scene, choose, and measure what was chosen (F5)",
            "Stop; what was found before stays (Escape)",
            self,
        )
        self.look_button, self.cancel_button = self.running.start_button, self.running.cancel_button
        self.apply_button = self._button(
            "Apply", "Draw and step the scene with what was chosen (Ctrl+Return); undo takes it back"
        )
        self.chart_button = self._button(
            "On the chart", "See the choice among all others: Whole pipeline, on the Compare page"
        )
        self._lay_out()
        self.kind_box.activated.connect(self._show_kind)
        self.look_button.clicked.connect(self.looking_requested)
        self.cancel_button.clicked.connect(self.cancel_requested)
        self.apply_button.clicked.connect(self.applying_requested)
        self.chart_button.clicked.connect(self.chart_requested)
        self.show_progress(None)
        self.show_usable(False, False)

    def _number(self, name: str, tip: str, highest: int, value: int) -> QSpinBox:
        box = QSpinBox(self)
        box.setRange(0, highest)
        box.setValue(value)
        box.setAccessibleName(name)
        box.setToolTip(tip)
        box.setKeyboardTracking(False)
        return box

    def _button(self, text: str, tip: str) -> QPushButton:
        button = QPushButton(text, self)
        button.setToolTip(tip)
        return button

    def _lay_out(self) -> None:
        row = QWidget(self)
        flow = FlowLayout(row, 12)
        flow.addWidget(labelled("Tolerance", self.kind_box))
        flow.addWidget(labelled("Colour", self.color_box))
        flow.addWidget(labelled("but for pixels", self.pixels_box))
        flow.addWidget(labelled("Rounds", self.rounds_box))
        for widget in (self.look_button, self.cancel_button, self.apply_button, self.chart_button):
            flow.addWidget(widget)
        flow.addWidget(self.running.progress)
        flow.addWidget(self.running.doing)
        row.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.addWidget(row)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for all lines of controls."""
        super().resizeEvent(event)
        self._keep_height()

    def _keep_height(self) -> None:
        self.setMinimumHeight(self.heightForWidth(self.width()))

    # What is chosen.

    @property
    def is_exact(self) -> bool:
        """Whether nothing may differ."""
        return bool(self.kind_box.currentData() == EXACT)

    @Slot()
    def _show_kind(self) -> None:
        for box in (self.color_box, self.pixels_box):
            box.setEnabled(not self.is_exact)

    def show_usable(self, can_apply: bool, can_chart: bool) -> None:
        """Show whether there is something to be applied and to be put on the chart."""
        self.apply_button.setEnabled(can_apply)
        self.chart_button.setEnabled(can_chart)

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far the look has come; ``None``: nobody is looking."""
        self.running.show_progress(progress)
        self._keep_height()
