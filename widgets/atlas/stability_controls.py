"""What stands above the maps of an experiment: what it claims, how fine it is run, and running it."""

from PySide6.QtWidgets import QLabel, QWidget

from widgets.basics.labels import text_label
from widgets.basics.run_panel import Named, RunPanel, fill_box, set_number


class StabilityControls(RunPanel):
    """Shows question and claim; offers the grid, the seed, and running."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            "Experiment and running it",
            "When does a method go wrong? Choose an experiment at the left and press Run (F5): each method gets a map, "
            "and each cell of it shows whether one run on a harder and harder scene was right.",
            "Run",
            "Run every method at every place of the grid (F5). It continues while you use other experiments and pages. "
            "The last maps of each experiment are kept for the next start.",
            "Stop running; the previous maps are unchanged (Escape)",
            parent,
        )
        self.question, self.claim = self._sentence("Question"), self._sentence("Claim")
        self.question.setProperty("role", "muted")
        self.resolution_box = self.box("resolution", "Grid", "Number of cells in a map")
        self.seed_box = self.number("seed", "Seed", "Seed of the random scenes", 0, 9999)
        self.rows.setSpacing(4)
        running = (self.start_button, self.cancel_button, self.progress, self.doing)
        self.add_row((("Grid", self.resolution_box), ("Seed", self.seed_box), *running))
        self.show_progress(None)

    def _sentence(self, name: str) -> QLabel:
        label = text_label("", self, name=name, wraps=True, is_selectable=True)
        self.rows.addWidget(label)
        return label

    def show_sentences(self, question: str, claim: str) -> None:
        """Show what is asked, and what is claimed and tested."""
        self.question.setText(question)
        self.claim.setText(claim)
        self.keep_height()

    def show_choices(self, resolutions: Named, current: str, seed: int, can_run: bool) -> None:
        """Show the grids and which is chosen; the seed; and whether it can be run."""
        fill_box(self.resolution_box, resolutions, current)
        set_number(self.seed_box, seed)
        self.start_button.setEnabled(can_run)
        self.keep_height()
