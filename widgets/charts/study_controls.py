"""What stands above the charts of a study: the work and its size, the axes, and measuring."""

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QSizePolicy,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from widgets.basics.flow_layout import FlowLayout
from widgets.basics.labelled import labelled
from widgets.basics.message_bar import Progress
from widgets.basics.run_controls import RunControls
from widgets.charts.dial_control import DialChoice, DialControl

MOST_ROUNDS = 99
Named = Sequence[tuple[str, str]]
"""Names and titles."""


@dataclass(frozen=True)
class StudyChoices:
    """Everything that can be chosen, and what is."""

    works: Named
    work: str
    dials: tuple[DialChoice, ...]
    measures: Named
    measure: str
    costs: Named
    """What the methods may be charged with: time, or a count of work."""
    cost: str
    rounds: int
    seed: int
    can_measure: bool = True


class StudyControls(QWidget):
    """Tells what the user chooses; emits nothing when it is set by the program."""

    work_chosen = Signal(str)
    dial_chosen = Signal(str, float)
    measure_chosen = Signal(str)
    """The error on the vertical axis."""
    cost_chosen = Signal(str)
    """What is on the horizontal axis."""
    rounds_chosen = Signal(int)
    seed_chosen = Signal(int)
    measuring_requested = Signal()
    cancel_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Work and measuring")
        self.work_box = self._box("Work", "What all methods are put to")
        self.measure_box = self._box("Error", "What is counted as wrong: the vertical axis of the chart")
        self.cost_box = self._box(
            "Cost", "Time on this machine, or a count of work that is the same on every machine"
        )
        self.rounds_box = self._number("Rounds", "How often every method is timed, in turns", 1, MOST_ROUNDS)
        self.seed_box = self._number("Seed", "The random numbers that the work is made from", 0, 9999)
        self.running = RunControls(
            "Measure",
            "Measure all methods on this work (F5). It goes on while other families and pages are looked at; the last "
            "result of every family is there again at the next start.",
            "Stop measuring; what was measured before stays (Escape)",
            self,
        )
        self.measure_button, self.cancel_button = self.running.start_button, self.running.cancel_button
        self.progress, self.doing = self.running.progress, self.running.doing
        self._dials: dict[str, DialControl] = {}
        self._lay_out()
        self.work_box.activated.connect(self._choose_work)
        self.measure_box.activated.connect(self._choose_measure)
        self.cost_box.activated.connect(self._choose_cost)
        self.rounds_box.valueChanged.connect(self.rounds_chosen)
        self.seed_box.valueChanged.connect(self.seed_chosen)
        self.measure_button.clicked.connect(self.measuring_requested)
        self.cancel_button.clicked.connect(self.cancel_requested)
        self.show_progress(None)

    def _box(self, name: str, tip: str) -> QComboBox:
        box = QComboBox(self)
        box.setAccessibleName(name)
        box.setToolTip(tip)
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        return box

    def _number(self, name: str, tip: str, lowest: int, highest: int) -> QSpinBox:
        box = QSpinBox(self)
        box.setRange(lowest, highest)
        box.setAccessibleName(name)
        box.setToolTip(tip)
        box.setKeyboardTracking(False)
        return box

    def _lay_out(self) -> None:
        self._work_row = QWidget(self)
        self._work_flow = FlowLayout(self._work_row, 12)
        self._work_flow.addWidget(labelled("Work", self.work_box))
        self._work_flow.addWidget(labelled("Rounds", self.rounds_box))
        self._work_flow.addWidget(labelled("Seed", self.seed_box))
        axes = QWidget(self)
        flow = FlowLayout(axes, 12)
        flow.addWidget(labelled("Error", self.measure_box))
        flow.addWidget(labelled("Cost", self.cost_box))
        for widget in self.running.widgets:
            flow.addWidget(widget)
        for row in (self._work_row, axes):
            row.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(8)
        layout.addWidget(self._work_row)
        layout.addWidget(axes)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for all lines of controls."""
        super().resizeEvent(event)
        self._keep_height()

    def _keep_height(self) -> None:
        """Ask for the height that this width needs: a splitter does not ask by itself."""
        self.setMinimumHeight(self.heightForWidth(self.width()))

    # Showing.

    def show_choices(self, choices: StudyChoices) -> None:
        """Show what can be chosen and what is."""
        for box, named, current in (
            (self.work_box, choices.works, choices.work),
            (self.measure_box, choices.measures, choices.measure),
            (self.cost_box, choices.costs, choices.cost),
        ):
            _fill(box, named, current)
        for number, value in ((self.rounds_box, choices.rounds), (self.seed_box, choices.seed)):
            number.blockSignals(True)
            number.setValue(value)
            number.blockSignals(False)
        self._show_dials(choices.dials)
        self.measure_button.setEnabled(choices.can_measure)
        self._keep_height()

    def dial(self, name: str) -> DialControl:
        """Return the control of a dial."""
        return self._dials[name]

    def _show_dials(self, dials: tuple[DialChoice, ...]) -> None:
        same = [(d.name, d.title, d.values) for d in dials] == [
            (c.dial.name, c.dial.title, c.dial.values) for c in self._dials.values()
        ]
        if not same:
            for control in self._dials.values():
                self._work_flow.removeWidget(control)
                control.hide()
                control.deleteLater()
            self._dials = {dial.name: DialControl(dial, self._work_row) for dial in dials}
            for place, control in enumerate(self._dials.values()):
                control.value_chosen.connect(self.dial_chosen)
                self._work_flow.insert_widget(place + 1, control)
                control.show()
        for dial in dials:
            self._dials[dial.name].show_value(dial.value)

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far measuring has come; ``None``: nothing is being measured."""
        self.running.show_progress(progress)
        self._keep_height()

    # What the user chose.

    @Slot(int)
    def _choose_work(self, index: int) -> None:
        self.work_chosen.emit(self.work_box.itemData(index))

    @Slot(int)
    def _choose_measure(self, index: int) -> None:
        self.measure_chosen.emit(self.measure_box.itemData(index))

    @Slot(int)
    def _choose_cost(self, index: int) -> None:
        self.cost_chosen.emit(self.cost_box.itemData(index))


def _fill(box: QComboBox, named: Named, current: str) -> None:
    """Offer names with titles; what stands there already is left."""
    if [(box.itemData(k), box.itemText(k)) for k in range(box.count())] != list(named):
        box.clear()
        for name, title in named:
            box.addItem(title, name)
    box.setCurrentIndex(max(box.findData(current), 0))
