"""What stands above the charts of a study: the work and its size, the axes, and measuring."""

from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from widgets.basics.run_panel import Named, RunPanel, fill_box, set_number
from widgets.charts.dial_control import DialChoice, DialControl

MOST_ROUNDS = 99


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


class StudyControls(RunPanel):
    """Offers the work, the axes of the chart, and measuring."""

    dial_chosen = Signal(str, float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            "Work and measuring",
            "Which method is fast, and which one is right? Choose a family at the left and press Measure (F5): all its "
            "methods do the same work, and each gets a mark, further left if it is faster and lower if its error is "
            "smaller.",
            "Measure",
            "Measure all methods on this work (F5). It continues while you use other families and pages. The last "
            "result of each family is kept for the next start.",
            "Stop measuring; the previous results are unchanged (Escape)",
            parent,
        )
        self.work_box = self.box("work", "Work", "The work that all methods do")
        self.measure_box = self.box("measure", "Error", "The error on the vertical axis of the chart")
        self.cost_box = self.box(
            "cost", "Cost", "Time on this machine, or a count of work that is the same on every machine"
        )
        self.rounds_box = self.number(
            "rounds", "Rounds", "Rounds of measurement, more until the order is stable", 1, MOST_ROUNDS
        )
        self.seed_box = self.number("seed", "Seed", "Seed of the random work", 0, 9999)
        self._dials: dict[str, DialControl] = {}
        self._work_flow = self.add_row(
            (("Work", self.work_box), ("Rounds", self.rounds_box), ("Seed", self.seed_box))
        )
        running = (self.start_button, self.cancel_button, self.progress, self.doing)
        self.add_row((("Error", self.measure_box), ("Cost", self.cost_box), *running))
        self.show_progress(None)

    # Showing.

    def show_choices(self, choices: StudyChoices) -> None:
        """Show what can be chosen and what is."""
        for box, named, current in (
            (self.work_box, choices.works, choices.work),
            (self.measure_box, choices.measures, choices.measure),
            (self.cost_box, choices.costs, choices.cost),
        ):
            fill_box(box, named, current)
        set_number(self.rounds_box, choices.rounds)
        set_number(self.seed_box, choices.seed)
        self._show_dials(choices.dials)
        self.start_button.setEnabled(choices.can_measure)
        self.keep_height()

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
            self._dials = {dial.name: DialControl(dial, self) for dial in dials}
            for place, control in enumerate(self._dials.values()):
                control.value_chosen.connect(self.dial_chosen)
                self._work_flow.insert_widget(place + 1, control)
                control.show()
        for dial in dials:
            self._dials[dial.name].show_value(dial.value)
