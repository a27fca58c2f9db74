"""What stands above a plan: how much may differ, how often it is timed, and the analysis."""

from PySide6.QtCore import Signal, Slot
from PySide6.QtWidgets import QWidget

from widgets.basics.controls import button_with_tip
from widgets.basics.run_panel import RunPanel

MOST_COLOR = 255
MOST_PIXELS = 999_999
MOST_ROUNDS = 99
EXACT, WITHIN = "exact", "within"


class PlanControls(RunPanel):
    """Holds the tolerance; offers the analysis, and to use its settings."""

    applying_requested = Signal()
    chart_requested = Signal()
    """The user wants to see the plan's point among the others of the scene."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            "Tolerance and analysis",
            "What does this scene need? Press Analyse (F5): for every stage it finds the cheapest method whose picture "
            "stays within the tolerance, says why, and measures whether that was right.",
            "Analyse",
            "Analyse the scene, choose methods, and measure the result (F5)",
            "Stop the analysis; the previous plan is unchanged (Escape)",
            parent,
        )
        self.kind_box = self.box(
            "kind",
            "Tolerance",
            "Allowed difference from the picture with the reference settings. Exact: every byte is equal",
        )
        self.kind_box.addItem("Within", WITHIN)
        self.kind_box.addItem("Exact", EXACT)
        self.color_box = self.number(
            "color", "Colour", "Largest difference of a channel, in 1/255", 0, MOST_COLOR
        )
        self.color_box.setSuffix("/255")
        self.color_box.setValue(2)
        self.pixels_box = self.number(
            "pixels", "Allowed exceptions", "Number of pixels that may differ by more", 0, MOST_PIXELS
        )
        self.pixels_box.setGroupSeparatorShown(True)
        self.rounds_box = self.number(
            "rounds", "Rounds", "Rounds of measurement; more rounds take longer", 1, MOST_ROUNDS
        )
        self.rounds_box.setValue(3)
        self.apply_button = button_with_tip(
            "Apply", "Use these settings for the scene (Ctrl+Return); Undo restores the old ones", self
        )
        self.chart_button = button_with_tip(
            "On the chart", "Show the plan among all methods: Whole pipeline, on the Compare page", self
        )
        self.add_row(
            (
                ("Tolerance", self.kind_box),
                ("Colour", self.color_box),
                ("Allowed exceptions", self.pixels_box),
                ("Rounds", self.rounds_box),
                *(self.start_button, self.cancel_button, self.apply_button, self.chart_button),
                *(self.progress, self.doing),
            )
        )
        self.kind_box.activated.connect(self._show_kind)
        self.apply_button.clicked.connect(self.applying_requested)
        self.chart_button.clicked.connect(self.chart_requested)
        self.show_progress(None)
        self.show_usable(False)

    # What is chosen.

    @property
    def is_exact(self) -> bool:
        """Whether nothing may differ."""
        return bool(self.kind_box.currentData() == EXACT)

    @Slot()
    def _show_kind(self) -> None:
        for box in (self.color_box, self.pixels_box):
            box.setEnabled(not self.is_exact)

    def show_usable(self, is_usable: bool) -> None:
        """Show whether there is a plan to be applied and to be put on the chart."""
        self.apply_button.setEnabled(is_usable)
        self.chart_button.setEnabled(is_usable)
